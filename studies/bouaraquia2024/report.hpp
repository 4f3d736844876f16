// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bars.hpp"

namespace perimode::studies {

/// Prints, per bar: L2 error over 1, 2, 3 periods, largest error far from jumps, overshoot, under it the
/// expected ones, and the difference from the closed form of the lattice.
void print_bars(const std::vector<BarRun>& runs, const Results& results, const ExpectedResults& expected);

/// Prints the strain at four instants with the expected ones.
void print_strains(const std::vector<BarRun>& runs, const Results& results, const ExpectedResults& expected);

}  // namespace perimode::studies
