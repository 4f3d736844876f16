// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "perimode/assembly/assemble.hpp"
#include "perimode/assembly/fields.hpp"
#include "perimode/assembly/operators.hpp"
#include "perimode/dynamics/central_difference.hpp"
#include "perimode/linalg/threads.hpp"
#include "support/models.hpp"

namespace perimode {
namespace {

using test::add_crack;
using test::add_wall;
using test::box_model;
using test::fix_face;

template <int Dim>
Motion motion_of(const Body<Dim>& body) {
  Motion motion;
  motion.mass = lumped_mass(body);
  motion.stiffness = in_rows(stiffness_operator(body, StiffnessForm::blocks));
  return motion;
}

/// v = a (x - centre) + omega x (x - centre) in the plane, of the free dofs.
template <int Dim>
Eigen::VectorXd spinning(const Body<Dim>& body, double stretch, double omega) {
  Eigen::VectorXd v(body.boundary.free);
  Point<Dim> centre = Point<Dim>::Zero();
  for (const auto& x : body.particles.position) centre += x / static_cast<double>(body.count());
  for (Index i = 0; i < body.count(); ++i) {
    const Point<Dim> x = body.particles.position[i] - centre;
    Point<Dim> own = stretch * x;
    own[0] -= omega * x[1];
    own[1] += omega * x[0];
    for (int a = 0; a < Dim; ++a) {
      const Index row = body.boundary.free_number[static_cast<std::size_t>(i) * Dim + a];
      if (row >= 0) v[row] = own[a];
    }
  }
  return v;
}

Model plate() { return box_model({12, 9}, 0.1, 3.0); }

/// Two particles and their bond, k = 2, m = 1: the extension oscillates at omega = 2, in steps of central
/// differences at (2/dt) asin(omega dt/2), exactly where the kinematics are linear (in one dimension both
/// are).
TEST(BondStepping, OneBondOscillatesAtTheFrequencyOfTheScheme) {
  for (const Kinematics kinematics : {Kinematics::linear, Kinematics::large_rotation}) {
    auto body = build_body<1>(box_model({2}, 1.0, 1.0));
    const Motion motion = motion_of(body);
    BondForces<1> forces(body, kinematics, {});
    const double dt = 0.1;
    const auto run = central_difference(motion, forces, dt);
    run->start(Eigen::Vector2d(-0.005, 0.005), Eigen::Vector2d::Zero());
    EXPECT_EQ(run->velocity(), Eigen::Vector2d::Zero());
    const double omega = 2.0 / dt * std::asin(dt);  // asin(2 dt/2)
    for (int n = 1; n <= 200; ++n) {
      run->advance(true);
      EXPECT_NEAR(run->displacement()[1], 0.005 * std::cos(omega * n * dt), 1e-14);
      // The mean of the velocities half a step before and after.
      EXPECT_NEAR(run->velocity()[1], -0.005 * std::sin(omega * n * dt) * std::sin(omega * dt) / dt, 1e-13);
      const Energies e = run->energies();
      EXPECT_NEAR(e.strain, 0.5 * 2.0 * std::pow(0.01 * std::cos(omega * n * dt), 2), 1e-16);
    }
    EXPECT_EQ(run->step(), 200);
  }
}

/// Diagonal damping centred: q'' = -r q' exactly v_{n+1/2} = v_{n-1/2} (1 - r dt/2)/(1 + r dt/2).
TEST(BondStepping, DiagonalDampingIsCentred) {
  auto body = build_body<1>(box_model({2}, 1.0, 1.0));
  Motion motion = motion_of(body);
  motion.damping_rate = Eigen::Vector2d(3.0, 3.0);
  BondForces<1> forces(body, Kinematics::large_rotation, {});
  const double dt = 0.01;
  const auto run = central_difference(motion, forces, dt);
  run->start(Eigen::Vector2d::Zero(), Eigen::Vector2d(2.0, 2.0));  // together: the bond stays at rest
  EXPECT_NEAR(run->velocity()[0], 2.0, 1e-15);
  for (int n = 0; n < 100; ++n) run->advance(true);
  const double factor = (1.0 - 0.5 * dt * 3.0) / (1.0 + 0.5 * dt * 3.0);
  EXPECT_NEAR(run->velocity()[0], 2.0 * std::pow(factor, 100), 1e-13);
  const Energies e = run->energies();
  EXPECT_EQ(e.initial, 4.0);
  // The trapezoid of r m v_n^2 over v_n = v_0 factor^n is 1 + (r dt/2)^2 of what was lost.
  EXPECT_NEAR(e.damping, (1.0 + std::pow(0.5 * dt * 3.0, 2)) * (e.initial - e.kinetic), 1e-13);
}

/// Largest balance of energies over a run, over the initial energy.
template <int Dim>
double imbalance(const Model& model, double dt, int steps, const std::vector<double>& critical,
                 const Motion* given = nullptr, double omega = 0.5) {
  auto body = build_body<Dim>(model);
  const Motion motion = given ? *given : motion_of(body);
  BondForces<Dim> forces(body, Kinematics::large_rotation, critical);
  const auto run = central_difference(motion, forces, dt);
  run->start(Eigen::VectorXd::Zero(motion.mass.size()), spinning(body, 0.05, omega));
  double worst = 0.0;
  for (int n = 0; n < steps; ++n) {
    run->advance(true);
    worst = std::max(worst, std::abs(run->energies().balance()) / run->energies().initial);
  }
  EXPECT_EQ(run->broken_bonds() > 0, !critical.empty());
  return worst;
}

/// A plate that spins by a turn and breathes: the energy returns to the order 2 of the scheme.
TEST(BondStepping, EnergyOfASpinningPlateReturnsToSecondOrder) {
  const double coarse = imbalance<2>(plate(), 0.02, 300, {});
  const double fine = imbalance<2>(plate(), 0.01, 600, {});
  EXPECT_LT(coarse, 2e-3);
  EXPECT_NEAR(coarse / fine, 4.0, 0.4);
  const double block = imbalance<3>(box_model({6, 5, 4}, 0.1, 2.0), 0.02, 200, {});
  EXPECT_NEAR(block / imbalance<3>(box_model({6, 5, 4}, 0.1, 2.0), 0.01, 400, {}), 4.0, 0.4);
}

/// The same with breaking bonds, in steps of which others break earlier or later.
TEST(BondStepping, EnergyWithBrokenBondsIsKeptToSecondOrder) {
  const double coarse = imbalance<2>(plate(), 0.02, 200, {0.02});
  const double fine = imbalance<2>(plate(), 0.0025, 1600, {0.02});
  EXPECT_LT(coarse, 2e-3);
  EXPECT_GT(coarse / fine, 30.0);
}

/// Loads, given motion and damping: the balance closes to second order.
TEST(BondStepping, WorkOfLoadsAndOfGivenMotionAndDamping) {
  Model m = plate();
  const TimeFunction ramp{TimeFunction::Kind::half_sine, 4.0, 0.0, {}, {}, {}};
  m.boundary.push_back(
      {Prescribe{{{0, 0.01}, {1, 0.02}}, Region{FaceRegion{{0, true}, 3, 0.0}, {}}, ramp}, {}});
  const auto body = build_body<2>(m);
  Motion motion = motion_of(body);
  motion.damping_rate = Eigen::VectorXd::Constant(motion.mass.size(), 0.3);
  motion.stiffness_damping = 1e-3;
  ForceTerm load;
  load.time = {TimeFunction::Kind::half_sine, 3.0, 0.0, {}, {}, {}};
  load.dof = {0, 5};
  load.value = {1e-4, -2e-4};
  motion.force.push_back(load);
  ForceTerm moved = load;  // R K g of the linear problem: not taken here
  moved.motion = true;
  moved.value = {1e3, 1e3};
  motion.force.push_back(moved);
  const double coarse = imbalance<2>(m, 0.01, 400, {}, &motion);
  const double fine = imbalance<2>(m, 0.005, 800, {}, &motion);
  EXPECT_LT(coarse, 1e-2);
  EXPECT_GT(coarse / fine, 3.0);
}

/// A notched plate pulled apart, against the scheme written out bond by bond: same displacements, same bonds.
TEST(BondStepping, ARunEqualsTheSchemeWrittenOut) {
  Model m = plate();
  add_crack(m, {{-0.1, 0.45}, {0.35, 0.45}});
  add_wall(m, 0, true, WallType::mirror);
  auto body = build_body<2>(m);
  auto plain = build_body<2>(m);
  const Motion motion = motion_of(body);
  const double s0 = 0.01, dt = 0.03;
  BondForces<2> forces(body, Kinematics::large_rotation, {s0});
  const auto run = central_difference(motion, forces, dt);
  Eigen::VectorXd q = Eigen::VectorXd::Zero(motion.mass.size());
  Eigen::VectorXd v(q.size());
  for (Index i = 0; i < body.count(); ++i)
    v.segment<2>(2 * i) = Eigen::Vector2d(0.0, 0.06 * (body.particles.position[i][1] - 0.45));
  run->start(q, v);

  const auto acceleration = [&] {
    for (const bool breaking : {true, false}) {
      Eigen::VectorXd f = Eigen::VectorXd::Zero(q.size());
      for (Index i = 0; i < plain.count(); ++i) {
        for_each_bond(plain.bonds, i, Which::alive, [&](const BondEnd<2>& end) {
          const Eigen::Vector2d eta =
              partner_displacement(plain.boundary, q.data(), end.neighbour, plain.count()) -
              q.segment<2>(2 * i);
          const Eigen::Vector2d y = end.xi + eta;
          const double s = y.norm() / end.length - 1.0;
          if (breaking && s > s0) break_bond(plain.bonds, i, end.slot);
          f.segment<2>(2 * i) += bond_stiffness(plain, i, end) * end.length * s * y.normalized();
        });
      }
      if (!breaking) return Eigen::VectorXd(f.cwiseQuotient(motion.mass));
    }
    return Eigen::VectorXd();
  };
  v -= 0.5 * dt * acceleration();
  for (int n = 0; n < 150; ++n) {
    v += dt * acceleration();
    q += dt * v;
    run->advance(false);
    ASSERT_LE((run->displacement() - q).norm(), 1e-11 * q.norm());
  }
  (void)acceleration();
  EXPECT_GT(run->broken_bonds(), 20);
  EXPECT_LT(count_bonds(plain.bonds, plain.count()), count_bonds(build_body<2>(m).bonds, plain.count()) - 20);
  EXPECT_EQ(damage(body), damage(plain));
}

/// A run of `steps`, saved and taken up again after `stop` of them where that is not 0.
struct Outcome {
  Eigen::VectorXd displacement, velocity;
  Energies energies;
  std::int64_t broken;
  std::vector<std::uint64_t> alive;
};

Outcome outcome(int steps, int stop) {
  Model m = plate();
  const TimeFunction ramp{TimeFunction::Kind::ramp, 2.0, 0.0, {}, {}, {}};
  m.boundary.push_back({Prescribe{{{1, 0.05}}, Region{FaceRegion{{1, true}, 3, 0.0}, {}}, ramp}, {}});
  fix_face(m, 1, false, 3, {1});
  auto body = build_body<2>(m);
  Motion motion = motion_of(body);
  motion.damping_rate = Eigen::VectorXd::Constant(motion.mass.size(), 0.1);
  motion.stiffness_damping = 1e-3;
  const std::vector<double> critical = {0.02};
  auto forces = std::make_unique<BondForces<2>>(body, Kinematics::large_rotation, critical);
  auto run = central_difference(motion, *forces, 0.02);
  run->start(Eigen::VectorXd::Zero(motion.mass.size()), spinning(body, 0.02, 0.1));
  auto fresh = build_body<2>(m);
  for (int n = 0; n < steps; ++n) {
    if (n == stop && stop > 0) {
      const IntegratorState state = run->save();
      forces = std::make_unique<BondForces<2>>(fresh, Kinematics::large_rotation, critical);
      run = central_difference(motion, *forces, 0.02);
      run->restore(state);
      EXPECT_EQ(run->step(), stop);
    }
    run->advance(n % 7 == 0);
  }
  const auto& bonds = std::get<GridBonds<2>>(stop > 0 ? fresh.bonds : body.bonds);
  return {run->displacement(), run->velocity(), run->energies(), run->broken_bonds(), bonds.alive};
}

void expect_same(const Outcome& a, const Outcome& b) {
  EXPECT_EQ(a.displacement, b.displacement);
  EXPECT_EQ(a.velocity, b.velocity);
  EXPECT_EQ(a.alive, b.alive);
  EXPECT_EQ(a.broken, b.broken);
  EXPECT_EQ(a.energies.balance(), b.energies.balance());
  EXPECT_EQ(a.energies.external_work, b.energies.external_work);
  EXPECT_EQ(a.energies.damping, b.energies.damping);
  EXPECT_EQ(a.energies.broken, b.energies.broken);
}

TEST(BondStepping, GoesOnBitForBit) {
  const Outcome whole = outcome(150, 0);
  EXPECT_GT(whole.broken, 10);
  for (const int stop : {1, 60, 149}) expect_same(outcome(150, stop), whole);
}

TEST(BondStepping, SameBitsForAnyNumberOfThreads) {
  const int before = threads();
  const auto run = [](int count) {
    set_threads(count);
    auto body = build_body<2>(box_model({101, 60}, 0.1, 3.0));
    const Motion motion = motion_of(body);
    BondForces<2> forces(body, Kinematics::large_rotation, {0.02});
    const auto steps = central_difference(motion, forces, 0.02);
    steps->start(Eigen::VectorXd::Zero(motion.mass.size()), spinning(body, 0.05, 0.1));
    for (int n = 0; n < 40; ++n) steps->advance(n == 39);
    return Outcome{steps->displacement(), steps->velocity(), steps->energies(), steps->broken_bonds(),
                   std::get<GridBonds<2>>(body.bonds).alive};
  };
  const Outcome one = run(1), two = run(2);
  set_threads(before);
  EXPECT_GT(one.broken, 0);
  expect_same(one, two);
}

TEST(BondStepping, RefusesStatesOfOthers) {
  auto body = build_body<2>(plate());
  const Motion motion = motion_of(body);
  BondForces<2> forces(body, Kinematics::large_rotation, {0.02});
  const auto run = central_difference(motion, forces, 0.02);
  run->start(Eigen::VectorXd::Zero(motion.mass.size()), spinning(body, 0.05, 0.1));
  const IntegratorState good = run->save();
  EXPECT_THROW(run->restore({}), Error);
  IntegratorState state = good;
  state.numbers.erase("velocity");
  EXPECT_THROW(run->restore(state), Error);
  state = good;
  state.numbers["force"].pop_back();
  EXPECT_THROW(run->restore(state), Error);
  state = good;
  state.bits["alive"].pop_back();
  EXPECT_THROW(run->restore(state), Error);
  run->restore(good);
  auto other = build_body<2>(box_model({5, 5}, 0.1, 3.0));
  BondForces<2> others(other, Kinematics::large_rotation, {0.02});
  EXPECT_THROW((void)central_difference(motion, others, 0.02), Error);
}

}  // namespace
}  // namespace perimode
