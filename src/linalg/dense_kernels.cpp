// SPDX-License-Identifier: BSD-3-Clause
#include "dense_kernels.hpp"

#include <cblas.h>
#include <lapacke.h>

#include <algorithm>
#include <cstddef>
#include <string>

#include "perimode/core/error.hpp"
#include "vector_kernels.hpp"

namespace perimode {
namespace {

constexpr int widest = 8;              // interleaved vectors
constexpr std::ptrdiff_t panel = 512;  // rows whose interleaved vectors stay in the first cache
constexpr Eigen::Index tall = 2000;    // rows from which the kernels below pay

/// c (columns x width, interleaved) += A^T y over one panel; A column-major, y interleaved.
template <int Width>
[[gnu::always_inline]] inline void gather(const double* a, std::ptrdiff_t stride, std::ptrdiff_t rows,
                                          std::ptrdiff_t columns, const double* y_data, double* c_data) {
  using Vector = typename Lane<Width>::Type;
  const auto* y = reinterpret_cast<const Vector*>(y_data);
  auto* c = reinterpret_cast<Vector*>(c_data);
  std::ptrdiff_t j = 0;
  for (; j + 4 <= columns; j += 4) {
    const double *a0 = a + j * stride, *a1 = a0 + stride, *a2 = a1 + stride, *a3 = a2 + stride;
    Vector s0 = {}, s1 = {}, s2 = {}, s3 = {};
    for (std::ptrdiff_t i = 0; i < rows; ++i) {
      const Vector at = y[i];
      s0 += a0[i] * at;
      s1 += a1[i] * at;
      s2 += a2[i] * at;
      s3 += a3[i] * at;
    }
    c[j] += s0;
    c[j + 1] += s1;
    c[j + 2] += s2;
    c[j + 3] += s3;
  }
  for (; j < columns; ++j)
    for (std::ptrdiff_t i = 0; i < rows; ++i) c[j] += a[j * stride + i] * y[i];
}

/// y += A c over one panel.
template <int Width>
[[gnu::always_inline]] inline void scatter(const double* a, std::ptrdiff_t stride, std::ptrdiff_t rows,
                                           std::ptrdiff_t columns, const double* c_data, double* y_data) {
  using Vector = typename Lane<Width>::Type;
  const auto* c = reinterpret_cast<const Vector*>(c_data);
  auto* y = reinterpret_cast<Vector*>(y_data);
  std::ptrdiff_t j = 0;
  for (; j + 4 <= columns; j += 4) {
    const double *a0 = a + j * stride, *a1 = a0 + stride, *a2 = a1 + stride, *a3 = a2 + stride;
    const Vector c0 = c[j], c1 = c[j + 1], c2 = c[j + 2], c3 = c[j + 3];
    for (std::ptrdiff_t i = 0; i < rows; ++i) y[i] += (a0[i] * c0 + a1[i] * c1) + (a2[i] * c2 + a3[i] * c3);
  }
  for (; j < columns; ++j) {
    const Vector factor = c[j];
    for (std::ptrdiff_t i = 0; i < rows; ++i) y[i] += a[j * stride + i] * factor;
  }
}

PERIMODE_EVERY_PROCESSOR void gather_4(const double* a, std::ptrdiff_t stride, std::ptrdiff_t rows,
                                       std::ptrdiff_t columns, const double* y, double* c) {
  gather<4>(a, stride, rows, columns, y, c);
}
PERIMODE_EVERY_PROCESSOR void gather_8(const double* a, std::ptrdiff_t stride, std::ptrdiff_t rows,
                                       std::ptrdiff_t columns, const double* y, double* c) {
  gather<8>(a, stride, rows, columns, y, c);
}
PERIMODE_EVERY_PROCESSOR void scatter_4(const double* a, std::ptrdiff_t stride, std::ptrdiff_t rows,
                                        std::ptrdiff_t columns, const double* c, double* y) {
  scatter<4>(a, stride, rows, columns, c, y);
}
PERIMODE_EVERY_PROCESSOR void scatter_8(const double* a, std::ptrdiff_t stride, std::ptrdiff_t rows,
                                        std::ptrdiff_t columns, const double* c, double* y) {
  scatter<8>(a, stride, rows, columns, c, y);
}

/// Rows [first, first + rows) of at most Width columns side by side, times scale; the rest zero.
void interleave(const MatrixView& from, std::ptrdiff_t first, std::ptrdiff_t rows, int lanes, double scale,
                double* to) {
  for (int w = 0; w < lanes; ++w)
    for (std::ptrdiff_t i = 0; i < rows; ++i)
      to[i * lanes + w] = w < from.cols() ? scale * from(first + i, w) : 0.0;
}

/// Columns of A taken at a time: their coefficients fit a small array.
constexpr std::ptrdiff_t most_columns = 256;

Eigen::MatrixXd tall_transposed_product(const MatrixView& a, const MatrixView& b) {
  alignas(64) double y[panel * widest], c[most_columns * widest];
  const int lanes = b.cols() > 4 ? 8 : 4;
  Eigen::MatrixXd out(a.cols(), b.cols());
  for (std::ptrdiff_t column = 0; column < a.cols(); column += most_columns) {
    const std::ptrdiff_t columns = std::min<std::ptrdiff_t>(most_columns, a.cols() - column);
    std::fill(c, c + columns * lanes, 0.0);
    for (std::ptrdiff_t row = 0; row < a.rows(); row += panel) {
      const std::ptrdiff_t rows = std::min<std::ptrdiff_t>(panel, a.rows() - row);
      interleave(b, row, rows, lanes, 1.0, y);
      (lanes == 8 ? gather_8 : gather_4)(a.data() + column * a.outerStride() + row, a.outerStride(), rows,
                                         columns, y, c);
    }
    for (std::ptrdiff_t j = 0; j < columns; ++j)
      for (Eigen::Index w = 0; w < b.cols(); ++w) out(column + j, w) = c[j * lanes + w];
  }
  return out;
}

void tall_add_product(double scale, const MatrixView& a, const MatrixView& b,
                      Eigen::Ref<Eigen::MatrixXd> out) {
  alignas(64) double y[panel * widest], c[most_columns * widest];
  const int lanes = b.cols() > 4 ? 8 : 4;
  for (std::ptrdiff_t column = 0; column < a.cols(); column += most_columns) {
    const std::ptrdiff_t columns = std::min<std::ptrdiff_t>(most_columns, a.cols() - column);
    interleave(b, column, columns, lanes, scale, c);
    for (std::ptrdiff_t row = 0; row < a.rows(); row += panel) {
      const std::ptrdiff_t rows = std::min<std::ptrdiff_t>(panel, a.rows() - row);
      interleave(out, row, rows, lanes, 1.0, y);
      (lanes == 8 ? scatter_8 : scatter_4)(a.data() + column * a.outerStride() + row, a.outerStride(), rows,
                                           columns, c, y);
      for (Eigen::Index w = 0; w < b.cols(); ++w)
        for (std::ptrdiff_t i = 0; i < rows; ++i) out(row + i, w) = y[i * lanes + w];
    }
  }
}

}  // namespace

Eigen::MatrixXd transposed_product(const MatrixView& a, const MatrixView& b) {
  if (a.rows() >= tall && b.cols() <= widest && a.cols() > 0) return tall_transposed_product(a, b);
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(a.cols(), b.cols());
  if (c.size() > 0 && a.rows() > 0)
    cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, static_cast<int>(c.rows()),
                static_cast<int>(c.cols()), static_cast<int>(a.rows()), 1.0, a.data(),
                static_cast<int>(a.outerStride()), b.data(), static_cast<int>(b.outerStride()), 0.0, c.data(),
                static_cast<int>(c.rows()));
  return c;
}

void add_product(double scale, const MatrixView& a, const MatrixView& b, Eigen::Ref<Eigen::MatrixXd> c) {
  if (c.size() == 0 || a.cols() == 0) return;
  if (a.rows() >= tall && b.cols() <= widest) return tall_add_product(scale, a, b, c);
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, static_cast<int>(c.rows()),
              static_cast<int>(c.cols()), static_cast<int>(a.cols()), scale, a.data(),
              static_cast<int>(a.outerStride()), b.data(), static_cast<int>(b.outerStride()), 1.0, c.data(),
              static_cast<int>(c.outerStride()));
}

Eigen::MatrixXd product(const MatrixView& a, const MatrixView& b) {
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(a.rows(), b.cols());
  add_product(1.0, a, b, c);
  return c;
}

Eigen::VectorXd symmetric_eigen(Eigen::MatrixXd& h) {
  Eigen::VectorXd value(h.rows());
  const auto n = static_cast<lapack_int>(h.rows());
  if (n == 0) return value;
  const Eigen::MatrixXd given = h;
  lapack_int info = LAPACKE_dsyevd(LAPACK_COL_MAJOR, 'V', 'U', n, h.data(), n, value.data());
  if (info > 0) {  // divide and conquer gives up now and then on many equal eigenvalues; QR does not
    h = given;
    info = LAPACKE_dsyev(LAPACK_COL_MAJOR, 'V', 'U', n, h.data(), n, value.data());
  }
  if (info != 0)
    throw Error(ErrorKind::solver_failure,
                "dense eigenvalues: LAPACK dsyevd and dsyev failed with code " + std::to_string(info));
  return value;
}

}  // namespace perimode
