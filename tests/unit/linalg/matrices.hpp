// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "perimode/linalg/sparse.hpp"

namespace perimode::test {

/// n x n, to be filled row by row.
inline Csr empty_square(Index n) {
  Csr out;
  out.rows = out.cols = n;
  out.row_start = {0};
  return out;
}

/// The nonzeros (and the diagonal) of a dense matrix.
inline Csr sparse(const Eigen::MatrixXd& dense) {
  Csr out = empty_square(static_cast<Index>(dense.rows()));
  for (Index i = 0; i < dense.rows(); ++i) {
    for (Index j = 0; j < dense.cols(); ++j)
      if (dense(i, j) != 0.0 || i == j) {
        out.column.push_back(j);
        out.value.push_back(dense(i, j));
      }
    out.row_start.push_back(static_cast<Offset>(out.column.size()));
  }
  return out;
}

inline Eigen::MatrixXd dense(const Csr& matrix) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(matrix.rows, matrix.cols);
  for (Index i = 0; i < matrix.rows; ++i)
    for (Offset e = matrix.row_start[i]; e < matrix.row_start[i + 1]; ++e)
      out(i, matrix.column[e]) = matrix.value[e];
  return out;
}

inline Csr diagonal(const Eigen::VectorXd& value) {
  Csr out = empty_square(static_cast<Index>(value.size()));
  for (Index i = 0; i < out.rows; ++i) {
    out.column.push_back(i);
    out.value.push_back(value[i]);
    out.row_start.push_back(i + 1);
  }
  return out;
}

/// Second differences on a chain of n masses; ends clamped or free.
inline Csr chain(Index n, bool clamped) {
  Csr out = empty_square(n);
  for (Index i = 0; i < n; ++i) {
    const bool end = i == 0 || i == n - 1;
    if (i > 0) {
      out.column.push_back(i - 1);
      out.value.push_back(-1.0);
    }
    out.column.push_back(i);
    out.value.push_back(end && !clamped ? 1.0 : 2.0);
    if (i < n - 1) {
      out.column.push_back(i + 1);
      out.value.push_back(-1.0);
    }
    out.row_start.push_back(static_cast<Offset>(out.column.size()));
  }
  return out;
}

/// The 7-point Laplacian of a periodic n^3 lattice plus `lift` on the diagonal; n >= 3.
inline Csr periodic_lattice(Index n, double lift) {
  Csr out = empty_square(n * n * n);
  for (Index z = 0; z < n; ++z)
    for (Index y = 0; y < n; ++y)
      for (Index x = 0; x < n; ++x) {
        const auto at = [&](Index a, Index b, Index c) {
          return ((c + n) % n * n + (b + n) % n) * n + (a + n) % n;
        };
        std::vector<std::pair<Index, double>> row = {{at(x, y, z), 6.0 + lift}};
        for (const Index d : {-1, 1}) {
          row.emplace_back(at(x + d, y, z), -1.0);
          row.emplace_back(at(x, y + d, z), -1.0);
          row.emplace_back(at(x, y, z + d), -1.0);
        }
        std::sort(row.begin(), row.end());
        for (const auto& [column, value] : row) {
          out.column.push_back(column);
          out.value.push_back(value);
        }
        out.row_start.push_back(static_cast<Offset>(out.column.size()));
      }
  return out;
}

/// Its eigenvalues, ascending: lift + sum over axes of 4 sin^2(pi k / n).
inline std::vector<double> periodic_lattice_eigenvalues(Index n, double lift) {
  std::vector<double> out;
  const auto axis = [&](Index k) { return 4.0 * std::pow(std::sin(M_PI * k / n), 2); };
  for (Index a = 0; a < n; ++a)
    for (Index b = 0; b < n; ++b)
      for (Index c = 0; c < n; ++c) out.push_back(lift + axis(a) + axis(b) + axis(c));
  std::sort(out.begin(), out.end());
  return out;
}

/// Symmetric positive definite, about `per_row` entries a row: Laplacian of a random graph plus a
/// positive diagonal.
inline Csr random_definite(Index n, int per_row, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> weight(0.1, 1.0);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
  for (Index i = 0; i < n; ++i) {
    a(i, i) += weight(random);
    for (int k = 0; k < per_row / 2; ++k) {
      const auto j = static_cast<Index>(random() % n);
      if (j == i) continue;
      const double w = weight(random);
      a(i, i) += w;
      a(j, j) += w;
      a(i, j) -= w;
      a(j, i) -= w;
    }
  }
  return sparse(a);
}

inline Eigen::VectorXd random_mass(Index n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> weight(0.5, 2.0);
  return Eigen::VectorXd::NullaryExpr(n, [&] { return weight(random); });
}

/// All eigenvalues of K x = lambda M x by Eigen, ascending.
inline Eigen::VectorXd reference_eigenvalues(const Csr& k, const Eigen::VectorXd& mass) {
  const Eigen::VectorXd scale = mass.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd a = scale.asDiagonal() * dense(k) * scale.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(a, Eigen::EigenvaluesOnly).eigenvalues();
}

}  // namespace perimode::test
