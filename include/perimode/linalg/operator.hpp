// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>

#include "perimode/linalg/sparse.hpp"

namespace perimode {

/// y = A x for a square A that need not be stored: a sparse matrix, a stencil, a preconditioner.
/// `apply` writes all of y, which does not overlap x, gives the same bits for any number of threads, and is
/// not called by two threads at a time.
struct LinearOperator {
  Index size = 0;
  std::function<void(const double* x, double* y)> apply;
};

/// The product with a matrix, which has to outlive the operator.
[[nodiscard]] LinearOperator as_operator(const Csr& matrix);

/// A x, and A X column by column.
[[nodiscard]] Eigen::VectorXd multiply(const LinearOperator& a, const Eigen::VectorXd& x);
[[nodiscard]] Eigen::MatrixXd multiply(const LinearOperator& a, const Eigen::MatrixXd& x);

/// |y^T A x - x^T A y| / (|A x| |y| + |A y| |x|) for random x and y, the largest of three pairs: round-off
/// (below 1e-13) for a symmetric operator, and for no other but by a chance of measure zero. 6 products.
[[nodiscard]] double asymmetry(const LinearOperator& a, std::uint64_t seed = 1);

/// An asymmetry at or below this counts as round-off.
constexpr double symmetric_to_round_off = 1e-12;

}  // namespace perimode
