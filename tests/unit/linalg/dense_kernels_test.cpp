// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/dense_kernels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace perimode {
namespace {

Eigen::MatrixXd waves(Eigen::Index rows, Eigen::Index columns, double phase) {
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&](Eigen::Index i, Eigen::Index j) {
    return std::sin(phase + 0.7 * static_cast<double>(i) + 1.3 * static_cast<double>(j));
  });
}

/// Widths on both sides of what the short-vector kernels take, heights on both sides of "tall",
/// neither a multiple of the panel nor of the lanes.
TEST(DenseKernels, AgreeWithPlainProductsForEveryShape) {
  for (const Eigen::Index rows : {40, 3001})
    for (const Eigen::Index columns : {1, 7, 300})
      for (const Eigen::Index width : {1, 3, 4, 5, 8, 9}) {
        const Eigen::MatrixXd storage = waves(rows, columns + 2, 0.1), b = waves(rows, width, 0.2);
        const auto a = storage.middleCols(1, columns);
        const Eigen::MatrixXd small = waves(columns, width, 0.3);
        const double scale = 1e-14 * static_cast<double>(rows + columns);
        EXPECT_LE((transposed_product(a, b) - a.transpose() * b).cwiseAbs().maxCoeff(), scale);
        Eigen::MatrixXd sum = b;
        add_product(-0.5, a, small, sum);
        EXPECT_LE((sum - (b - 0.5 * a * small)).cwiseAbs().maxCoeff(), scale);
      }
}

TEST(DenseKernels, GiveEigenpairsOfASymmetricMatrixAscending) {
  const Eigen::MatrixXd half = waves(20, 20, 0.4);
  const Eigen::MatrixXd a = half + half.transpose();
  Eigen::MatrixXd vector = a;
  const Eigen::VectorXd value = symmetric_eigen(vector);
  EXPECT_TRUE(std::is_sorted(value.begin(), value.end()));
  EXPECT_LE((a * vector - vector * value.asDiagonal()).norm(), 1e-13 * a.norm());
}

}  // namespace
}  // namespace perimode
