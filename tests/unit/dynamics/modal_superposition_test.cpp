// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/dynamics/modal_superposition.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "dense_motion.hpp"
#include "perimode/core/error.hpp"

namespace perimode {
namespace {

using test::dense_motion;
using test::number;
using test::one;

TimeFunction table(std::vector<double> time, std::vector<double> value) {
  TimeFunction f;
  f.kind = TimeFunction::Kind::table;
  f.time = std::move(time);
  f.value = std::move(value);
  return f;
}

/// Response of y'' + c y' + lambda y = f + g t from y0, v0 by the formulas of the textbooks.
double response(double lambda, double c, double f, double g, double y0, double v0, double t) {
  if (lambda == 0.0 && c == 0.0) return y0 + v0 * t + f * t * t / 2.0 + g * t * t * t / 6.0;
  if (lambda == 0.0) {
    // Particular (f - g/c) t / c + g t^2 / (2 c).
    const double slope = (f - g / c) / c;
    return y0 + slope * t + g * t * t / (2.0 * c) - (v0 - slope) / c * std::expm1(-c * t);
  }
  const double at_rest = f / lambda - c * g / (lambda * lambda), slope = g / lambda;
  const double y = y0 - at_rest, v = v0 - slope, s = 0.5 * c, d = lambda - s * s;
  const double particular = at_rest + slope * t;
  if (std::abs(d) < 1e-14 * lambda) return particular + std::exp(-s * t) * (y + (v + s * y) * t);
  if (d > 0.0) {
    const double w = std::sqrt(d);
    return particular + std::exp(-s * t) * (y * std::cos(w * t) + (v + s * y) / w * std::sin(w * t));
  }
  const double k = std::sqrt(-d), slow = lambda / (s + k), fast = s + k;
  return particular +
         ((v + fast * y) * std::exp(-slow * t) - (v + slow * y) * std::exp(-fast * t)) / (2.0 * k);
}

struct Oscillator {
  double lambda, rate;
};

class OneMode : public testing::TestWithParam<Oscillator> {};

TEST_P(OneMode, FollowsTheTextbookForFreeMotionAndRamps) {
  const auto [lambda, rate] = GetParam();
  Motion motion = dense_motion(number(lambda), one(2.0));
  motion.stiffness = dense_motion(number(2.0 * lambda), one(2.0)).stiffness;
  if (rate > 0.0) motion.damping_rate = one(rate);
  motion.force.push_back({table({0.0, 8.0}, {0.5, 2.5}), {0}, {0.3}, false});
  const Eigen::MatrixXd mode = number(1.0 / std::sqrt(2.0));
  const auto scheme = modal_superposition(motion, 0.4, mode, one(lambda));
  scheme->start(one(0.7), one(-0.2));
  for (int n = 1; n <= 20; ++n) {
    scheme->advance(true);
    const double exact = response(lambda, rate, 0.15 * 0.5, 0.15 * 0.25, 0.7, -0.2, 0.4 * n);
    // The formulas divide by lambda^2 what they subtract.
    const double lost = lambda > 0.0 && lambda < 1.0 ? 1e-15 / (lambda * lambda) : 0.0;
    ASSERT_NEAR(scheme->displacement()[0], exact, 1e-12 + lost) << n;
    ASSERT_LT(std::abs(scheme->energies().balance()), 1e-13 * (1.0 + scheme->energies().initial));
  }
}

INSTANTIATE_TEST_SUITE_P(ModalSuperposition, OneMode,
                         testing::Values(Oscillator{0.0, 0.0}, Oscillator{0.0, 0.5}, Oscillator{0.0, 50.0},
                                         Oscillator{1e-3, 0.0}, Oscillator{4.0, 0.0}, Oscillator{4.0, 0.3},
                                         Oscillator{4.0, 4.0}, Oscillator{4.0, 4.0000001},
                                         Oscillator{4.0, 30.0}, Oscillator{4.0, 1000.0}, Oscillator{1e4, 0.0},
                                         Oscillator{1e4, 3.0}, Oscillator{1e4, 200.0}));

TEST(ModalSuperposition, NearlyRigidModesMoveAsRigidOnes) {
  const auto end_of = [](double lambda) {
    Motion motion = dense_motion(number(lambda), one(1.0));
    motion.force.push_back({{}, {0}, {2.0}, false});
    const auto scheme = modal_superposition(motion, 0.1, number(1.0), one(lambda));
    scheme->start(one(0.0), one(1.0));
    for (int n = 0; n < 100; ++n) scheme->advance(false);
    return scheme->displacement()[0];
  };
  EXPECT_NEAR(end_of(0.0), 110.0, 1e-12);
  for (const double lambda : {1e-30, 1e-20, 1e-16}) EXPECT_NEAR(end_of(lambda), 110.0, 1e-12) << lambda;
}

struct Spectrum {
  Eigen::MatrixXd shape;
  Eigen::VectorXd lambda;
};

Spectrum modes_of(const Eigen::MatrixXd& k, const Eigen::VectorXd& mass) {
  const Eigen::MatrixXd m = mass.asDiagonal();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(k, m);
  return {solver.eigenvectors(), solver.eigenvalues()};
}

TEST(ModalSuperposition, AllModesGiveTheLimitOfNewmarkForLoadsGivenMotionAndDamping) {
  const TimeFunction ramp = table({0.0, 1.0, 4.0}, {0.0, 1.0, -0.5});
  test::DrivenChain chain = test::driven_chain(6, ramp, ramp);
  chain.motion.damping_rate = Eigen::VectorXd::Constant(6, 0.05);
  chain.motion.stiffness_damping = 0.02;
  const Spectrum modes = modes_of(chain.k, chain.motion.mass);
  const auto exact = modal_superposition(chain.motion, 0.5, modes.shape, modes.lambda);
  exact->start(Eigen::VectorXd::Unit(6, 2), Eigen::VectorXd::Unit(6, 4));
  for (int n = 0; n < 8; ++n) exact->advance(true);
  std::vector<double> error;
  for (const int steps : {500, 1000}) {
    const auto scheme = newmark(chain.motion, 4.0 / steps, {}, test::dense_solver(chain.k));
    scheme->start(Eigen::VectorXd::Unit(6, 2), Eigen::VectorXd::Unit(6, 4));
    for (int n = 0; n < steps; ++n) scheme->advance(n == steps - 1);
    error.push_back((scheme->displacement() - exact->displacement()).norm());
    const Energies a = scheme->energies(), b = exact->energies();
    // The ledgers are of schemes that agree to second order.
    EXPECT_NEAR(a.external_work, b.external_work, 1e-4);
    EXPECT_NEAR(a.damping, b.damping, 1e-4);
    EXPECT_NEAR(a.strain, b.strain, 1e-4);
  }
  EXPECT_LT(error[1], 2e-5);
  EXPECT_NEAR(error[0] / error[1], 4.0, 0.05);
}

TEST(ModalSuperposition, BalanceClosesOverManySteps) {
  const TimeFunction ramp = table({0.0, 100.0, 400.0}, {0.0, 1.0, -0.5});
  for (const double damping : {0.0, 1e-4}) {
    test::DrivenChain chain = test::driven_chain(6, ramp, ramp);
    if (damping > 0.0) chain.motion.damping_rate = Eigen::VectorXd::Constant(6, damping);
    chain.motion.stiffness_damping = damping;
    const Spectrum modes = modes_of(chain.k, chain.motion.mass);
    const auto scheme = modal_superposition(chain.motion, 0.37, modes.shape, modes.lambda);
    scheme->start(Eigen::VectorXd::LinSpaced(6, -0.2, 0.3), Eigen::VectorXd::Zero(6));
    double worst = 0.0;
    for (int n = 1; n <= 100000; ++n) {
      scheme->advance(n % 100 == 0);
      if (n % 100 == 0) worst = std::max(worst, std::abs(scheme->energies().balance()));
    }
    EXPECT_LT(worst, 1e-12 * scheme->energies().initial) << damping;
  }
}

TEST(ModalSuperposition, StepsOfAnyLengthMeetAtTheSameTime) {
  const TimeFunction ramp = table({0.0, 6.0}, {1.0, -2.0});
  const test::DrivenChain chain = test::driven_chain(5, ramp, ramp);
  const Spectrum modes = modes_of(chain.k, chain.motion.mass);
  Eigen::VectorXd first;
  for (const int steps : {1, 6, 6000}) {
    const auto scheme = modal_superposition(chain.motion, 6.0 / steps, modes.shape, modes.lambda);
    scheme->start(Eigen::VectorXd::Unit(5, 0), Eigen::VectorXd::Zero(5));
    for (int n = 0; n < steps; ++n) scheme->advance(false);
    if (steps == 1) first = scheme->displacement();
    EXPECT_LT((scheme->displacement() - first).norm(), 1e-13);
  }
}

TEST(ModalSuperposition, GoesOnToTheLastBitFromASavedState) {
  const TimeFunction ramp = table({0.0, 6.0}, {1.0, -2.0});
  test::DrivenChain chain = test::driven_chain(5, ramp, ramp);
  chain.motion.stiffness_damping = 0.01;
  const Spectrum modes = modes_of(chain.k, chain.motion.mass);
  const auto whole = modal_superposition(chain.motion, 0.1, modes.shape, modes.lambda);
  whole->start(Eigen::VectorXd::Unit(5, 0), Eigen::VectorXd::Zero(5));
  for (int n = 0; n < 20; ++n) whole->advance(true);
  const auto resumed = modal_superposition(chain.motion, 0.1, modes.shape, modes.lambda);
  resumed->restore(whole->save());
  EXPECT_EQ(resumed->displacement(), whole->displacement());
  for (int n = 0; n < 20; ++n) {
    whole->advance(true);
    resumed->advance(true);
  }
  EXPECT_EQ(resumed->displacement(), whole->displacement());
  EXPECT_EQ(resumed->velocity(), whole->velocity());
  EXPECT_EQ(resumed->energies().balance(), whole->energies().balance());
  EXPECT_THROW(resumed->restore({}), Error);
}

TEST(ModalSuperposition, TruncationIsTheShareThatModesLeaveOut) {
  const test::DrivenChain chain = test::driven_chain(5, {}, {});
  const Spectrum modes = modes_of(chain.k, chain.motion.mass);
  // Two modes with energies 1/2 lambda and 1/2 9 in the state, of which the first alone is kept.
  const Eigen::VectorXd q = modes.shape.col(0), v = 3.0 * modes.shape.col(3);
  const Truncation some = truncation(chain.motion, modes.shape.leftCols(1), modes.lambda.head(1), q, v);
  EXPECT_NEAR(some.initial_energy, 9.0 / (9.0 + modes.lambda[0]), 1e-13);
  const Eigen::VectorXd p = 0.3 * Eigen::VectorXd::Unit(5, 0), wall = Eigen::VectorXd::Unit(5, 4);
  const auto left = [&](const Eigen::VectorXd& x) {
    return 1.0 - std::pow(modes.shape.col(0).dot(x), 2) / x.cwiseAbs2().dot(chain.motion.mass.cwiseInverse());
  };
  EXPECT_NEAR(some.load, std::max(left(p), left(wall)), 1e-13);
  const Truncation all = truncation(chain.motion, modes.shape, modes.lambda, q, v);
  EXPECT_LT(all.initial_energy, 1e-13);
  EXPECT_LT(all.load, 1e-13);
}

TEST(ModalSuperposition, RefusesWhatIsNotModal) {
  test::DrivenChain chain = test::driven_chain(3, {}, {});
  const Spectrum modes = modes_of(chain.k, chain.motion.mass);
  const auto make = [&](double dt) {
    (void)modal_superposition(chain.motion, dt, modes.shape, modes.lambda);
  };
  EXPECT_THROW(make(0.0), Error);
  EXPECT_THROW((void)modal_superposition(chain.motion, 0.1, modes.shape, modes.lambda.head(2)), Error);
  chain.motion.damping_rate = Eigen::VectorXd::LinSpaced(3, 0.0, 1.0);
  EXPECT_THROW(make(0.1), Error);
  chain.motion.damping_rate = {};
  chain.motion.symmetric = false;
  EXPECT_THROW(make(0.1), Error);
}

}  // namespace
}  // namespace perimode
