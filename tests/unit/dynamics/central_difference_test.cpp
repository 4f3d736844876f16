// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/dynamics/central_difference.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>

#include "perimode/assembly/assemble.hpp"
#include "perimode/assembly/operators.hpp"
#include "perimode/core/error.hpp"
#include "perimode/linalg/threads.hpp"
#include "support/models.hpp"

namespace perimode {
namespace {

using test::add_wall;
using test::add_walls;
using test::box_model;
using test::fix_face;

constexpr double pi = 3.14159265358979323846;

Eigen::VectorXd random_vector(Eigen::Index size, unsigned seed, double scale = 1.0) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-scale, scale);
  return Eigen::VectorXd::NullaryExpr(size, [&] { return uniform(generator); });
}

template <int Dim>
Motion motion_of(const Body<Dim>& body, StiffnessForm form = StiffnessForm::automatic) {
  Motion m;
  m.mass = lumped_mass(body);
  m.stiffness = stiffness_rows(body, form);
  return m;
}

/// 2/omega_max by Gershgorin: a step below is stable.
template <int Dim>
double safe_step(const Body<Dim>& body, const Motion& motion) {
  return 2.0 / std::sqrt(stiffness_bound(body) / motion.mass.minCoeff());
}

/// p_k = -R K g_k of the given displacements of the function of time `number`, and g_k over all particle
/// dofs.
template <int Dim>
ForceTerm given_term(const Body<Dim>& body, int number, Eigen::VectorXd& given) {
  Body<Dim> of = body;
  of.boundary = with_only(body.boundary, number);
  given = Eigen::Map<const Eigen::VectorXd>(of.boundary.given.data(), of.count() * Dim);
  const Eigen::VectorXd force = internal_force(of, given);
  ForceTerm term;
  term.time = body.boundary.time[static_cast<std::size_t>(number)];
  term.motion = true;
  for (Eigen::Index d = 0; d < given.size(); ++d) {
    const Index row = body.boundary.free_number[static_cast<std::size_t>(d)];
    if (row < 0 || force[d] == 0.0) continue;
    term.dof.push_back(row);
    term.value.push_back(-force[d]);
  }
  return term;
}

/// Largest |balance| over `steps` steps asked for energies every 7 of them, over the initial energy.
double worst_balance(Integrator& run, int steps) {
  double worst = 0.0;
  for (int n = 1; n <= steps; ++n) {
    run.advance(n % 7 == 0);
    if (n % 7 == 0) worst = std::max(worst, std::abs(run.energies().balance()));
  }
  return worst / run.energies().initial;
}

TEST(CentralDifference, AModeOscillatesAtItsDiscreteFrequency) {
  Model m = box_model({40}, 0.025, 3.0);
  add_walls(m, 0, WallType::mirror);
  const auto body = build_body<1>(m);
  const Motion motion = motion_of(body);
  const double dt = 0.9 * safe_step(body, motion);
  for (const int mode : {1, 3, 17, 40}) {
    // sin(k x) solves the walled bar exactly; its Rayleigh quotient is its eigenvalue to round-off.
    Eigen::VectorXd shape(40);
    for (Index i = 0; i < 40; ++i) shape[i] = std::sin(mode * pi * (i + 0.5) / 40.0);
    const double omega = std::sqrt(shape.dot(multiply(as_operator(motion.stiffness), shape)) /
                                   shape.dot(motion.mass.cwiseProduct(shape)));
    const double discrete = 2.0 / dt * std::asin(0.5 * omega * dt);
    const auto run = central_difference(motion, dt);
    run->start(shape, Eigen::VectorXd::Zero(40));
    double worst = 0.0;
    for (int n = 1; n <= 1000; ++n) {
      run->advance(false);
      const double expected = std::cos(discrete * n * dt);
      worst = std::max(worst, (run->displacement() - expected * shape).cwiseAbs().maxCoeff());
    }
    // The phase after 1000 steps holds 1000 asin(..) of round-off in omega.
    EXPECT_LT(worst, 1e-12) << "mode " << mode;
    // v = (q_{n+1} - q_{n-1})/(2 dt) of the exact solution.
    const Eigen::VectorXd v = -std::sin(discrete * 1000 * dt) * std::sin(discrete * dt) / dt * shape;
    EXPECT_LT((run->velocity() - v).cwiseAbs().maxCoeff(), 1e-12 * omega) << "mode " << mode;
  }
}

TEST(CentralDifference, StartsWithTheGivenVelocity) {
  Model m = box_model({12, 9}, 0.1, 2.0);
  fix_face(m, 0, false, 1, {0, 1});
  const auto body = build_body<2>(m);
  Motion motion = motion_of(body);
  motion.damping_rate = random_vector(motion.mass.size(), 3).cwiseAbs();
  const Eigen::VectorXd q = random_vector(motion.mass.size(), 1);
  const Eigen::VectorXd v = random_vector(motion.mass.size(), 2);
  const auto run = central_difference(motion, 0.5 * safe_step(body, motion));
  run->start(q, v);
  EXPECT_EQ(run->displacement(), q);
  EXPECT_LT((run->velocity() - v).cwiseAbs().maxCoeff(), 1e-13 * v.cwiseAbs().maxCoeff() * 40);
}

/// Bodies with symmetric K.
std::vector<Model> symmetric_models() {
  std::vector<Model> models;
  models.push_back(box_model({60}, 1.0 / 60, 3.0));
  add_walls(models.back(), 0, WallType::odd);
  models.push_back(box_model({14, 9}, 0.1, 3.0));
  add_wall(models.back(), 0, false, WallType::mirror);
  fix_face(models.back(), 0, true, 2, {0, 1});
  models.push_back(box_model({5, 6, 4}, 0.2, 2.0));
  fix_face(models.back(), 2, false, 1, {0, 1, 2});
  return models;
}

template <int Dim>
void expect_balance(const Model& m, int steps) {
  const auto body = build_body<Dim>(m);
  Motion motion = motion_of(body);
  const double dt = 0.8 * safe_step(body, motion);
  const Eigen::VectorXd q = random_vector(motion.mass.size(), 1, 1e-3);
  const Eigen::VectorXd v = random_vector(motion.mass.size(), 2, 1e-3);
  {
    const auto run = central_difference(motion, dt);
    run->start(q, v);
    EXPECT_LT(worst_balance(*run, steps), 1e-12) << "free";
  }
  ForceTerm load;
  load.time = {.kind = TimeFunction::Kind::half_sine, .a = 300.0 * dt};
  for (Index d = 1; d < body.boundary.free; d += 5) {
    load.dof.push_back(d);
    load.value.push_back(1e-2 * stiffness_bound(body) / (1.0 + d));
  }
  motion.force.push_back(load);
  {
    const auto run = central_difference(motion, dt);
    run->start(q, v);
    EXPECT_LT(worst_balance(*run, steps), 1e-12) << "loaded";
    EXPECT_GT(std::abs(run->energies().external_work), 0.01 * run->energies().initial);
  }
  motion.damping_rate = Eigen::VectorXd::Zero(body.boundary.free);
  for (Index d = 0; d < body.boundary.free / 2; ++d) motion.damping_rate[d] = 1e-3 * d / dt;
  {
    const auto run = central_difference(motion, dt);
    run->start(q, v);
    EXPECT_LT(worst_balance(*run, steps / 10), 1e-12) << "damped";
    EXPECT_GT(run->energies().damping, 0.1 * run->energies().initial);
  }
  motion.stiffness_damping = 0.05 * dt;
  {
    const auto run = central_difference(motion, dt);
    run->start(q, v);
    EXPECT_LT(worst_balance(*run, steps / 10), 1e-12) << "damped by stiffness";
  }
}

TEST(CentralDifference, EnergyBalancesOverManySteps) {
  const auto models = symmetric_models();
  expect_balance<1>(models[0], 100000);
  expect_balance<2>(models[1], 100000);
  expect_balance<3>(models[2], 20000);
}

TEST(CentralDifference, WorkOfGivenMotionBalances) {
  Model m = box_model({30, 4}, 0.1, 3.0);
  fix_face(m, 0, false, 3, {0, 1});
  const Region right{FaceRegion{{0, true}, 3, 0.0}, {}};
  const Region top{FaceRegion{{1, true}, 1, 0.0}, {}};
  m.boundary.push_back({Prescribe{{{0, 2e-3}}, right}, {}});
  m.boundary.push_back({Prescribe{{{1, 1e-3}}, top}, {}});
  auto body = build_body<2>(m);
  body.boundary.time = {TimeFunction{},
                        {.kind = TimeFunction::Kind::half_sine, .a = 20.0},
                        {.kind = TimeFunction::Kind::ramp, .a = 7.0}};
  body.boundary.given_time.clear();
  for (const double g : body.boundary.given)
    body.boundary.given_time.push_back(g == 2e-3 ? 1 : g == 1e-3 ? 2 : 0);
  Motion motion = motion_of(body);
  std::vector<Eigen::VectorXd> given(2);
  std::vector<Eigen::VectorXd> force;
  for (int k = 0; k < 2; ++k) {
    motion.force.push_back(given_term(body, k + 1, given[static_cast<std::size_t>(k)]));
    Body<2> of = body;
    of.boundary = with_only(body.boundary, k + 1);
    force.push_back(internal_force(of, given[static_cast<std::size_t>(k)]));
  }
  motion.motion_stiffness.resize(2, 2);
  for (int k = 0; k < 2; ++k)
    for (int l = 0; l < 2; ++l) motion.motion_stiffness(k, l) = given[k].dot(force[l]);
  const double dt = 0.8 * safe_step(body, motion);
  const auto run = central_difference(motion, dt);
  run->start(random_vector(motion.mass.size(), 1, 1e-4), random_vector(motion.mass.size(), 2, 1e-4));
  EXPECT_LT(worst_balance(*run, 100000), 1e-12);
  EXPECT_GT(std::abs(run->energies().external_work), 0.1 * run->energies().initial);

  // The strain energy is (1/2) u_n . K u_{n+1} of all particles, given ones included.
  const std::int64_t n = run->step();
  const auto everywhere = [&](double t) {
    const Eigen::VectorXd& q = run->displacement();
    Eigen::VectorXd u(body.count() * 2);
    for (Eigen::Index d = 0; d < u.size(); ++d) {
      const Index row = body.boundary.free_number[static_cast<std::size_t>(d)];
      u[d] = row >= 0 ? q[row] : 0.0;
      for (int k = 0; k < 2; ++k) u[d] += given[k][d] * value_at(body.boundary.time[k + 1], t);
    }
    return u;
  };
  const Eigen::VectorXd before = everywhere(n * dt);
  run->advance(true);
  const Eigen::VectorXd after = everywhere((n + 1) * dt);
  Body<2> linear = body;
  for (double& g : linear.boundary.value) g = 0.0;
  const double strain = 0.5 * before.dot(internal_force(linear, after));
  EXPECT_NEAR(run->energies().strain, strain, 1e-12 * std::abs(run->energies().initial));
}

TEST(CentralDifference, SecondOrderInTheStep) {
  Model m = box_model({20}, 0.05, 3.0);
  add_walls(m, 0, WallType::odd);
  const auto body = build_body<1>(m);
  Motion motion = motion_of(body);
  motion.damping_rate = Eigen::VectorXd::Constant(20, 2.0);
  ForceTerm load;
  load.time = {.kind = TimeFunction::Kind::ricker, .a = 2.0};
  load.dof = {3};
  load.value = {1.0};
  motion.force.push_back(load);
  Eigen::VectorXd q(20);
  for (Index i = 0; i < 20; ++i) q[i] = std::sin(pi * (i + 0.5) / 20.0);
  const auto at_end = [&](int steps) {
    const auto run = central_difference(motion, 1.0 / steps);
    run->start(q, Eigen::VectorXd::Zero(20));
    for (int n = 0; n < steps; ++n) run->advance(false);
    return run->displacement();
  };
  const Eigen::VectorXd coarse = at_end(100), middle = at_end(200), fine = at_end(400);
  const double order = std::log2((coarse - middle).norm() / (middle - fine).norm());
  EXPECT_NEAR(order, 2.0, 0.05);
}

TEST(CentralDifference, FormsFollowOneTrajectory) {
  Model m = box_model({26, 21}, 0.1, 3.0);
  add_wall(m, 0, false, WallType::mirror);
  fix_face(m, 1, true, 1, {1});
  const auto body = build_body<2>(m);
  const Eigen::VectorXd q = random_vector(body.boundary.free, 1);
  std::vector<Eigen::VectorXd> end;
  for (auto form : {StiffnessForm::stencil, StiffnessForm::bonds, StiffnessForm::blocks}) {
    const Motion motion = motion_of(body, form);
    const auto run = central_difference(motion, 0.8 * safe_step(body, motion));
    run->start(q, 0.0 * q);
    for (int n = 0; n < 1000; ++n) run->advance(false);
    end.push_back(run->displacement());
  }
  // Round-off of 1e-16 a step, carried along by the wave: 1000 steps add up to 1e-13 at the very worst.
  EXPECT_LT((end[1] - end[0]).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((end[2] - end[0]).cwiseAbs().maxCoeff(), 1e-12);
}

/// A body of several thousand particles (threads share it), loaded and damped.
Motion large_motion(const Body<2>& body, StiffnessForm form) {
  Motion motion = motion_of(body, form);
  motion.damping_rate = Eigen::VectorXd::Zero(body.boundary.free);
  motion.damping_rate.tail(1000).setConstant(3.0);
  ForceTerm load;
  load.time = {.kind = TimeFunction::Kind::ramp, .a = 3.0};
  for (Index d = 0; d < body.boundary.free; d += 7) {
    load.dof.push_back(d);
    load.value.push_back(1e-3 * (d % 11));
  }
  motion.force.push_back(load);
  return motion;
}

Body<2> large_body() {
  Model m = box_model({61, 67}, 0.1, 3.0);
  add_walls(m, 1, WallType::mirror);
  fix_face(m, 0, true, 1, {0});
  return build_body<2>(m);
}

void expect_equal(const Energies& a, const Energies& b) {
  EXPECT_EQ(a.kinetic, b.kinetic);
  EXPECT_EQ(a.strain, b.strain);
  EXPECT_EQ(a.external_work, b.external_work);
  EXPECT_EQ(a.damping, b.damping);
  EXPECT_EQ(a.initial, b.initial);
}

TEST(CentralDifference, SameBitsForAnyNumberOfThreads) {
  const auto body = large_body();
  const int before = threads();
  for (auto form : {StiffnessForm::stencil, StiffnessForm::bonds, StiffnessForm::blocks}) {
    const Motion motion = large_motion(body, form);
    const Eigen::VectorXd q = random_vector(body.boundary.free, 1);
    std::vector<Eigen::VectorXd> end, rate;
    std::vector<Energies> energies;
    for (const int count : {1, 2, 3}) {
      set_threads(count);
      const auto run = central_difference(motion, 0.8 * safe_step(body, motion));
      run->start(q, 0.5 * q);
      for (int n = 0; n < 50; ++n) run->advance(n == 49);
      end.push_back(run->displacement());
      rate.push_back(run->velocity());
      energies.push_back(run->energies());
    }
    set_threads(before);
    for (int k : {1, 2}) {
      EXPECT_EQ(end[k], end[0]);
      EXPECT_EQ(rate[k], rate[0]);
      expect_equal(energies[k], energies[0]);
    }
  }
}

TEST(CentralDifference, GoesOnToTheLastBit) {
  const auto body = large_body();
  Motion motion = large_motion(body, StiffnessForm::stencil);
  motion.stiffness_damping = 1e-3;
  const double dt = 0.5 * safe_step(body, motion);
  const Eigen::VectorXd q = random_vector(body.boundary.free, 1);
  const auto whole = central_difference(motion, dt);
  whole->start(q, q);
  for (int n = 0; n < 20; ++n) whole->advance(n % 2 == 0);
  const IntegratorState state = whole->save();
  for (int n = 0; n < 20; ++n) whole->advance(true);

  const auto resumed = central_difference(motion, dt);
  resumed->restore(state);
  EXPECT_EQ(resumed->step(), 20);
  for (int n = 0; n < 20; ++n) resumed->advance(true);
  EXPECT_EQ(resumed->displacement(), whole->displacement());
  EXPECT_EQ(resumed->velocity(), whole->velocity());
  expect_equal(resumed->energies(), whole->energies());

  IntegratorState other = state;
  other.numbers["velocity"].pop_back();
  EXPECT_THROW(resumed->restore(other), Error);
  EXPECT_THROW(central_difference(motion, 0.5 * dt)->restore(state), Error);
}

TEST(CentralDifference, RemainderOfTheBalanceIsTheWorkOfAnUnsymmetricBoundary) {
  Model m = box_model({12, 10}, 0.1, 3.0);
  add_walls(m, 0, WallType::odd);
  add_walls(m, 1, WallType::odd);
  const auto body = build_body<2>(m);
  Motion motion = motion_of(body);
  motion.symmetric = false;
  const double dt = 0.5 * safe_step(body, motion);
  const auto run = central_difference(motion, dt);
  run->start(random_vector(motion.mass.size(), 1), random_vector(motion.mass.size(), 2));
  // Every step adds (1/2) (q_{n-1} . K q_n - q_n . K q_{n-1}).
  const LinearOperator k = as_operator(motion.stiffness);
  double sum = 0.0;
  Eigen::VectorXd before = run->displacement();
  run->advance(true);
  Eigen::VectorXd here = run->displacement();
  const double first = run->energies().balance();
  double largest = 0.0;
  for (int n = 1; n < 400; ++n) {
    sum += 0.5 * (before.dot(multiply(k, here)) - here.dot(multiply(k, before)));
    before = here;
    run->advance(true);
    here = run->displacement();
    EXPECT_NEAR(run->energies().balance() - first, sum, 1e-12 * run->energies().initial);
    largest = std::max(largest, std::abs(sum));
  }
  EXPECT_GT(largest, 1e-4 * run->energies().initial);
}

}  // namespace
}  // namespace perimode
