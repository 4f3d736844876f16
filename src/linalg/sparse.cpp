// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/linalg/sparse.hpp"

#include <algorithm>
#include <cmath>

#include "perimode/linalg/threads.hpp"

namespace perimode {
namespace {

/// One block row times x, with Block independent sums: every row's sum runs in column order, so the
/// result does not depend on how rows are shared out.
template <int Block>
void multiply_block_rows(const BlockCsr& matrix, const double* x, double* y) {
#pragma omp parallel for schedule(static) if (matrix.rows > parallel_rows)
  for (Index i = 0; i < matrix.rows; ++i) {
    double sum[Block] = {};
    for (Offset e = matrix.row_start[i]; e < matrix.row_start[i + 1]; ++e) {
      const double* a = &matrix.value[e * Block * Block];
      const double* part = x + static_cast<Offset>(matrix.column[e]) * Block;
      for (int r = 0; r < Block; ++r)
        for (int c = 0; c < Block; ++c) sum[r] += a[r * Block + c] * part[c];
    }
    for (int r = 0; r < Block; ++r) y[static_cast<Offset>(i) * Block + r] = sum[r];
  }
}

}  // namespace

Csr scalar_csr(const BlockCsr& matrix, std::span<const Index> dof_number, Zeros zeros) {
  const int b = matrix.block;
  Csr out;
  for (const Index number : dof_number) out.rows = std::max(out.rows, number + 1);
  out.cols = out.rows;
  out.row_start.assign(out.rows + 1, 0);

  const auto for_row = [&](Index dof, auto&& keep) {
    const Index i = dof / b;
    const int r = dof % b;
    for (Offset e = matrix.row_start[i]; e < matrix.row_start[i + 1]; ++e)
      for (int c = 0; c < b; ++c) {
        const Index other = matrix.column[e] * b + c;
        const double a = matrix.value[(e * b + r) * b + c];
        if (dof_number[other] >= 0 && (a != 0.0 || other == dof || zeros == Zeros::keep))
          keep(dof_number[other], a);
      }
  };

  const auto dofs = static_cast<Index>(dof_number.size());
#pragma omp parallel for schedule(static) if (matrix.rows > parallel_rows)
  for (Index dof = 0; dof < dofs; ++dof)
    if (dof_number[dof] >= 0) for_row(dof, [&](Index, double) { ++out.row_start[dof_number[dof] + 1]; });
  for (Index i = 0; i < out.rows; ++i) out.row_start[i + 1] += out.row_start[i];

  out.column.resize(out.nonzeros());
  out.value.resize(out.nonzeros());
#pragma omp parallel for schedule(static) if (matrix.rows > parallel_rows)
  for (Index dof = 0; dof < dofs; ++dof)
    if (dof_number[dof] >= 0) {
      Offset at = out.row_start[dof_number[dof]];
      for_row(dof, [&](Index column, double a) {
        out.column[at] = column;
        out.value[at++] = a;
      });
    }
  return out;
}

void multiply(const BlockCsr& matrix, std::span<const double> x, std::span<double> y) {
  switch (matrix.block) {
    case 1:
      return multiply_block_rows<1>(matrix, x.data(), y.data());
    case 2:
      return multiply_block_rows<2>(matrix, x.data(), y.data());
    default:
      return multiply_block_rows<3>(matrix, x.data(), y.data());
  }
}

void multiply(const Csr& matrix, std::span<const double> x, std::span<double> y) {
#pragma omp parallel for schedule(static) if (matrix.rows > parallel_rows)
  for (Index i = 0; i < matrix.rows; ++i) {
    double sum = 0.0;
    for (Offset e = matrix.row_start[i]; e < matrix.row_start[i + 1]; ++e)
      sum += matrix.value[e] * x[matrix.column[e]];
    y[i] = sum;
  }
}

Eigen::MatrixXd multiply(const Csr& matrix, const Eigen::MatrixXd& x) {
  // Row-major copies keep the values of one dof together: each matrix entry is read once and
  // meets a contiguous run of x.
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const RowMajor in = x;
  RowMajor out = RowMajor::Zero(matrix.rows, x.cols());
#pragma omp parallel for schedule(static) if (matrix.rows > parallel_rows)
  for (Index i = 0; i < matrix.rows; ++i)
    for (Offset e = matrix.row_start[i]; e < matrix.row_start[i + 1]; ++e)
      out.row(i).noalias() += matrix.value[e] * in.row(matrix.column[e]);
  return out;
}

double asymmetry(const Csr& matrix) {
  const auto entry = [&](Index i, Index j) {
    const auto first = matrix.column.begin() + matrix.row_start[i];
    const auto last = matrix.column.begin() + matrix.row_start[i + 1];
    const auto found = std::lower_bound(first, last, j);
    return found != last && *found == j ? matrix.value[found - matrix.column.begin()] : 0.0;
  };
  double difference = 0.0, largest = 0.0;
#pragma omp parallel for schedule(static) \
    reduction(max : difference, largest) if (matrix.rows > parallel_rows)
  for (Index i = 0; i < matrix.rows; ++i)
    for (Offset e = matrix.row_start[i]; e < matrix.row_start[i + 1]; ++e) {
      largest = std::max(largest, std::abs(matrix.value[e]));
      difference = std::max(difference, std::abs(matrix.value[e] - entry(matrix.column[e], i)));
    }
  return largest > 0.0 ? difference / largest : 0.0;
}

double norm_inf(const Csr& matrix) {
  double norm = 0.0;
  for (Index i = 0; i < matrix.rows; ++i) {
    double sum = 0.0;
    for (Offset e = matrix.row_start[i]; e < matrix.row_start[i + 1]; ++e) sum += std::abs(matrix.value[e]);
    norm = std::max(norm, sum);
  }
  return norm;
}

}  // namespace perimode
