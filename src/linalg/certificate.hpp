// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "perimode/linalg/eigen.hpp"
#include "search.hpp"

namespace perimode {

/// Number of eigenvalues of K x = lambda M x below sigma, by Sylvester's law of inertia.
[[nodiscard]] Offset count_below(const EigenProblem& problem, double sigma, std::span<const Index> order);

/// Complete iff exactly `expected` eigenvalues (known ones included) lie below `at`, a point in a gap.
[[nodiscard]] Certificate certify_by_inertia(const EigenProblem& problem, double at, Offset expected,
                                             std::span<const Index> order);

/// Complete iff random blocks deflated against known and found vectors, aware of whatever else the
/// iteration still holds, meet nothing at or above `cut` = 1 / (lambda - sigma): `rounds` seeds.
[[nodiscard]] Certificate certify_by_restart(SpectralTransform& op, const Eigen::MatrixXd& deflated,
                                             Neighbourhood held, double cut, int block, int rounds,
                                             std::uint64_t seed);

/// Is an indefinite factorisation no dearer than half of the solves of a restart certificate?
[[nodiscard]] bool inertia_is_cheap(Index rows, Offset factor_nonzeros, double factor_flops);

}  // namespace perimode
