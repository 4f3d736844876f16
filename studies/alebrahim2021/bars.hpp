// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lattices.hpp"

namespace perimode::studies {

/// Original and optimised bars of every N: alpha, the residual of eq. (34), the optimality residual,
/// error49 (eq. (49) over that of the original N = 3) and squared_residual (int R^2 dk). Kernels
/// "original", "P.C", "S.C", "L.S", "G" and "L1", the least eq. (49) there is.
[[nodiscard]] Kernels optimised_bars(const std::vector<int>& horizons, Results& results);

/// The columns of table 1 as printed, "P.C printed", ...: error49 and squared_residual.
void add_printed_bars(const ExpectedResults& paper, Results& results, Kernels& bars);

/// Sect. 7.1.2: N = 2 with alpha = 1 ("original"), 3.72, -0.86 ("modified", kept in `bars`) and the numbers
/// these are rounded from ("S.C"): where they cross omega = k, cut-offs, what lies at 2.25 rad/s.
void add_bands(const ExpectedResults& paper, Results& results, Kernels& bars);

/// Sect. 3.4.1: N = 1. Speed of long waves without and largest difference with alpha = 1/2 from finite
/// differences of second order, eq. (27).
void add_nearest_neighbours(Results& results);

}  // namespace perimode::studies
