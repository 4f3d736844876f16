// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/dynamics/newmark.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "dense_motion.hpp"
#include "perimode/core/error.hpp"
#include "perimode/dynamics/shifted_solver.hpp"
#include "support/models.hpp"

namespace perimode {
namespace {

using test::dense_motion;
using test::dense_solver;
using test::number;
using test::one;

NewmarkOptions hht(double alpha) {
  NewmarkOptions o;
  o.alpha = alpha;
  o.beta = 0.25 * (1.0 - alpha) * (1.0 - alpha);
  o.gamma = 0.5 - alpha;
  return o;
}

/// (q, v, a) of the next step from that of this one for a mass 1 on a spring and dampers.
Eigen::Matrix3d amplification(const NewmarkOptions& o, double dt, double k, double c) {
  Eigen::Matrix3d after, before;
  after << 1, 0, -o.beta * dt * dt, 0, 1, -o.gamma * dt, (1 + o.alpha) * k, (1 + o.alpha) * c, 1;
  before << 1, dt, dt * dt * (0.5 - o.beta), 0, 1, dt * (1 - o.gamma), o.alpha * k, o.alpha * c, 0;
  return after.inverse() * before;
}

TEST(Newmark, OneModeSwingsAtTheFrequencyOfTheTrapezoidalRule) {
  for (const double turn : {0.01, 0.7, 3.0, 40.0}) {
    const double omega = 3.0, dt = turn / omega;
    const Motion motion = dense_motion(number(omega * omega), one(1.0));
    const auto scheme = newmark(motion, dt, {}, dense_solver(number(omega * omega)));
    scheme->start(one(1.0), one(0.0));
    for (int n = 1; n <= 1000; ++n) {
      scheme->advance(false);
      // Accelerations are turn^2 times displacements, and so is their rounding.
      ASSERT_NEAR(scheme->displacement()[0], std::cos(2.0 * n * std::atan(0.5 * turn)),
                  1e-12 * std::max(1.0, 0.01 * turn * turn))
          << turn;
    }
  }
}

TEST(Newmark, EveryMemberFollowsTheEigenvaluesOfItsAmplificationMatrix) {
  NewmarkOptions linear, damped;
  linear.beta = 1.0 / 6.0;
  damped.gamma = 0.6;
  damped.beta = 0.3025;
  const double k = 4.0, dt = 0.3;
  for (const NewmarkOptions& o : {NewmarkOptions{}, linear, damped, hht(-0.05), hht(-0.3)}) {
    for (const double rate : {0.0, 0.2}) {
      for (const double stiffness_damping : {0.0, 0.03}) {
        Motion motion = dense_motion(number(k), one(1.0));
        if (rate > 0.0) motion.damping_rate = one(rate);
        motion.stiffness_damping = stiffness_damping;
        const double c = rate + stiffness_damping * k;
        const auto scheme = newmark(motion, dt, o, dense_solver(number(k)));
        scheme->start(one(1.0), one(-0.5));
        const Eigen::EigenSolver<Eigen::Matrix3d> modes(amplification(o, dt, k, c));
        const Eigen::Vector3d start(1.0, -0.5, -k + 0.5 * c);
        const Eigen::Vector3cd share = modes.eigenvectors().lu().solve(start.cast<std::complex<double>>());
        for (int n = 1; n <= 200; ++n) {
          scheme->advance(false);
          std::complex<double> q = 0.0;
          for (int j = 0; j < 3; ++j)
            q += modes.eigenvectors()(0, j) * share[j] * std::pow(modes.eigenvalues()[j], n);
          // Where two of the three eigenvalues nearly meet, their vectors lose a digit or two.
          ASSERT_NEAR(scheme->displacement()[0], q.real(), 1e-12) << o.alpha << " " << o.gamma << " " << c;
        }
      }
    }
  }
}

/// Orders of convergence of q at t = 3 as the step is halved.
std::vector<double> orders(const NewmarkOptions& o) {
  const double omega = 2.0;
  std::vector<double> order;
  double before = 0.0;
  for (int steps = 100; steps <= 1600; steps *= 2) {
    const Motion motion = dense_motion(number(omega * omega), one(1.0));
    const auto scheme = newmark(motion, 3.0 / steps, o, dense_solver(number(omega * omega)));
    scheme->start(one(1.0), one(0.7));
    for (int n = 0; n < steps; ++n) scheme->advance(false);
    const double exact = std::cos(3.0 * omega) + 0.7 / omega * std::sin(3.0 * omega);
    const double error = std::abs(scheme->displacement()[0] - exact);
    if (before > 0.0) order.push_back(std::log2(before / error));
    before = error;
  }
  return order;
}

TEST(Newmark, OrdersOfConvergence) {
  NewmarkOptions first;
  first.gamma = 0.6;
  first.beta = 0.3025;
  EXPECT_THAT(orders({}), testing::Each(testing::DoubleNear(2.0, 0.02)));
  EXPECT_THAT(orders(hht(-0.1)), testing::Each(testing::DoubleNear(2.0, 0.1)));
  EXPECT_THAT(orders(first), testing::Each(testing::DoubleNear(1.0, 0.1)));
}

TimeFunction sine() {
  TimeFunction f;
  f.kind = TimeFunction::Kind::half_sine;
  f.a = 7.0;
  return f;
}

TimeFunction ricker() {
  TimeFunction f;
  f.kind = TimeFunction::Kind::ricker;
  f.a = 0.2;
  return f;
}

/// Largest |balance| over the largest energy seen.
double worst_balance(Integrator& scheme, int steps, int every) {
  double scale = 0.0, worst = 0.0;
  for (int n = 1; n <= steps; ++n) {
    scheme.advance(n % every == 0);
    if (n % every != 0) continue;
    const Energies e = scheme.energies();
    scale = std::max({scale, std::abs(e.kinetic) + std::abs(e.strain), std::abs(e.external_work)});
    worst = std::max(worst, std::abs(e.balance()));
  }
  return worst / scale;
}

class Balance : public testing::TestWithParam<NewmarkOptions> {};

TEST_P(Balance, ClosesOverManyStepsWithLoadsGivenMotionAndDamping) {
  for (const bool damped : {false, true}) {
    test::DrivenChain chain = test::driven_chain(6, sine(), ricker());
    if (damped) {
      chain.motion.damping_rate = Eigen::VectorXd::LinSpaced(6, 0.0, 0.01);
      chain.motion.stiffness_damping = 1e-3;
    }
    const auto scheme = newmark(chain.motion, 0.37, GetParam(), dense_solver(chain.k));
    scheme->start(Eigen::VectorXd::LinSpaced(6, -0.2, 0.3), Eigen::VectorXd::LinSpaced(6, 0.1, 0.0));
    EXPECT_LT(worst_balance(*scheme, 100000, 100), 1e-12) << damped;
  }
}

NewmarkOptions with(double beta, double gamma) {
  NewmarkOptions o;
  o.beta = beta;
  o.gamma = gamma;
  return o;
}

INSTANTIATE_TEST_SUITE_P(Newmark, Balance,
                         testing::Values(with(0.25, 0.5), with(1.0 / 6.0, 0.5), with(0.3025, 0.6),
                                         with(0.5, 0.7), hht(-0.05), hht(-1.0 / 3.0)));

TEST(Newmark, StrainEnergyAndWorkAreThoseOfTheWholeChain) {
  const test::DrivenChain chain = test::driven_chain(6, sine(), ricker());
  const auto scheme = newmark(chain.motion, 0.01, {}, dense_solver(chain.k));
  scheme->start(Eigen::VectorXd::Zero(6), Eigen::VectorXd::Zero(6));
  double work = 0.0;
  Eigen::VectorXd before(7);
  before.setZero();
  for (int n = 1; n <= 500; ++n) {
    scheme->advance(true);
    Eigen::VectorXd u(7);
    u << scheme->displacement(), 0.1 * value_at(sine(), 0.01 * n);
    // The trapezoidal rule: mean forces times displacements.
    const double push = 0.3 * 0.5 * (value_at(ricker(), 0.01 * (n - 1)) + value_at(ricker(), 0.01 * n));
    const double wall = 0.5 * chain.whole.row(6).dot(u + before);
    work += push * (u[0] - before[0]) + wall * (u[6] - before[6]);
    before = u;
    ASSERT_NEAR(scheme->energies().strain, 0.5 * u.dot(chain.whole * u), 1e-15);
    ASSERT_NEAR(scheme->energies().external_work, work, 1e-15);
  }
}

TEST(Newmark, HalfGammaConservesTheEnergyOfKrenk) {
  const test::DrivenChain chain = test::driven_chain(8, {}, {}, 0.0, 0.0);
  for (const NewmarkOptions& o : {with(0.25, 0.5), with(0.3, 0.5)}) {
    const auto scheme = newmark(chain.motion, 0.9, o, dense_solver(chain.k));
    scheme->start(Eigen::VectorXd::Unit(8, 3), Eigen::VectorXd::Zero(8));
    const double initial = scheme->energies().initial;
    for (int n = 0; n < 2000; ++n) {
      scheme->advance(true);
      const Energies e = scheme->energies();
      ASSERT_NEAR(e.kinetic + e.strain, initial, 1e-12 * initial);
      ASSERT_EQ(e.damping, 0.0);
    }
  }
}

TEST(Newmark, AlgorithmicDissipationOfHhtNeverGivesBack) {
  const test::DrivenChain chain = test::driven_chain(8, {}, {}, 0.0, 0.0);
  const auto scheme = newmark(chain.motion, 1.3, hht(-0.2), dense_solver(chain.k));
  scheme->start(Eigen::VectorXd::Unit(8, 3), Eigen::VectorXd::Zero(8));
  double before = 0.0;
  for (int n = 0; n < 500; ++n) {
    scheme->advance(true);
    ASSERT_GE(scheme->energies().damping, before);
    before = scheme->energies().damping;
  }
  EXPECT_GT(before, 0.5 * scheme->energies().initial);
}

TEST(Newmark, FreeFlightIsExact) {
  Eigen::MatrixXd k(2, 2);
  k << 1.0, -1.0, -1.0, 1.0;
  const Motion motion = dense_motion(k, Eigen::VectorXd::Ones(2));
  const auto scheme = newmark(motion, 0.1, {}, dense_solver(k));
  scheme->start(Eigen::VectorXd::Zero(2), Eigen::VectorXd::Constant(2, 3.0));
  for (int n = 0; n < 100; ++n) scheme->advance(false);
  EXPECT_NEAR(scheme->displacement()[0], 30.0, 1e-12);
  EXPECT_NEAR(scheme->displacement()[1], 30.0, 1e-12);
}

TEST(Newmark, GoesOnToTheLastBitFromASavedState) {
  for (const NewmarkOptions& o : {NewmarkOptions{}, hht(-0.1)}) {
    test::DrivenChain chain = test::driven_chain(5, sine(), ricker());
    chain.motion.damping_rate = Eigen::VectorXd::Constant(5, 0.01);
    const auto whole = newmark(chain.motion, 0.2, o, dense_solver(chain.k));
    whole->start(Eigen::VectorXd::Unit(5, 1), Eigen::VectorXd::Zero(5));
    for (int n = 0; n < 50; ++n) whole->advance(true);
    const auto resumed = newmark(chain.motion, 0.2, o, dense_solver(chain.k));
    resumed->restore(whole->save());
    EXPECT_EQ(resumed->step(), 50);
    EXPECT_EQ(resumed->energies().balance(), whole->energies().balance());
    for (int n = 0; n < 50; ++n) {
      whole->advance(true);
      resumed->advance(true);
    }
    EXPECT_EQ(resumed->displacement(), whole->displacement());
    EXPECT_EQ(resumed->velocity(), whole->velocity());
    EXPECT_EQ(resumed->energies().balance(), whole->energies().balance());
  }
}

TEST(Newmark, RefusesParametersAndStatesThatAreNotItsOwn) {
  const Motion motion = dense_motion(number(1.0), one(1.0));
  const auto make = [&](NewmarkOptions o, double dt) {
    return newmark(motion, dt, o, dense_solver(number(1.0)));
  };
  NewmarkOptions far;
  far.alpha = -0.4;
  EXPECT_THROW((void)make(with(0.0, 0.5), 0.1), Error);
  EXPECT_THROW((void)make(with(0.25, 0.4), 0.1), Error);
  EXPECT_THROW((void)make(far, 0.1), Error);
  EXPECT_THROW((void)make({}, 0.0), Error);
  EXPECT_THROW(make({}, 0.1)->restore({}), Error);
  const auto whole = make({}, 0.1);
  whole->start(one(1.0), one(0.0));
  EXPECT_NO_THROW(make({}, 0.1)->restore(whole->save()));
  EXPECT_THROW(make({}, 0.2)->restore(whole->save()), Error);
}

/// A body without symmetry of its equations against the equations of the scheme written out densely.
template <int Dim>
void expect_dense_reference(const Body<Dim>& body) {
  const Eigen::MatrixXd k = test::dense_stiffness(body);
  ASSERT_GT((k - k.transpose()).cwiseAbs().maxCoeff(), 1e-3 * k.cwiseAbs().maxCoeff());
  const Motion motion = test::free_motion(body);
  ASSERT_FALSE(motion.symmetric);
  const Eigen::Index n = motion.mass.size();
  const double dt = 0.05;
  std::string description;
  const auto scheme = newmark(motion, dt, {},
                              make_shifted_solver(body, stiffness_operator(body), false,
                                                  ImplicitSolver::automatic, 3.0, 1e-12, description));
  EXPECT_THAT(description, testing::StartsWith("lu"));
  Eigen::VectorXd q = Eigen::VectorXd::LinSpaced(n, 0.0, 1.0), v = Eigen::VectorXd::Zero(n);
  scheme->start(q, v);
  // (M + dt^2/4 K) q_{n+1} = (M - dt^2/4 K) q_n + dt M v_n, the trapezoidal rule.
  const Eigen::MatrixXd m = motion.mass.asDiagonal();
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(m + 0.25 * dt * dt * k);
  for (int step = 0; step < 100; ++step) {
    scheme->advance(false);
    const Eigen::VectorXd next = lu.solve((m - 0.25 * dt * dt * k) * q + dt * (m * v));
    v = 2.0 / dt * (next - q) - v;
    q = next;
    ASSERT_LT((scheme->displacement() - q).cwiseAbs().maxCoeff(), 1e-11);
  }
}

TEST(Newmark, BodiesWithUnsymmetricEquations) {
  Model plate = test::box_model({8, 6}, 0.1, 2.0);
  test::add_walls(plate, 0, WallType::odd);
  test::add_walls(plate, 1, WallType::odd);
  expect_dense_reference(build_body<2>(plate));
  Model bar = test::box_model({20}, 0.1, 3.0);
  test::add_walls(bar, 0, WallType::surface_nodes);
  expect_dense_reference(build_body<1>(bar));
}

}  // namespace
}  // namespace perimode
