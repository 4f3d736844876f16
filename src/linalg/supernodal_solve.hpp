// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cholmod.h>

#include <Eigen/Core>
#include <span>
#include <vector>

namespace perimode {

/// x = P^T L^-T L^-1 P b for a supernodal L L^T factor with 32-bit indices. Vectors go through L in
/// groups of 8 or 4, their entries interleaved, so that each number of L is read twice per group
/// and meets one short vector: the pass runs at memory speed, where a general triangular solver
/// with few right-hand sides spends its time copying. `work` grows to what is needed.
void supernodal_solve(const cholmod_factor& factor, const Eigen::Ref<const Eigen::MatrixXd>& b,
                      Eigen::MatrixXd& x, std::vector<double>& work);

/// The same for a b whose rows are zero but in the supernodes `forward` (ascending, closed towards the
/// roots).
void supernodal_solve(const cholmod_factor& factor, std::span<const int> forward,
                      const Eigen::Ref<const Eigen::MatrixXd>& b, Eigen::MatrixXd& x,
                      std::vector<double>& work);

}  // namespace perimode
