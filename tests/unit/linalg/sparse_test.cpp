// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/linalg/sparse.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "matrices.hpp"
#include "perimode/core/error.hpp"
#include "perimode/linalg/threads.hpp"

namespace perimode {
namespace {

/// Blocked periodic-free chain of 3 block rows with distinct entries.
BlockCsr blocks(int block) {
  BlockCsr out;
  out.block = block;
  out.rows = 3;
  out.row_start = {0, 2, 5, 7};
  out.column = {0, 1, 0, 1, 2, 1, 2};
  out.value.resize(7 * block * block);
  std::iota(out.value.begin(), out.value.end(), 1.0);
  return out;
}

Eigen::MatrixXd dense(const BlockCsr& matrix) {
  const int b = matrix.block;
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(matrix.rows * b, matrix.rows * b);
  for (Index i = 0; i < matrix.rows; ++i)
    for (Offset e = matrix.row_start[i]; e < matrix.row_start[i + 1]; ++e)
      for (int r = 0; r < b; ++r)
        for (int c = 0; c < b; ++c)
          out(i * b + r, matrix.column[e] * b + c) = matrix.value[(e * b + r) * b + c];
  return out;
}

class Blocks : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Sizes, Blocks, testing::Values(1, 2, 3));

TEST_P(Blocks, MultiplyLikeTheDenseMatrix) {
  const BlockCsr k = blocks(GetParam());
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(3 * GetParam(), -1.0, 2.0);
  Eigen::VectorXd y(x.size());
  multiply(k, {x.data(), static_cast<std::size_t>(x.size())}, {y.data(), static_cast<std::size_t>(y.size())});
  EXPECT_LE((y - dense(k) * x).norm(), 1e-14 * dense(k).norm() * x.norm());
}

TEST_P(Blocks, BecomeScalarRowsWithAscendingColumns) {
  const BlockCsr k = blocks(GetParam());
  std::vector<Index> number(3 * GetParam());
  std::iota(number.begin(), number.end(), 0);
  const Csr scalar = scalar_csr(k, number);
  EXPECT_EQ(test::dense(scalar), dense(k));
  for (Index i = 0; i < scalar.rows; ++i)
    EXPECT_TRUE(std::is_sorted(scalar.column.begin() + scalar.row_start[i],
                               scalar.column.begin() + scalar.row_start[i + 1]));
}

TEST(ScalarCsr, StrikesOutDofsAndKeepsOnlyDiagonalZeros) {
  BlockCsr k = blocks(2);
  k.value[0] = 0.0;  // (0, 0)
  k.value[1] = 0.0;  // (0, 1)
  const std::vector<Index> number = {0, 1, -1, 2, 3, -1};
  const Csr scalar = scalar_csr(k, number);
  const std::vector<Index> kept = {0, 1, 3, 4};
  EXPECT_EQ(scalar.rows, 4);
  EXPECT_EQ(test::dense(scalar), dense(k)(kept, kept));
  EXPECT_EQ(scalar.column[0], 0);
  EXPECT_EQ(scalar.value[0], 0.0);
  EXPECT_NE(scalar.column[1], 1);

  const Csr roomy = scalar_csr(k, number, Zeros::keep);
  EXPECT_EQ(test::dense(roomy), test::dense(scalar));
  EXPECT_EQ(roomy.column[1], 1);
  EXPECT_EQ(roomy.nonzeros(), scalar.nonzeros() + 1);
}

TEST(Csr, MultipliesVectorsAndBlocksOfVectors) {
  const Csr k = test::random_definite(50, 6, 1);
  const Eigen::MatrixXd x = Eigen::MatrixXd::NullaryExpr(
      50, 5, [](Eigen::Index i, Eigen::Index j) { return std::sin(1.0 + i + 10.0 * j); });
  const Eigen::MatrixXd expected = test::dense(k) * x;
  EXPECT_LE((multiply(k, x) - expected).norm(), 1e-14 * expected.norm());
  Eigen::VectorXd y(50);
  multiply(k, {x.data(), 50}, {y.data(), 50});
  EXPECT_LE((y - expected.col(0)).norm(), 1e-14 * expected.norm());
}

TEST(Csr, MultipliesToTheSameBitsForAnyThreadCount) {
  const Csr k = test::periodic_lattice(12, 0.1);
  const Eigen::MatrixXd x = Eigen::MatrixXd::NullaryExpr(
      k.rows, 3, [](Eigen::Index i, Eigen::Index j) { return std::cos(0.1 * i + j); });
  const int before = threads();
  set_threads(1);
  const Eigen::MatrixXd one = multiply(k, x);
  set_threads(3);
  const Eigen::MatrixXd three = multiply(k, x);
  set_threads(before);
  EXPECT_EQ(one, three);
}

TEST(Asymmetry, IsZeroForSymmetricAndRelativeOtherwise) {
  Eigen::MatrixXd a = test::dense(test::random_definite(30, 6, 2));
  EXPECT_EQ(asymmetry(test::sparse(a)), 0.0);
  const double largest = a.cwiseAbs().maxCoeff();
  a(0, 29) += 0.25 * largest;
  EXPECT_NEAR(asymmetry(test::sparse(a)), 0.25, 1e-15);
}

TEST(NormInf, IsTheLargestAbsoluteRowSum) {
  EXPECT_EQ(norm_inf(test::chain(5, true)), 4.0);
  EXPECT_EQ(norm_inf(test::diagonal(Eigen::VectorXd::LinSpaced(3, -7.0, 1.0))), 7.0);
}

TEST(SetThreads, RefusesLessThanOne) { EXPECT_THROW(set_threads(0), Error); }

}  // namespace
}  // namespace perimode
