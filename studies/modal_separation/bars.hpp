// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "studies/common/results.hpp"

namespace perimode::studies {

inline constexpr int bar_modes = 20;

/// The ends a bar may have, and the self-cell term: "odd", ..., "odd self_cell", ...
[[nodiscard]] std::vector<std::string> bar_names();

/// Modes of a bar: adds omega, error (against separation of variables), classical_error, discrete_error
/// (against the closed form of the lattice, where there is one) of modes 1 to 20; separation, the exact ones;
/// asymmetry and imaginary (max |Im lambda| / max |lambda| over all modes) of unsymmetric bodies.
void run_bar(const std::string& name, double horizon, int ratio, Results& results);

/// Adds order = log(error ratio) / log(refinement) between neighbouring `ratios` at one horizon (under the
/// finer ratio), and bias = omega(surface_nodes) / omega(odd) - 1.
void derive(const std::vector<double>& horizons, const std::vector<int>& ratios, Results& results);

}  // namespace perimode::studies
