// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "studies/common/results.hpp"

namespace perimode::studies {

/// "mirror constant", "antimirror gaussian", ...
[[nodiscard]] std::vector<std::string> plate_names();

/// Modes of a plate at horizon 3/32 and `ratio` cells per horizon (a multiple of 3): adds discrete_error, the
/// largest of the 20 lowest modes against the closed form of the lattice, and for the waves of shape (1, 1),
/// under "<name> S" and "<name> P", omega, continuum, and error = omega / continuum - 1.
void run_plate(const std::string& name, int ratio, Results& results);

inline constexpr double plate_horizon = 3.0 / 32.0;

}  // namespace perimode::studies
