// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/linalg/eigen.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "matrices.hpp"
#include "perimode/core/error.hpp"

namespace perimode {
namespace {

using test::reference_eigenvalues;

/// Round-off of an eigenvalue is eps |A|; n |A| eps with room is 1e-11 for these small matrices.
constexpr double tight = 1e-11;

void expect_values(const EigenResult& result, const std::vector<double>& expected) {
  ASSERT_EQ(result.status, EigenStatus::converged) << result.message;
  ASSERT_EQ(result.value.size(), static_cast<Eigen::Index>(expected.size()));
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(result.value[static_cast<Eigen::Index>(i)], expected[i], tight * std::max(1.0, expected[i]))
        << i;
}

/// |K x - lambda M x| <= 1e-9 lambda |M x| and X^T M X = 1.
void expect_pairs(const EigenProblem& problem, const EigenResult& result) {
  const Eigen::MatrixXd mx = problem.mass->asDiagonal() * result.vector;
  const Eigen::MatrixXd r = multiply(*problem.stiffness, result.vector) - mx * result.value.asDiagonal();
  for (Eigen::Index j = 0; j < r.cols(); ++j)
    EXPECT_LE(r.col(j).norm(), 1e-9 * std::max(result.value[j], 1e-3) * mx.col(j).norm()) << "mode " << j;
  const Eigen::MatrixXd gram = result.vector.transpose() * mx;
  EXPECT_LE((gram - Eigen::MatrixXd::Identity(r.cols(), r.cols())).cwiseAbs().maxCoeff(), 1e-10);
}

class LowestModes : public testing::TestWithParam<EigenEngine> {
 protected:
  static EigenOptions options(int count) { return {.count = count, .engine = GetParam(), .dense_limit = 0}; }
};
/// Ranges and shifts too: not without a factor.
class Engine : public LowestModes {};

std::string engine_name(const testing::TestParamInfo<EigenEngine>& info) {
  switch (info.param) {
    case EigenEngine::lanczos:
      return "lanczos";
    case EigenEngine::arpack:
      return "arpack";
    case EigenEngine::chebyshev:
      return "chebyshev";
    case EigenEngine::inverse:
      return "inverse";
    default:
      return "dense";
  }
}
INSTANTIATE_TEST_SUITE_P(All, LowestModes,
                         testing::Values(EigenEngine::lanczos, EigenEngine::arpack, EigenEngine::dense,
                                         EigenEngine::chebyshev, EigenEngine::inverse),
                         engine_name);
INSTANTIATE_TEST_SUITE_P(All, Engine,
                         testing::Values(EigenEngine::lanczos, EigenEngine::arpack, EigenEngine::dense),
                         engine_name);

TEST_P(LowestModes, FindsTheLowestModesOfARandomDefinitePencil) {
  const Csr k = test::random_definite(300, 8, 3);
  const Eigen::VectorXd mass = test::random_mass(300, 4);
  const Eigen::VectorXd all = reference_eigenvalues(k, mass);
  const EigenProblem problem{.stiffness = &k, .mass = &mass};
  const EigenResult result = solve_eigen(problem, options(15));
  expect_values(result, {all.begin(), all.begin() + 15});
  expect_pairs(problem, result);
  EXPECT_TRUE(result.certificate.complete);
}

TEST_P(LowestModes, ReproducesTheClampedChain) {
  const Index n = 400;
  const Csr k = test::chain(n, true);
  const Eigen::VectorXd mass = Eigen::VectorXd::Ones(n);
  std::vector<double> expected;
  for (int j = 1; j <= 12; ++j) expected.push_back(4.0 * std::pow(std::sin(0.5 * M_PI * j / (n + 1)), 2));
  const EigenProblem problem{.stiffness = &k, .mass = &mass};
  const EigenResult result = solve_eigen(problem, options(12));
  expect_values(result, expected);
}

TEST_P(LowestModes, FindsEveryCopyOfAnEigenvalueOfMultiplicity24) {
  Eigen::VectorXd value(320);
  value.setLinSpaced(3.0, 40.0);
  value.segment(100, 24).setConstant(2.0);
  value.segment(10, 12).setConstant(1.0);
  value.segment(200, 2).setConstant(1.5);
  const Csr k = test::diagonal(value);
  const Eigen::VectorXd mass = Eigen::VectorXd::Constant(320, 0.5);
  std::vector<double> expected(12, 2.0);
  expected.insert(expected.end(), 2, 3.0);
  expected.insert(expected.end(), 24, 4.0);
  const EigenResult result = solve_eigen({.stiffness = &k, .mass = &mass}, options(38));
  expect_values(result, expected);
  EXPECT_TRUE(result.certificate.complete);
}

TEST_P(LowestModes, FindsTheMultipletsOfAPeriodicLattice) {
  const Csr k = test::periodic_lattice(8, 0.1);
  const Eigen::VectorXd mass = Eigen::VectorXd::Ones(k.rows);
  const std::vector<double> all = test::periodic_lattice_eigenvalues(8, 0.1);
  // 1, 6, 12, 8 + 6 and 24 copies
  const EigenProblem problem{.stiffness = &k, .mass = &mass};
  const EigenResult result = solve_eigen(problem, options(57));
  expect_values(result, {all.begin(), all.begin() + 57});
  expect_pairs(problem, result);
}

TEST_P(LowestModes, ReturnsAPartOfAMultipletCutByTheCount) {
  const Csr k = test::periodic_lattice(7, 0.1);
  const Eigen::VectorXd mass = Eigen::VectorXd::Ones(k.rows);
  const std::vector<double> all = test::periodic_lattice_eigenvalues(7, 0.1);
  const EigenResult result = solve_eigen({.stiffness = &k, .mass = &mass}, options(10));  // 1 + 6 + 3 of 12
  expect_values(result, {all.begin(), all.begin() + 10});
  EXPECT_TRUE(result.certificate.complete);
  EXPECT_GE(result.certificate.count, 19);
}

TEST_P(LowestModes, LeavesOutTheKnownNullVector) {
  const Index n = 350;
  const Csr k = test::chain(n, false);
  const Eigen::VectorXd mass = Eigen::VectorXd::Constant(n, 2.0);
  const Eigen::MatrixXd known = Eigen::MatrixXd::Constant(n, 1, 1.0 / std::sqrt(2.0 * n));
  std::vector<double> expected;
  for (int j = 1; j <= 8; ++j) expected.push_back(2.0 * std::pow(std::sin(0.5 * M_PI * j / n), 2));
  EigenOptions request = options(8);
  request.scale = expected[0];
  const EigenProblem problem{.stiffness = &k, .mass = &mass, .known = &known};
  const EigenResult result = solve_eigen(problem, request);
  expect_values(result, expected);
  EXPECT_LE((known.transpose() * (mass.asDiagonal() * result.vector)).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_TRUE(result.certificate.complete);
}

TEST_P(LowestModes, FindsMechanismsNobodyKnewOf) {
  Eigen::VectorXd value = Eigen::VectorXd::LinSpaced(200, 1.0, 9.0);
  value.head(5).setZero();
  const Csr k = test::diagonal(value);
  const Eigen::VectorXd mass = Eigen::VectorXd::Ones(200);
  const EigenResult result = solve_eigen({.stiffness = &k, .mass = &mass}, options(7));
  expect_values(result, {0, 0, 0, 0, 0, value[5], value[6]});
}

TEST_P(Engine, FindsAllModesOfARange) {
  const Csr k = test::random_definite(300, 6, 11);
  const Eigen::VectorXd mass = test::random_mass(300, 12);
  const Eigen::VectorXd all = reference_eigenvalues(k, mass);
  EigenOptions request = options(1);
  request.has_range = true;
  request.lower = 0.5 * (all[149] + all[150]);
  request.upper = 0.5 * (all[169] + all[170]);
  const EigenResult result = solve_eigen({.stiffness = &k, .mass = &mass}, request);
  expect_values(result, {all.begin() + 150, all.begin() + 170});
  EXPECT_TRUE(result.certificate.complete);
}

TEST_P(Engine, IncludesEigenvaluesAtTheEndsOfARange) {
  const Csr k = test::periodic_lattice(7, 0.1);
  const Eigen::VectorXd mass = Eigen::VectorXd::Ones(k.rows);
  const std::vector<double> all = test::periodic_lattice_eigenvalues(7, 0.1);
  EigenOptions request = options(1);
  request.has_range = true;
  request.lower = all[7];  // 12 copies, then 6 + 8 more levels
  request.upper = all[19];
  const auto last = std::upper_bound(all.begin(), all.end(), request.upper + 1e-9);
  const EigenResult result = solve_eigen({.stiffness = &k, .mass = &mass}, request);
  expect_values(result, {all.begin() + 7, last});
}

TEST_P(Engine, FindsTheModesNearestToAShift) {
  const Csr k = test::random_definite(300, 6, 21);
  const Eigen::VectorXd mass = test::random_mass(300, 22);
  const Eigen::VectorXd all = reference_eigenvalues(k, mass);
  EigenOptions request = options(9);
  request.has_shift = true;
  request.shift = all[120] + 0.3 * (all[121] - all[120]);
  std::vector<double> expected(all.begin(), all.end());
  std::sort(expected.begin(), expected.end(),
            [&](double a, double b) { return std::abs(a - request.shift) < std::abs(b - request.shift); });
  expected.resize(9);
  std::sort(expected.begin(), expected.end());
  const EigenResult result = solve_eigen({.stiffness = &k, .mass = &mass}, request);
  expect_values(result, expected);
  EXPECT_TRUE(result.certificate.complete);
}

TEST_P(Engine, FindsTheLargestModesFromAShiftFarAboveTheSpectrum) {
  const Csr k = test::random_definite(375, 8, 23);
  const Eigen::VectorXd mass = test::random_mass(375, 24);
  const Eigen::VectorXd all = reference_eigenvalues(k, mass);
  for (const double factor : {1.5, 1e4, 1e20}) {
    EigenOptions request = options(8);
    request.has_shift = true;
    request.shift = factor * all[374];
    const EigenResult result = solve_eigen({.stiffness = &k, .mass = &mass}, request);
    expect_values(result, {all.end() - 8, all.end()});
    EXPECT_LE(result.solves, 2000) << factor;
  }
}

TEST(Eigen, ServesARangeOfManyModesFromSeveralShifts) {
  const Index n = 5000;
  const Csr k = test::chain(n, true);
  const Eigen::VectorXd mass = Eigen::VectorXd::Ones(n);
  EigenOptions request{.has_range = true, .lower = 1.001, .upper = 1.201};
  const EigenResult result = solve_eigen({.stiffness = &k, .mass = &mass}, request);
  std::vector<double> expected;
  for (int j = 1; j <= n; ++j) {
    const double value = 4.0 * std::pow(std::sin(0.5 * M_PI * j / (n + 1)), 2);
    if (value >= request.lower && value <= request.upper) expected.push_back(value);
  }
  ASSERT_GT(expected.size(), 150U);
  expect_values(result, expected);
  EXPECT_TRUE(result.certificate.complete);
}

TEST(Eigen, GivesTheSameBitsTwice) {
  const Csr k = test::random_definite(400, 8, 31);
  const Eigen::VectorXd mass = test::random_mass(400, 32);
  const EigenOptions request{.count = 6, .engine = EigenEngine::lanczos};
  const EigenResult a = solve_eigen({.stiffness = &k, .mass = &mass}, request);
  const EigenResult b = solve_eigen({.stiffness = &k, .mass = &mass}, request);
  EXPECT_EQ(a.value, b.value);
  EXPECT_EQ(a.vector, b.vector);
}

TEST(Eigen, ReturnsEveryModeWhenAllAreAskedFor) {
  const Csr k = test::chain(40, true);
  const Eigen::VectorXd mass = Eigen::VectorXd::Ones(40);
  const Eigen::VectorXd all = reference_eigenvalues(k, mass);
  for (const EigenEngine engine : {EigenEngine::dense, EigenEngine::lanczos}) {
    const EigenResult result = solve_eigen({.stiffness = &k, .mass = &mass}, {.count = 40, .engine = engine});
    expect_values(result, {all.begin(), all.end()});
    EXPECT_EQ(result.certificate.method, "all modes");
  }
}

TEST(Eigen, SaysWhichCertificateItGave) {
  const Csr k = test::random_definite(300, 8, 41);
  const Eigen::VectorXd mass = Eigen::VectorXd::Ones(300);
  EigenOptions request{.count = 5, .engine = EigenEngine::lanczos, .check = CompletenessCheck::inertia};
  const EigenProblem problem{.stiffness = &k, .mass = &mass};
  EXPECT_EQ(solve_eigen(problem, request).certificate.method, "inertia");
  EXPECT_EQ(solve_eigen(problem, request).certificate.count, 5);
  request.check = CompletenessCheck::restart;
  EXPECT_EQ(solve_eigen(problem, request).certificate.method, "restart");
  EXPECT_GT(solve_eigen(problem, request).certificate.solves, 0);
  request.check = CompletenessCheck::none;
  EXPECT_FALSE(solve_eigen(problem, request).certificate.asked);
}

TEST(Eigen, RefusesMasslessDofs) {
  const Csr k = test::chain(5, true);
  Eigen::VectorXd mass = Eigen::VectorXd::Ones(5);
  mass[2] = 0.0;
  EXPECT_THROW((void)solve_eigen({.stiffness = &k, .mass = &mass}, {}), Error);
}

TEST(Eigen, RefusesAnIndefiniteStiffness) {
  const Csr k = test::diagonal(Eigen::VectorXd::LinSpaced(50, -1.0, 1.0));
  const Eigen::VectorXd mass = Eigen::VectorXd::Ones(50);
  EXPECT_THROW(
      (void)solve_eigen({.stiffness = &k, .mass = &mass}, {.count = 3, .engine = EigenEngine::lanczos}),
      Error);
}

#ifndef PERIMODE_WITH_SLEPC
TEST(Eigen, SaysThatItWasBuiltWithoutSlepc) {
  const Csr k = test::chain(5, true);
  const Eigen::VectorXd mass = Eigen::VectorXd::Ones(5);
  try {
    (void)solve_eigen({.stiffness = &k, .mass = &mass}, {.count = 2, .engine = EigenEngine::slepc});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::environment);
    EXPECT_THAT(error.what(), testing::HasSubstr("PERIMODE_WITH_SLEPC"));
  }
}
#endif

}  // namespace
}  // namespace perimode
