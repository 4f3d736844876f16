// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace perimode {

using MatrixView = Eigen::Ref<const Eigen::MatrixXd>;

/// A^T B by the tuned BLAS (Eigen's own product is compiled for the plainest processor), or, for
/// tall A and at most eight columns of B, by a kernel that reads A once at memory speed.
[[nodiscard]] Eigen::MatrixXd transposed_product(const MatrixView& a, const MatrixView& b);

/// c += scale * A B, the same way.
void add_product(double scale, const MatrixView& a, const MatrixView& b, Eigen::Ref<Eigen::MatrixXd> c);

/// A B
[[nodiscard]] Eigen::MatrixXd product(const MatrixView& a, const MatrixView& b);

/// Eigenvalues ascending in the returned vector; h becomes the eigenvectors. Throws
/// Error(solver_failure) if the dense iteration fails.
[[nodiscard]] Eigen::VectorXd symmetric_eigen(Eigen::MatrixXd& h);

}  // namespace perimode
