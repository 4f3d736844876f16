// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/linalg/conjugate_gradients.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>
#include <random>

#include "linalg/fused.hpp"
#include "matrices.hpp"
#include "perimode/core/error.hpp"
#include "perimode/linalg/threads.hpp"

namespace perimode {
namespace {

using ::testing::HasSubstr;

Eigen::VectorXd random_vector(Eigen::Index n, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  return Eigen::VectorXd::NullaryExpr(n, [&] { return normal(random); });
}

double true_residual(const Csr& a, const Eigen::VectorXd& x, const Eigen::VectorXd& b) {
  return (b - multiply(as_operator(a), x)).norm() / b.norm();
}

CgResult solve(const Csr& a, const Eigen::VectorXd& b, const CgOptions& options = {},
               const LinearOperator& preconditioner = {}) {
  return conjugate_gradients(as_operator(a), b, preconditioner, options);
}

/// In exact arithmetic the iteration ends after as many steps as there are distinct eigenvalues.
TEST(ConjugateGradients, TakeOneIterationPerDistinctEigenvalue) {
  for (int distinct = 1; distinct <= 6; ++distinct) {
    Eigen::VectorXd d(600);
    for (int i = 0; i < 600; ++i) d[i] = 1.0 + i % distinct;
    const Eigen::VectorXd b = random_vector(600, 1);
    const CgResult r = solve(test::diagonal(d), b, {.tolerance = 1e-12, .most_iterations = 100});
    EXPECT_TRUE(r.converged) << r.message;
    EXPECT_EQ(r.iterations, distinct);
    EXPECT_LT((r.x - b.cwiseQuotient(d)).norm(), 1e-12 * b.norm());
  }
}

TEST(ConjugateGradients, AgreeWithACholeskyFactor) {
  const Csr a = test::random_definite(700, 8, 3);
  const Eigen::VectorXd b = random_vector(700, 2);
  CholeskyFactor factor(a, {});
  ASSERT_EQ(factor.factorize(a, 0.0, Eigen::VectorXd::Zero(a.rows)), FactorStatus::done);
  const Eigen::VectorXd exact = factor.solve(b);
  const CgResult r = solve(a, b, {.tolerance = 1e-12});
  EXPECT_TRUE(r.converged) << r.message;
  EXPECT_LT((r.x - exact).norm(), 1e-9 * exact.norm());  // 1e-12 times the condition number, < 1000
  EXPECT_LE(true_residual(a, r.x, b), 1e-12 * (1.0 + 1e-12));
}

TEST(ConjugateGradients, WithTheFactorOfTheMatrixTakeOneIteration) {
  const Csr a = test::chain(300, true);
  CholeskyFactor factor(a, {});
  ASSERT_EQ(factor.factorize(a, 0.0, Eigen::VectorXd::Zero(a.rows)), FactorStatus::done);
  const Eigen::VectorXd b = random_vector(300, 4);
  const CgResult r = solve(a, b, {.tolerance = 1e-10}, factor_preconditioner(factor, 300));
  EXPECT_TRUE(r.converged) << r.message;
  EXPECT_EQ(r.iterations, 1);
}

/// K - k b b^T with the factor of K has two distinct eigenvalues per broken bond at most: one more each.
TEST(ConjugateGradients, WithAStaleFactorTakeOneIterationMorePerBrokenBond) {
  const Csr lattice = test::periodic_lattice(6, 0.1);
  CholeskyFactor factor(lattice, {});
  ASSERT_EQ(factor.factorize(lattice, 0.0, Eigen::VectorXd::Zero(lattice.rows)), FactorStatus::done);
  Eigen::MatrixXd broken = test::dense(lattice);
  for (int k = 0; k < 5; ++k) {
    const int i = 40 * k, j = i + 1;
    broken(i, i) -= 1.0;
    broken(j, j) -= 1.0;
    broken(i, j) += 1.0;
    broken(j, i) += 1.0;
  }
  const Csr a = test::sparse(broken);
  const Eigen::VectorXd b = random_vector(a.rows, 5);
  const CgResult r = solve(a, b, {.tolerance = 1e-10}, factor_preconditioner(factor, a.rows));
  EXPECT_TRUE(r.converged) << r.message;
  EXPECT_LE(r.iterations, 6);
  EXPECT_LT(true_residual(a, r.x, b), 1e-10);
}

/// A free chain: constants are the null space, b without them has solutions that differ by a constant.
TEST(ConjugateGradients, SolveASingularConsistentSystem) {
  const Csr a = test::chain(200, false);
  Eigen::VectorXd b = random_vector(200, 6);
  b.array() -= b.mean();
  const CgResult r = solve(a, b, {.tolerance = 1e-10});
  EXPECT_TRUE(r.converged) << r.message;
  EXPECT_LT(true_residual(a, r.x, b), 1e-10);
  EXPECT_NEAR(r.x.mean(), 0.0, 1e-9 * r.x.norm());  // from x = 0 nothing of the null space comes in
}

TEST(ConjugateGradients, ReportAMatrixThatIsNotPositiveDefinite) {
  Eigen::VectorXd d = Eigen::VectorXd::Ones(50);
  d[7] = -1.0;
  const CgResult r = solve(test::diagonal(d), Eigen::VectorXd::Unit(50, 7));
  EXPECT_FALSE(r.converged);
  EXPECT_THAT(r.message, HasSubstr("matrix is not positive definite"));
  EXPECT_EQ(r.residual, 1.0);
}

TEST(ConjugateGradients, ReportAPreconditionerThatIsNotPositiveDefinite) {
  const Csr minus = test::diagonal(-Eigen::VectorXd::Ones(50));
  const CgResult r = solve(test::chain(50, true), random_vector(50, 7), {}, as_operator(minus));
  EXPECT_FALSE(r.converged);
  EXPECT_THAT(r.message, HasSubstr("preconditioner is not positive definite"));
}

TEST(ConjugateGradients, ReportTheLimitOfIterationsAndTheResidualReached) {
  const Csr a = test::chain(1000, true);
  const Eigen::VectorXd b = random_vector(1000, 8);
  const CgResult r = solve(a, b, {.tolerance = 1e-8, .most_iterations = 10});
  EXPECT_FALSE(r.converged);
  EXPECT_EQ(r.iterations, 10);
  EXPECT_THAT(r.message, HasSubstr("10 iterations"));
  EXPECT_NEAR(r.residual, true_residual(a, r.x, b), 1e-13 * r.residual);
}

/// A load along the softest vector of a chain: round-off in A x, |A| |x| eps ~ 1e-16 * condition number 4e5,
/// lies far above the tolerance, while the residual of the recurrence goes on to fall.
TEST(ConjugateGradients, ReportStagnationInsteadOfLoopingOnRoundOff) {
  const Csr a = test::chain(1000, true);
  Eigen::VectorXd b(1000);
  for (int i = 0; i < 1000; ++i) b[i] = 1.0 + std::sin(M_PI * (i + 1) / 1001.0);
  const CgResult r = solve(a, b, {.tolerance = 1e-15, .most_iterations = 100000});
  EXPECT_FALSE(r.converged);
  EXPECT_THAT(r.message, HasSubstr("stagnation"));
  EXPECT_LT(r.iterations, 20000);
  EXPECT_LT(r.residual, 1e-9);
  EXPECT_NEAR(r.residual, true_residual(a, r.x, b), 1e-13 * r.residual);
}

TEST(ConjugateGradients, StartFromAGivenVector) {
  const Csr a = test::chain(400, true);
  const Eigen::VectorXd b = random_vector(400, 9);
  const CgResult first = solve(a, b, {.tolerance = 1e-10});
  const CgResult again = conjugate_gradients(as_operator(a), b, {}, {.tolerance = 1e-10}, &first.x);
  EXPECT_TRUE(again.converged);
  EXPECT_EQ(again.iterations, 0);
  EXPECT_EQ(again.x, first.x);
  const Eigen::VectorXd far = random_vector(400, 10);
  const CgResult other = conjugate_gradients(as_operator(a), b, {}, {.tolerance = 1e-10}, &far);
  EXPECT_TRUE(other.converged) << other.message;
  EXPECT_LT(true_residual(a, other.x, b), 1e-10);
}

TEST(ConjugateGradients, GiveZeroForZero) {
  const Eigen::VectorXd start = Eigen::VectorXd::Ones(30);
  const CgResult r =
      conjugate_gradients(as_operator(test::chain(30, true)), Eigen::VectorXd::Zero(30), {}, {}, &start);
  EXPECT_TRUE(r.converged);
  EXPECT_EQ(r.x, Eigen::VectorXd::Zero(30));
  EXPECT_EQ(r.iterations, 0);
  EXPECT_TRUE(conjugate_gradients({0, [](const double*, double*) {}}, {}, {}, {}).converged);
}

TEST(ConjugateGradients, GiveTheSameBitsForAnyNumberOfThreads) {
  const Csr a = test::periodic_lattice(40, 0.01);  // 64000 unknowns: many chunks and a part of one
  const Eigen::VectorXd b = random_vector(a.rows, 11);
  const std::vector<double> diagonal(a.rows, 6.01);
  std::vector<Index> number(a.rows);
  for (Index i = 0; i < a.rows; ++i) number[i] = i;
  const LinearOperator jacobi = block_jacobi(diagonal, 1, number);
  const int before = threads();
  set_threads(1);
  const CgResult one = solve(a, b, {}, jacobi);
  set_threads(2);
  const CgResult two = solve(a, b, {}, jacobi);
  set_threads(before);
  EXPECT_TRUE(one.converged);
  EXPECT_EQ(one.x, two.x);
  EXPECT_EQ(one.iterations, two.iterations);
  EXPECT_EQ(one.residual, two.residual);
}

TEST(ConjugateGradients, RefuseShapesThatDoNotBelongTogether) {
  const Csr a = test::chain(10, true);
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(10);
  const Eigen::VectorXd shorter = Eigen::VectorXd::Ones(9);
  EXPECT_THROW(solve(a, shorter), Error);
  EXPECT_THROW((void)conjugate_gradients(as_operator(a), b, {}, {}, &shorter), Error);
  EXPECT_THROW(solve(a, b, {}, as_operator(test::chain(9, true))), Error);
  EXPECT_THROW(solve(a, b, {.tolerance = 0.0}), Error);
  EXPECT_THROW(solve(a, b, {.tolerance = 1e-8, .most_iterations = -1}), Error);
  EXPECT_THROW(solve(a, b * std::numeric_limits<double>::quiet_NaN()), Error);
  EXPECT_THROW((void)block_jacobi({1.0, 2.0}, 2, std::vector<Index>{0, 1}), Error);
}

/// Blocks with a fixed dof, without a free one, singular, and not positive.
TEST(BlockJacobi, InvertsTheKeptPartOfEachBlock) {
  const std::vector<double> blocks = {4,  1, 1, 3,   // both dofs free
                                      4,  1, 1, 3,   // the second one only
                                      4,  1, 1, 3,   // none
                                      1,  1, 1, 1,   // singular: its diagonal
                                      -2, 0, 0, 5};  // not positive: 1 and 2 * 5
  const std::vector<Index> number = {0, 1, -1, 2, -1, -1, 3, 4, 5, 6};
  const LinearOperator m = block_jacobi(blocks, 2, number);
  ASSERT_EQ(m.size, 7);
  const Eigen::MatrixXd dense = multiply(m, Eigen::MatrixXd(Eigen::MatrixXd::Identity(7, 7)));
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(7, 7);
  expected.block<2, 2>(0, 0) << 3.0 / 11, -1.0 / 11, -1.0 / 11, 4.0 / 11;
  expected.diagonal().tail(5) << 1.0 / 3, 0.5, 0.5, 1.0, 0.1;
  EXPECT_LT((dense - expected).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(BlockJacobi, InvertsBlocksOfOneAndThreeRows) {
  Eigen::Matrix3d a;
  a << 4, 1, 0, 1, 5, 2, 0, 2, 6;
  const std::vector<double> blocks(a.data(), a.data() + 9);
  const LinearOperator m = block_jacobi(blocks, 3, std::vector<Index>{0, 1, 2});
  EXPECT_LT((multiply(m, Eigen::MatrixXd(a)) - Eigen::Matrix3d::Identity()).norm(), 1e-14);
  const LinearOperator scalar = block_jacobi({2.0, 4.0}, 1, std::vector<Index>{0, 1});
  EXPECT_LT(
      (multiply(scalar, Eigen::VectorXd(Eigen::Vector2d(1.0, 1.0))) - Eigen::Vector2d(0.5, 0.25)).norm(),
      1e-15);
}

/// Sums of small integers are exact in any order, so every number of terms can be checked to the last bit.
TEST(Fused, LoopsMissNoNumber) {
  for (const Index n : {0, 1, 7, 8, 9, chunk - 1, chunk, chunk + 1, 6 * chunk + 3}) {
    Eigen::VectorXd a(n), b(n);
    for (Index i = 0; i < n; ++i) {
      a[i] = i % 5;
      b[i] = i % 3 - 1;
    }
    EXPECT_EQ(dot(n, a.data(), b.data()), a.dot(b));
    Eigen::VectorXd r = a;
    EXPECT_EQ(subtract_from(n, b.data(), r.data()), (b - a).squaredNorm());
    EXPECT_EQ(r, Eigen::VectorXd(b - a));
    Eigen::VectorXd x = a, s = b;
    EXPECT_EQ(advance(n, 2.0, a.data(), b.data(), x.data(), s.data()), b.squaredNorm());
    EXPECT_EQ(x, Eigen::VectorXd(3.0 * a));
    EXPECT_EQ(s, Eigen::VectorXd(-b));
    Eigen::VectorXd p = a;
    turn(n, b.data(), 2.0, p.data());
    EXPECT_EQ(p, Eigen::VectorXd(b + 2.0 * a));
  }
}

}  // namespace
}  // namespace perimode
