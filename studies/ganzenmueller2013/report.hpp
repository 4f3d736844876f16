// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "studies/common/results.hpp"

namespace perimode::studies {

/// Prints errors of the strain energy, 3D and 2D, original and normalised constants.
void print_energies(const std::vector<int>& squared_ratios, const std::vector<int>& in_plane,
                    const Results& results, const ExpectedResults& expected);

/// Prints speeds of long waves along [100], by the symbol and by a signal in time.
void print_speeds(const std::vector<int>& squared_ratios, const Results& results,
                  const ExpectedResults& expected);

/// Prints where the pulse is on lattices.
void print_peaks(const std::vector<int>& squared_ratios, const std::vector<int>& cells,
                 const Results& results, const ExpectedResults& expected);

/// Prints where the pulse is in tetrahedra.
void print_clouds(int levels, const Results& results);

}  // namespace perimode::studies
