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
  /// Why, where not converged: limit reached, A or M not positive definite, stagnation.
  std::string message;
  /// A met a direction without stiffness that b pushes along: p^T A p <= 0, or x grew beyond all numbers.
  bool singular = false;
  double seconds = 0.0;
};

/// Preconditioned conjugate gradients for symmetric positive (semi-)definite A and a fixed symmetric positive
/// definite preconditioner M^-1 ~ A^-1 (an empty apply: none), docs/theory/08_iterative.md. Where the
/// residual of the recurrence meets the tolerance the true one is computed; if that does not, the iteration
/// restarts from it, and gives up (`stagnation`) once a restart gains less than a factor of two. For a
/// singular A, b has to be orthogonal to the null space; x then keeps the start's part in it up to round-off.
/// b = 0 gives x = 0. The same bits for any number of threads. Throws invalid_input: sizes that differ,
/// numbers that are not finite, tolerance <= 0. Cost per iteration: one product, one preconditioner, four
/// passes over vectors (11 reads and writes of a number per dof). Memory: five vectors.
/// [hestenes_stiefel1952]
[[nodiscard]] CgResult conjugate_gradients(const LinearOperator& a, const Eigen::VectorXd& b,
                                           const LinearOperator& preconditioner, const CgOptions& options,
                                           const Eigen::VectorXd* start = nullptr, const Sink& sink = {});

/// Inverse of the diagonal blocks: `blocks` holds block x block numbers (row-major) per node, of which the
/// dofs with number >= 0 in `dof_number` (block per node) are kept. A block of n rows that is not positive
/// definite (pivots below 1e-12 of the largest count as zero) is replaced by n times its diagonal, which is
/// an upper bound of a semi-definite one; a diagonal entry that is not positive by 1. Nodes in a row with
/// equal blocks share one inverse. Throws invalid_input for sizes that do not belong together and blocks
/// wider than 16. Cost per apply: one pass over x and y.
[[nodiscard]] LinearOperator block_jacobi(const std::vector<double>& blocks, int block,
                                          std::span<const Index> dof_number);

/// A Cholesky factor as preconditioner, for a matrix that has changed a little since it was factored (a stale
/// factor). The factor has to outlive the operator.
[[nodiscard]] LinearOperator factor_preconditioner(const CholeskyFactor& factor, Index size);

}  // namespace perimode
