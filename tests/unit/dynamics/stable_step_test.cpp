// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/dynamics/stable_step.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <complex>
#include <cstdio>
#include <limits>
#include <utility>

#include "dense_motion.hpp"
#include "dynamics/instability.hpp"
#include "perimode/core/error.hpp"
#include "support/models.hpp"

namespace perimode {
namespace {

template <int Dim>
StableStep step_of(const Body<Dim>& body, double stiffness_damping = 0.0) {
  // In blocks: the other forms keep square roots of the bonds' stiffnesses.
  const LinearOperator k = stiffness_operator(body, StiffnessForm::blocks);
  return stable_step(body, k, lumped_mass(body), asymmetry(k) <= 1e-12, stiffness_damping);
}

/// sqrt of the largest eigenvalue of M^-1 K.
template <int Dim>
double omega_of(const Body<Dim>& body) {
  const Eigen::VectorXd mass = lumped_mass(body);
  const Eigen::MatrixXd a = mass.cwiseInverse().asDiagonal() * test::dense_stiffness(body);
  return std::sqrt(a.eigenvalues().cwiseAbs().maxCoeff());
}

/// Never above the true limit, and within the promised 1e-4 of it.
void expect_limit(const StableStep& step, double exact) {
  EXPECT_LE(step.limit, exact * (1.0 + 1e-13));
  EXPECT_GE(step.limit, exact * (1.0 - 1e-4));
}

struct BarCase {
  Kernel kernel;
  double ratio, limit, bound;  ///< c dt / dx
};

class Bar : public testing::TestWithParam<BarCase> {};

TEST_P(Bar, LimitAndSufficientStep) {
  const BarCase& c = GetParam();
  // Walls between which the lattice's highest wave fits exactly would need a special length; a long bar comes
  // within 1e-6 of the sup over all wave numbers.
  Model model = test::box_model({2000}, 1.0 / 2000.0, c.ratio);
  model.material.micromodulus = {c.kernel, 2.0};
  model.volume_correction = VolumeCorrection::linear;
  model.periodic[0] = true;
  const StableStep step = step_of(build_body<1>(model));
  EXPECT_TRUE(step.symmetric);
  EXPECT_NEAR(step.limit * 2000.0, c.limit, 1e-4 * c.limit);
  EXPECT_LE(step.limit * 2000.0, c.limit * (1.0 + 1e-6));
  EXPECT_NEAR(step.bound * 2000.0, c.bound, 5e-4);
  EXPECT_LT(step.bound, step.limit);
}

INSTANTIATE_TEST_SUITE_P(StableStep, Bar,
                         testing::Values(BarCase{Kernel::constant, 3.0, 1.963961, 1.643},
                                         BarCase{Kernel::constant, 5.0, 2.953122, 2.393},
                                         BarCase{Kernel::gaussian, 3.0, 1.309305, 1.231},
                                         BarCase{Kernel::gaussian, 5.0, 1.813349, 1.588}));

TEST(StableStep, NeverAboveTheTrueLimit) {
  Model plate = test::box_model({9, 7}, 0.1, 2.0);
  test::fix_face(plate, 0, false, 1, {0, 1});
  Model cube = test::box_model({5, 4, 6}, 0.1, 2.0);
  Model walls = test::box_model({12, 8}, 0.1, 3.0);
  test::add_walls(walls, 0, WallType::mirror);
  test::add_walls(walls, 1, WallType::antimirror);
  const auto check = [](const auto& body) {
    const StableStep step = step_of(body);
    expect_limit(step, 2.0 / omega_of(body));
    EXPECT_GE(step.omega_max, omega_of(body) * (1.0 - 1e-13));
    EXPECT_LE(step.bound, 2.0 / omega_of(body));
    EXPECT_GT(step.products, 0);
  };
  check(build_body<2>(plate));
  check(build_body<3>(cube));
  check(build_body<2>(walls));
}

TEST(StableStep, UnsymmetricBodiesSmallAndLarge) {
  Model bar = test::box_model({30}, 0.1, 3.0);
  test::add_walls(bar, 0, WallType::surface_nodes);
  Model plate = test::box_model({10, 8}, 0.1, 2.0);
  test::add_walls(plate, 0, WallType::odd);
  test::add_walls(plate, 1, WallType::odd);
  Model large = test::box_model({20, 12}, 0.1, 2.0);
  test::add_walls(large, 0, WallType::odd);
  test::add_walls(large, 1, WallType::odd);
  const auto check = [](const auto& body) {
    const StableStep step = step_of(body);
    EXPECT_FALSE(step.symmetric);
    expect_limit(step, 2.0 / omega_of(body));
  };
  check(build_body<1>(bar));
  check(build_body<2>(plate));
  check(build_body<2>(large));
}

/// Surface nodes on all sides of a plate have complex eigenvalues: undamped motion grows, and the rate is
/// found among all eigenvalues of a small plate and by Arnoldi in a larger one. Their largest imaginary part
/// lies inside the spectrum.
TEST(StableStep, GrowthByAnUnsymmetricBoundary) {
  for (const auto& [nx, ny] : {std::pair{12, 9}, std::pair{20, 14}}) {
    Model model = test::box_model({nx, ny}, 0.1, 3.0);
    model.volume_correction = VolumeCorrection::linear;
    test::add_walls(model, 0, WallType::surface_nodes);
    test::add_walls(model, 1, WallType::surface_nodes);
    const Body<2> body = build_body<2>(model);
    const Eigen::VectorXd mass = lumped_mass(body);
    const Eigen::MatrixXd a = mass.cwiseInverse().asDiagonal() * test::dense_stiffness(body);
    double growth = 0.0;
    for (const std::complex<double>& l : a.eigenvalues())
      growth = std::max(growth, std::abs(std::sqrt(l).imag()));
    const StableStep step = step_of(body);
    EXPECT_FALSE(step.symmetric);
    EXPECT_GT(growth, 0.01 * step.omega_max);
    EXPECT_NEAR(step.growth, growth, 0.2 * growth)
        << nx;  // beyond 400 dofs that of the largest imaginary part
  }
  Model mirrored = test::box_model({12, 9}, 0.1, 3.0);
  test::add_walls(mirrored, 0, WallType::mirror);
  EXPECT_EQ(step_of(build_body<2>(mirrored)).growth, 0.0);
  Model bar = test::box_model({600}, 0.1, 3.0);  // real, though unsymmetric
  bar.volume_correction = VolumeCorrection::linear;
  test::add_walls(bar, 0, WallType::surface_nodes);
  EXPECT_EQ(step_of(build_body<1>(bar)).growth, 0.0);
}

TEST(StableStep, StiffnessDampingShortensIt) {
  const Body<1> body = build_body<1>(test::box_model({20}, 0.1, 3.0));
  const double undamped = step_of(body).limit;
  for (const double b : {1e-12, 0.01, 1.0, 1e6}) {
    const double t = step_of(body, b).limit;
    // dt^2 + 2 b dt = 4/omega^2
    EXPECT_NEAR((t * t + 2.0 * b * t) / (undamped * undamped), 1.0, 1e-13) << b;
  }
}

TEST(StableStep, OfABodyThatNothingHoldsTogetherIsInfinite) {
  Model model = test::box_model({2}, 0.1, 1.0);
  test::add_crack(model, {{0.1}});
  const StableStep step = step_of(build_body<1>(model));
  EXPECT_EQ(step.omega_max, 0.0);
  EXPECT_EQ(step.limit, std::numeric_limits<double>::infinity());
  EXPECT_EQ(step.bound, std::numeric_limits<double>::infinity());
}

/// A periodic bar whose bonds of the first neighbours pull where they should push.
Body<1> softening_bar() {
  Model model = test::box_model({60}, 0.1, 3.0);
  model.periodic[0] = true;
  Body<1> body = build_body<1>(model);
  const auto& family = std::get<GridBonds<1>>(body.bonds).family;
  for (int k = 0; k < family.size(); ++k)
    if (std::abs(family.offset[k][0]) == 1) body.constants.kernel[k] *= -1.0;
  return body;
}

TEST(StableStep, NamesTheWaveOfAMaterialThatSoftens) {
  const Body<1> body = softening_bar();
  // K/m of the wave k dx = pi q / 30: the most negative of sum_j 2 k_j (1 - cos(j k dx)) / m.
  const Eigen::MatrixXd k = test::dense_stiffness(body);
  const double mass = lumped_mass(body)[0];
  double least = 0.0, wave = 0.0;
  for (int q = 0; q <= 30; ++q) {
    double sum = 0.0;
    for (int j = 0; j < 60; ++j) sum += k(0, j) * std::cos(M_PI * q * j / 30.0) / mass;
    if (sum < least) {
      least = sum;
      wave = q / 30.0;
    }
  }
  ASSERT_LT(least, 0.0);
  try {
    (void)step_of(body);
    FAIL() << "a softening material was taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
    char expected[80];
    std::snprintf(expected, sizeof expected, "wave vector (%.4g) pi/spacing", wave);
    EXPECT_THAT(error.what(), testing::HasSubstr(expected));
    std::snprintf(expected, sizeof expected, "rate of %.4g", std::sqrt(-least));
    EXPECT_THAT(error.what(), testing::HasSubstr(expected));
  }
}

TEST(StableStep, NegativeBondsThatLeaveTheBodyStiffAreFine) {
  Model model = test::box_model({60}, 0.1, 3.0);
  model.periodic[0] = true;
  Body<1> body = build_body<1>(model);
  const auto& family = std::get<GridBonds<1>>(body.bonds).family;
  for (int k = 0; k < family.size(); ++k)
    if (std::abs(family.offset[k][0]) == 3) body.constants.kernel[k] *= -0.01;
  expect_limit(step_of(body), 2.0 / omega_of(body));
}

TEST(StableStep, WaveVectorsInThePlane) {
  Model model = test::box_model({12, 10}, 0.1, 2.0);
  const Body<2> body = build_body<2>(model);
  Eigen::VectorXd q(body.boundary.free);
  for (Index i = 0; i < body.count(); ++i) {
    const double x = body.particles.position[i][0] / 0.1 - 0.5, y = body.particles.position[i][1] / 0.1 - 0.5;
    q[2 * i] = std::cos(M_PI * (0.5 * x) + 0.3) * std::cos(M_PI * 0.8 * y + 0.1);
    q[2 * i + 1] = 0.1 * q[2 * i];
  }
  const std::array<double, 2> k = wave_vector(body, q);
  EXPECT_DOUBLE_EQ(k[0], 0.5);
  EXPECT_DOUBLE_EQ(k[1], 0.8);
}

TEST(StableStep, NamesTheWaveInThePlane) {
  Model model = test::box_model({16, 16}, 0.1, 2.0);
  model.periodic = {true, true, false};
  Body<2> body = build_body<2>(model);
  for (double& c : body.constants.kernel) c = -c;
  // Everything softens: the worst wave is the stiffest one of the sound material, one of the star of it.
  const Eigen::MatrixXd k = test::dense_stiffness(body);
  const double mass = lumped_mass(body)[0];
  double least = 0.0;
  std::array<double, 2> worst = {};
  for (int a = 0; a <= 8; ++a) {
    for (int b = 0; b <= 8; ++b) {
      Eigen::Matrix2d symbol = Eigen::Matrix2d::Zero();
      for (int j = 0; j < 256; ++j) {
        const double phase = M_PI * (a * (j % 16) + b * (j / 16)) / 8.0;
        symbol += k.block<2, 2>(0, 2 * j) * std::cos(phase) / mass;
      }
      const double low = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(symbol).eigenvalues()[0];
      if (low >= least) continue;
      least = low;
      worst = {a / 8.0, b / 8.0};
    }
  }
  ASSERT_LT(least, 0.0);
  char either[40], other[40];
  std::snprintf(either, sizeof either, "(%.4g, %.4g)", worst[0], worst[1]);
  std::snprintf(other, sizeof other, "(%.4g, %.4g)", worst[1], worst[0]);
  try {
    (void)step_of(body);
    FAIL() << "a softening material was taken";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::AnyOf(testing::HasSubstr(either), testing::HasSubstr(other)));
  }
}

TEST(StableStep, RefusesAnOperatorThatIsNoNumber) {
  const Body<1> body = build_body<1>(test::box_model({20}, 0.1, 3.0));
  const LinearOperator broken = {20, [](const double*, double* y) { y[0] = std::nan(""); }};
  EXPECT_THROW((void)stable_step(body, broken, lumped_mass(body), true), Error);
}

}  // namespace
}  // namespace perimode
