// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "perimode/core/types.hpp"

namespace perimode {

/// Square matrix of dense block x block blocks in compressed rows. Columns ascend within a row;
/// the diagonal block is always stored. Block e is value[e*block*block ..], row-major.
struct BlockCsr {
  int block = 1;
  Index rows = 0;                 ///< block rows
  std::vector<Offset> row_start;  ///< rows + 1
  std::vector<Index> column;      ///< block columns
  std::vector<double> value;

  [[nodiscard]] Offset blocks() const { return row_start.empty() ? 0 : row_start.back(); }
};

/// Scalar compressed rows, columns ascending.
struct Csr {
  Index rows = 0;
  Index cols = 0;
  std::vector<Offset> row_start;
  std::vector<Index> column;
  std::vector<double> value;

  [[nodiscard]] Offset nonzeros() const { return row_start.empty() ? 0 : row_start.back(); }
};

/// Sparse vectors c_1 .. c_k of one length, rows ascending within each: a matrix changes by sums of c c^T.
struct SparseColumns {
  Index rows = 0;
  std::vector<Offset> start = {0};  ///< columns + 1
  std::vector<Index> row;
  std::vector<double> value;

  [[nodiscard]] Index count() const { return static_cast<Index>(start.size()) - 1; }
};

/// The scalar matrix left when rows and columns of eliminated dofs are struck out. Dof
/// block*i + a becomes number dof_number[block*i + a]; -1 strikes it out; numbers ascend.
/// Entries that are exactly zero outside the diagonal are dropped, or kept where the matrix will change:
/// bonds along the axes and at right angles cancel in a lattice until one of them breaks. Cost O(nonzeros).
enum class Zeros { drop, keep };
[[nodiscard]] Csr scalar_csr(const BlockCsr& matrix, std::span<const Index> dof_number,
                             Zeros zeros = Zeros::drop);

/// y = A x, rows in parallel, the same bits for any thread count.
void multiply(const BlockCsr& matrix, std::span<const double> x, std::span<double> y);
void multiply(const Csr& matrix, std::span<const double> x, std::span<double> y);
/// Y = A X, columns of X are vectors.
[[nodiscard]] Eigen::MatrixXd multiply(const Csr& matrix, const Eigen::MatrixXd& x);

/// max |A - A^T| / max |A|; 0 for an exactly symmetric matrix. Cost O(nonzeros).
[[nodiscard]] double asymmetry(const Csr& matrix);

/// Largest absolute row sum (infinity norm).
[[nodiscard]] double norm_inf(const Csr& matrix);

}  // namespace perimode
