// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "perimode/core/sink.hpp"
#include "perimode/linalg/factor.hpp"
#include "perimode/linalg/operator.hpp"

namespace perimode {

struct CgOptions {
  double tolerance = 1e-8;  ///< stop when the true |b - A x| <= tolerance |b| (2-norm)
  int most_iterations = 20000;
};

struct CgResult {
  bool converged = false;
  Eigen::VectorXd x;
  int iterations = 0;
  double residual = 0.0;  ///< |b - A x| / |b|, computed from x at the end, not by the recurrence
  std::string
      message;  ///< why, where not converged (limit reached, A or M not positive definite, stagnation)
  double seconds = 0.0;
};

/// Preconditioned conjugate gradients for symmetric positive (semi-)definite A and a fixed symmetric positive
/// definite preconditioner M^-1 ~ A^-1 (an empty apply: none). Stops on the true norm; where the recurrence
/// and the true residual part, it restarts from the true one. For a singular A, b has to be orthogonal to
/// the null space. The same bits for any number of threads. Cost per iteration: one product, one
/// preconditioner, five passes over vectors. [hestenes1952]
[[nodiscard]] CgResult conjugate_gradients(const LinearOperator& a, const Eigen::VectorXd& b,
                                           const LinearOperator& preconditioner, const CgOptions& options,
                                           const Eigen::VectorXd* start = nullptr, const Sink& sink = {});

/// Inverse of the diagonal blocks: `blocks` holds block x block numbers (row-major) per node, of which
/// the dofs with number >= 0 in `dof_number` (block per node) are kept. A block that is not positive definite
/// is replaced by its diagonal, a diagonal entry that is not positive by 1.
[[nodiscard]] LinearOperator block_jacobi(const std::vector<double>& blocks, int block,
                                          std::span<const Index> dof_number);

/// A Cholesky factor as preconditioner, for a matrix that has changed a little since it was factored (a stale
/// factor). The factor has to outlive the operator.
[[nodiscard]] LinearOperator factor_preconditioner(const CholeskyFactor& factor, Index size);

}  // namespace perimode
