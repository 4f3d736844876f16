// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "figure.hpp"
#include "lattices.hpp"

namespace perimode::studies {

/// Fig. 4: a, b speeds of long waves over direction (degrees), original N = 2, 3, 4; c over N at 0 and 45.
[[nodiscard]] Figure long_wave_figure(const Results& results);
/// Fig. 6: a multipliers of point collocation over i; b eq. (49) over N.
[[nodiscard]] Figure bar_error_figure(const Kernels& bars, const Results& results);
/// Fig. 7: a, b omega(k) of the original and the optimised bars, N = 3, 5; c eq. (49).
[[nodiscard]] Figure bar_figure(const Kernels& bars, const Results& results);
/// Fig. 9: omega over O-M-Y-O, N = 3, with the columns of table 2 and ours: P, S optimal (a, b) and positive
/// (c, d).
[[nodiscard]] Figure contour_figure(const Kernels& plates);
/// Fig. 10: eq. (50), our fit, and the multipliers they go through.
[[nodiscard]] Figure influence_figure(const ExpectedResults& paper, const Kernels& plates);
/// Fig. 11: a, b omega of both waves over O-M-Y, optimal and positive, N = 3; c error51 and error45.
[[nodiscard]] Figure plate_error_figure(const Kernels& plates, const Results& results);

}  // namespace perimode::studies
