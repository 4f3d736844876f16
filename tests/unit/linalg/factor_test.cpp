// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/linalg/factor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "matrices.hpp"
#include "perimode/core/error.hpp"

namespace perimode {
namespace {

Eigen::MatrixXd shifted(const Csr& k, double sigma, const Eigen::VectorXd& mass) {
  Eigen::MatrixXd a = test::dense(k);
  a.diagonal() -= sigma * mass;
  return a;
}

/// Backward stable solves leave |A x - b| of a small multiple of n eps |A| |x|.
double relative_residual(const Eigen::MatrixXd& a, const Eigen::MatrixXd& x, const Eigen::MatrixXd& b) {
  return (a * x - b).norm() / (a.norm() * x.norm());
}
constexpr double stable = 1e-13;

TEST(FillReducingOrder, IsAPermutationThatKeepsTheDofsOfANodeTogether) {
  const Csr lattice = test::periodic_lattice(6, 1.0);
  std::vector<Index> node(lattice.rows);
  for (Index i = 0; i < lattice.rows; ++i) node[i] = i / 3;
  const std::vector<Index> order = fill_reducing_order(lattice, node);
  std::vector<Index> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  std::vector<Index> all(lattice.rows);
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(sorted, all);
  for (std::size_t k = 0; k < order.size(); k += 3) {
    EXPECT_EQ(order[k] % 3, 0);
    EXPECT_EQ(order[k + 1], order[k] + 1);
    EXPECT_EQ(order[k + 2], order[k] + 2);
  }
}

TEST(FillReducingOrder, BeatsTheNaturalOrderOfALattice) {
  const Csr lattice = test::periodic_lattice(12, 1.0);
  std::vector<Index> natural(lattice.rows);
  std::iota(natural.begin(), natural.end(), 0);
  EXPECT_LT(predict_fill(lattice, {}).nonzeros,
            0.7 * CholeskyFactor::with_order(lattice, natural).fill().nonzeros);
}

TEST(PredictFill, CountsWhatTheFactorHolds) {
  const Csr lattice = test::periodic_lattice(9, 1.0);
  const FillEstimate predicted = predict_fill(lattice, {});
  const FillEstimate real = CholeskyFactor(lattice, {}).fill();
  EXPECT_EQ(predicted.nonzeros, real.nonzeros);
  EXPECT_EQ(predicted.flops, real.flops);
  EXPECT_GE(real.factor_bytes, 8.0 * real.nonzeros);
  EXPECT_GT(predicted.peak_bytes, predicted.factor_bytes);
}

TEST(CholeskyFactor, SolvesAnyNumberOfRightHandSides) {
  const Csr k = test::random_definite(200, 8, 1);
  const Eigen::VectorXd mass = test::random_mass(200, 2);
  CholeskyFactor factor(k, {});
  ASSERT_EQ(factor.factorize(k, -0.3, mass), FactorStatus::done);
  const Eigen::MatrixXd a = shifted(k, -0.3, mass);
  for (const int columns : {1, 2, 3, 4, 5, 8, 9, 13, 24}) {
    const Eigen::MatrixXd b = Eigen::MatrixXd::NullaryExpr(
        200, columns, [](Eigen::Index i, Eigen::Index j) { return std::sin(1.0 + 3.0 * i + 7.0 * j); });
    EXPECT_LE(relative_residual(a, factor.solve(b), b), stable) << columns;
  }
}

TEST(CholeskyFactor, FactorsAgainWithAnotherShiftOnOneAnalysis) {
  const Csr k = test::periodic_lattice(6, 1.0);
  const Eigen::VectorXd mass = test::random_mass(k.rows, 5);
  const Eigen::MatrixXd b = Eigen::MatrixXd::Ones(k.rows, 2);
  CholeskyFactor factor(k, {});
  for (const double sigma : {0.0, -2.0, 0.25}) {
    ASSERT_EQ(factor.factorize(k, sigma, mass), FactorStatus::done);
    EXPECT_LE(relative_residual(shifted(k, sigma, mass), factor.solve(b), b), stable) << sigma;
  }
}

TEST(CholeskyFactor, ReportsIndefiniteAndSingularMatrices) {
  const Csr free = test::chain(100, false);
  const Eigen::VectorXd mass = Eigen::VectorXd::Ones(100);
  CholeskyFactor factor(free, {});
  EXPECT_EQ(factor.factorize(free, 0.0, mass), FactorStatus::not_positive_definite);
  EXPECT_EQ(factor.factorize(free, 0.5, mass), FactorStatus::not_positive_definite);
  EXPECT_EQ(factor.factorize(free, -0.5, mass), FactorStatus::done);
}

TEST(IndefiniteFactor, CountsTheEigenvaluesBelowAShift) {
  const Csr k = test::random_definite(150, 8, 7);
  const Eigen::VectorXd mass = test::random_mass(150, 8);
  const Eigen::VectorXd all = test::reference_eigenvalues(k, mass);
  const std::vector<Index> order = fill_reducing_order(k, {});
  for (const Index below : {0, 1, 40, 149, 150}) {
    const double sigma = below == 0     ? 0.5 * all[0]
                         : below == 150 ? 2.0 * all[149]
                                        : 0.5 * (all[below - 1] + all[below]);
    EXPECT_EQ(IndefiniteFactor(k, sigma, mass, order).negative_pivots(), below);
  }
}

TEST(IndefiniteFactor, SolvesAnyNumberOfRightHandSides) {
  const Csr k = test::random_definite(150, 8, 9);
  const Eigen::VectorXd mass = test::random_mass(150, 10);
  const IndefiniteFactor factor(k, 2.0, mass, fill_reducing_order(k, {}));
  for (const int columns : {1, 4, 7}) {
    const Eigen::MatrixXd b = Eigen::MatrixXd::NullaryExpr(
        150, columns, [](Eigen::Index i, Eigen::Index j) { return std::cos(1.0 + 5.0 * i + 3.0 * j); });
    EXPECT_LE(relative_residual(shifted(k, 2.0, mass), factor.solve(b), b), stable) << columns;
  }
}

TEST(LuFactor, SolvesWithTheMatrixAndItsTranspose) {
  Eigen::MatrixXd a = test::dense(test::random_definite(120, 6, 13));
  a.triangularView<Eigen::StrictlyUpper>() *= 0.5;
  const Csr k = test::sparse(a);
  const Eigen::VectorXd mass = test::random_mass(120, 14);
  const Eigen::MatrixXd shifted_a = shifted(k, -0.2, mass);
  const LuFactor factor(k, -0.2, mass);
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(120, -1.0, 2.0);
  EXPECT_LE(relative_residual(shifted_a, factor.solve(b), b), stable);
  EXPECT_LE(relative_residual(shifted_a.transpose(), factor.solve_transposed(b), b), stable);
}

TEST(LuFactor, RefusesASingularMatrix) {
  const Csr k = test::diagonal(Eigen::VectorXd::LinSpaced(5, 0.0, 4.0));
  EXPECT_THROW(LuFactor(k, 1.0, Eigen::VectorXd::Ones(5)), Error);
}

}  // namespace
}  // namespace perimode
