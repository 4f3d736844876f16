// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lattices.hpp"

namespace perimode::studies {

/// The function of eq. (50), N = 3.
[[nodiscard]] Micromodulus printed_influence(const ExpectedResults& paper);

/// An influence function fitted, with eight cosines as eq. (50), to the multipliers of a plate, N = 3.
[[nodiscard]] Micromodulus fitted_influence(const std::vector<double>& alpha);

/// influence (at |offset|^2), least and least_at, energy_ratio (eq. (5) at nu = 1/4, and for what the paper
/// says of its glasses), influence_deviation (from "S.C positive" of table 2), long_wave_speed on the grid;
/// critical_stretch of eq. (52) in both glasses for the constant kernel, eq. (50) and our fit.
void add_influence(const ExpectedResults& paper, const Kernels& plates, Results& results);

}  // namespace perimode::studies
