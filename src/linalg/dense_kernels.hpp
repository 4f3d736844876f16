// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cblas.h>

#include <Eigen/Core>

namespace perimode {

using MatrixView = Eigen::Ref<const Eigen::MatrixXd>;

/// A^T B by the tuned BLAS (Eigen's own product is compiled for the plainest processor).
inline Eigen::MatrixXd transposed_product(const MatrixView& a, const MatrixView& b) {
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(a.cols(), b.cols());
  if (c.size() > 0 && a.rows() > 0)
    cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, static_cast<int>(c.rows()),
                static_cast<int>(c.cols()), static_cast<int>(a.rows()), 1.0, a.data(),
                static_cast<int>(a.outerStride()), b.data(), static_cast<int>(b.outerStride()), 0.0, c.data(),
                static_cast<int>(c.rows()));
  return c;
}

/// c += scale * A B
inline void add_product(double scale, const MatrixView& a, const MatrixView& b,
                        Eigen::Ref<Eigen::MatrixXd> c) {
  if (c.size() > 0 && a.cols() > 0)
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, static_cast<int>(c.rows()),
                static_cast<int>(c.cols()), static_cast<int>(a.cols()), scale, a.data(),
                static_cast<int>(a.outerStride()), b.data(), static_cast<int>(b.outerStride()), 1.0, c.data(),
                static_cast<int>(c.outerStride()));
}

/// A B
inline Eigen::MatrixXd product(const MatrixView& a, const MatrixView& b) {
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(a.rows(), b.cols());
  add_product(1.0, a, b, c);
  return c;
}

/// Eigenvalues ascending in the returned vector; h becomes the eigenvectors. Throws
/// Error(solver_failure) if the dense iteration fails.
[[nodiscard]] Eigen::VectorXd symmetric_eigen(Eigen::MatrixXd& h);

}  // namespace perimode
