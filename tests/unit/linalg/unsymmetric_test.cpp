// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <complex>

#include "matrices.hpp"
#include "perimode/linalg/eigen.hpp"

namespace perimode {
namespace {

/// M^1/2 (S T S^-1) M^1/2 with T symmetric tridiagonal and S diagonal: unsymmetric, real spectrum
/// of T known: 2 + shift - 2 cos(pi j / (n + 1)).
struct ScaledChain {
  Csr k;
  Eigen::VectorXd mass;
  std::vector<double> value;

  ScaledChain(Index n, double shift) : k(test::chain(n, true)), mass(test::random_mass(n, 3)) {
    const Eigen::VectorXd s = test::random_mass(n, 4);
    for (Index i = 0; i < n; ++i) {
      value.push_back(4.0 * std::pow(std::sin(0.5 * M_PI * (i + 1) / (n + 1)), 2) + shift);
      for (Offset e = k.row_start[i]; e < k.row_start[i + 1]; ++e) {
        const Index j = k.column[e];
        if (i == j) k.value[e] += shift;
        k.value[e] *= s[i] / s[j] * std::sqrt(mass[i] * mass[j]);
      }
    }
  }
};

void expect_pairs(const Csr& k, const Eigen::VectorXd& mass, const UnsymmetricEigenResult& result,
                  double tolerance) {
  const Eigen::MatrixXcd a = test::dense(k).cast<std::complex<double>>();
  const Eigen::VectorXcd m = mass.cast<std::complex<double>>();
  const Eigen::MatrixXcd right = a * result.right - m.asDiagonal() * result.right * result.value.asDiagonal();
  const Eigen::MatrixXcd left =
      a.adjoint() * result.left - m.asDiagonal() * result.left * result.value.conjugate().asDiagonal();
  const double scale = a.norm();
  for (Eigen::Index j = 0; j < result.value.size(); ++j) {
    EXPECT_LE(right.col(j).norm(), tolerance * scale * result.right.col(j).norm()) << j;
    EXPECT_LE(left.col(j).norm(), tolerance * scale * result.left.col(j).norm()) << j;
    EXPECT_NEAR(std::abs(result.right.col(j).dot(m.asDiagonal() * result.right.col(j))), 1.0, 1e-12);
  }
  const Eigen::MatrixXcd gram = result.left.adjoint() * m.asDiagonal() * result.right;
  EXPECT_LE((gram - Eigen::MatrixXcd::Identity(gram.rows(), gram.cols())).cwiseAbs().maxCoeff(), 1e-8);
}

class Unsymmetric : public testing::TestWithParam<EigenEngine> {
 protected:
  static EigenOptions options(int count) { return {.count = count, .engine = GetParam()}; }
};
INSTANTIATE_TEST_SUITE_P(Engines, Unsymmetric, testing::Values(EigenEngine::dense, EigenEngine::arpack));

TEST_P(Unsymmetric, FindsTheKnownSpectrumWithBothVectors) {
  const ScaledChain chain(200, 0.1);
  const EigenProblem problem{.stiffness = &chain.k, .mass = &chain.mass};
  const UnsymmetricEigenResult result = solve_unsymmetric(problem, options(10));
  ASSERT_EQ(result.status, EigenStatus::converged) << result.message;
  ASSERT_EQ(result.value.size(), 10);
  for (int j = 0; j < 10; ++j) EXPECT_NEAR(result.value[j].real(), chain.value[j], 1e-11);
  EXPECT_LE(result.imaginary, 1e-12);
  EXPECT_NEAR(result.largest, chain.value.back(), 5e-3 * chain.value.back());
  EXPECT_TRUE(result.certificate.complete);
  expect_pairs(chain.k, chain.mass, result, 1e-11);
}

TEST_P(Unsymmetric, FindsComplexPairs) {
  // Blocks [a b; -b a] have a +- i b.
  const Index pairs = 60;
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * pairs, 2 * pairs);
  for (Index p = 0; p < pairs; ++p) {
    a.block(2 * p, 2 * p, 2, 2) << 1.0 + p, 0.25, -0.25, 1.0 + p;
    if (p > 0) a(2 * p - 1, 2 * p) = 0.1;  // block triangular: the spectrum stays
  }
  const Csr k = test::sparse(a);
  const Eigen::VectorXd mass = Eigen::VectorXd::Ones(2 * pairs);
  const UnsymmetricEigenResult result = solve_unsymmetric({.stiffness = &k, .mass = &mass}, options(6));
  ASSERT_EQ(result.status, EigenStatus::converged) << result.message;
  ASSERT_EQ(result.value.size(), 6);
  for (int j = 0; j < 6; ++j) {
    EXPECT_NEAR(result.value[j].real(), 1.0 + j / 2, 1e-11);
    EXPECT_NEAR(std::abs(result.value[j].imag()), 0.25, 1e-11);
  }
  EXPECT_NEAR(result.imaginary, 0.25 / std::abs(result.value[5]), 1e-11);
  expect_pairs(k, mass, result, 1e-12);
}

TEST_P(Unsymmetric, FindsEveryCopyOfARepeatedEigenvalue) {
  const Index n = 150;
  Eigen::VectorXd value = Eigen::VectorXd::LinSpaced(n, 2.0, 30.0);
  value.head(6).setConstant(1.0);
  // A similarity by I + nilpotent keeps the spectrum and makes left and right vectors differ.
  Eigen::MatrixXd s = Eigen::MatrixXd::Identity(n, n), back = s;
  for (Index i = 0; i + 75 < n; ++i) {
    s(i, i + 75) = 0.5;
    back(i, i + 75) = -0.5;
  }
  const Csr k = test::sparse(s * value.asDiagonal() * back);
  const Eigen::VectorXd mass = test::random_mass(n, 9);
  Csr scaled = k;
  for (Index i = 0; i < n; ++i)
    for (Offset e = k.row_start[i]; e < k.row_start[i + 1]; ++e)
      scaled.value[e] *= std::sqrt(mass[i] * mass[k.column[e]]);
  const UnsymmetricEigenResult result = solve_unsymmetric({.stiffness = &scaled, .mass = &mass}, options(8));
  ASSERT_EQ(result.status, EigenStatus::converged) << result.message;
  for (int j = 0; j < 6; ++j) EXPECT_NEAR(result.value[j].real(), 1.0, 1e-10);
  EXPECT_NEAR(result.value[6].real(), value[6], 1e-10);
  EXPECT_NEAR(result.value[7].real(), value[7], 1e-10);
  expect_pairs(scaled, mass, result, 1e-11);
}

}  // namespace
}  // namespace perimode
