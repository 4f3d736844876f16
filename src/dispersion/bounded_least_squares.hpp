// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace perimode {

/// min (1/2) |rows x - right|^2  subject to  constraints x = values, x >= lower.
struct BoundedLeastSquares {
  Eigen::MatrixXd rows;
  Eigen::VectorXd right;
  Eigen::MatrixXd constraints;  ///< of full row rank
  Eigen::VectorXd values;
  double lower = 0.0;  ///< of every x; -infinity for none
};

struct BoundedMinimum {
  Eigen::VectorXd x;
  std::vector<int> active;  ///< ascending; these x are the bound exactly
  /// Largest violation of the optimality conditions with g = rows^T (rows x - right) - constraints^T mu:
  /// |g_i| where x_i is free, -g_i where it is at its bound.
  double violation = 0.0;
};

/// A primal active-set method from a feasible `start`: in every step the minimum over the free variables by
/// an orthonormal basis of the null space of their constraints and a complete orthogonal decomposition (the
/// objective is never squared), up to the first bound in the way; then the bound whose multiplier is most
/// negative is let go (the first such one after many steps, so that degenerate vertices cannot cycle).
/// Without bounds one step suffices, and of several minima it is the one nearest to `start`. Deterministic.
/// Cost O(n^3) per step for n variables. Throws Error (solver_failure) where 100 n steps do not end.
[[nodiscard]] BoundedMinimum minimise(const BoundedLeastSquares& problem, const Eigen::VectorXd& start);

}  // namespace perimode
