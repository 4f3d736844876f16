// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lattices.hpp"

namespace perimode::studies {

/// Speeds of long waves over the classical ones at 0 and 45 degrees, bonds, coefficients (bonds/4) and
/// orbits of the original plate, [alebrahim2021] fig. 4c; for N = 1 the largest difference from eq. (28).
void add_long_waves(const std::vector<int>& horizons, Results& results);

/// Original and optimised plates: "QP" (least squares, eq. (45)), "QP 0" and "QP 0.5" (with that lower
/// bound) and "L1" (eq. (43)) for N = 2, 3; "QP" alone for more. Their alpha, residual of eq. (39),
/// optimality, and errors over those of the original of the same N: error51 and error45 with P and S told
/// apart by size as in eq. (15), error51_named and error45_named by polarisation. They differ where branches
/// cross.
[[nodiscard]] Kernels optimised_plates(const std::vector<int>& horizons, Results& results);

/// The twelve columns of table 2: A, B (omega^2/k^2 of long waves along x; nu = 1/4 wants 1.2 and 0.4), what
/// half a printed digit may change in them, normalised speeds at 0 and 45 degrees, eq39 (2: holds within half
/// a digit, 1: within a whole one, 0: violated), error51 and error45.
void add_table2(const ExpectedResults& paper, Results& results, Kernels& plates);

/// What eq. (39) leaves free for N = 2: shared_alpha, that of (1,1), and shared_sum, alpha of (1,0) plus
/// twice that of (2,0). numbering_miss: how far the columns of table 2 miss A = 1.2 with the numbering used
/// (at 1) and the next best one (at 2), root mean square over the optimal columns of N.
void add_numbering(const ExpectedResults& paper, Results& results);

/// From the whole zone (points per axis as given): omega_max, least_squared, least_speed_squared of omega^2
/// and omega^2/k^2, and stable_step_ns for soda-lime glass with spacing 0.25 mm, as in sect. 7.2.4.
void add_stability(const Kernels& plates, int points, Results& results);

}  // namespace perimode::studies
