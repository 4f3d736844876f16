// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "unit/dynamics/transient_runs.hpp"

namespace perimode {
namespace {

using test::add_walls;
using test::bar;
using test::blow;
using test::box_model;
using test::face;
using test::half_sine;
using test::largest_imbalance;
using test::methods;
using test::plate;
using test::plate_blow;
using test::record;
using test::Recorded;
using test::until;
using test::with_method;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Transient, AutomaticStepHitsTheEndWithinNineTenthsOfTheLimit) {
  const Recorded r = record<1>(bar(50), until(0.37));
  EXPECT_EQ(r.result.status, TransientStatus::done);
  EXPECT_DOUBLE_EQ(r.result.plan.dt * static_cast<double>(r.result.plan.steps), 0.37);
  EXPECT_LE(r.result.plan.dt, 0.9 * r.result.plan.stable.limit * (1 + 1e-12));
  EXPECT_GT(r.result.plan.dt, 0.85 * r.result.plan.stable.limit);
  EXPECT_LE(r.result.plan.stable.bound, r.result.plan.stable.limit);
  EXPECT_EQ(r.rows.size(), static_cast<std::size_t>(r.result.plan.steps) + 1);
}

TEST(Transient, AStepBeyondTheLimitIsRefusedWithBothNumbers) {
  TransientOptions options = until(1.0);
  options.dt = 0.08;
  EXPECT_THAT(
      [&] { (void)record<1>(bar(50), options); },
      ThrowsMessage<Error>(AllOf(HasSubstr("dt <= 0.0"), HasSubstr("got 0.08 s"), HasSubstr("sufficient"))));
  options.method = TimeMethod::newmark;
  EXPECT_NO_THROW((void)record<1>(bar(50), options));
}

TEST(Transient, EnergyOfABlowIsItsWork) {
  for (const TimeMethod method : methods) {
    TransientOptions options = with_method(until(1.5), method);
    options.loads = {blow(0.2)};
    const Recorded in_bar = record<1>(bar(40), options);
    EXPECT_LE(largest_imbalance(in_bar), 1e-12) << static_cast<int>(method);
    EXPECT_GT(in_bar.rows.back().energies.external_work, 0.0);
    options.loads = {plate_blow(0.3)};
    EXPECT_LE(largest_imbalance(record<2>(plate(), options)), 1e-12) << static_cast<int>(method);
  }
}

TEST(Transient, EnergyOfGivenMotionIsTheWorkOfItsReaction) {
  Model m = bar(40);
  m.boundary.push_back({Prescribe{{{0, 1e-3}}, face(0, false, 3), half_sine(0.25)}, {}});
  m.boundary.push_back({Prescribe{{{0, 2e-3}}, face(0, true, 3), {}}, {}});  // strained from the start
  for (const TimeMethod method : methods) {
    const Recorded r = record<1>(m, with_method(until(1.2), method));
    EXPECT_LE(largest_imbalance(r), 1e-12) << static_cast<int>(method);
    EXPECT_GT(r.rows.front().energies.strain, 0.0);
    EXPECT_GT(std::abs(r.rows.back().energies.external_work), 1e-9);
  }
}

TEST(Transient, DampingDissipatesWhatIsLost) {
  for (const TimeMethod method : methods) {
    TransientOptions options = with_method(until(1.0), method);
    options.rayleigh_mass = 0.8;
    options.rayleigh_stiffness = 1e-3;
    const Recorded r = record<1>(bar(40), options, true);
    EXPECT_LE(largest_imbalance(r), 1e-12) << static_cast<int>(method);
    const Energies& end = r.rows.back().energies;
    EXPECT_GT(end.damping, 0.3 * end.initial);
  }
}

TEST(Transient, MethodsAgreeAsTheStepShrinks) {
  TransientOptions options = until(0.5);
  options.dt = 1e-4;
  options.loads = {plate_blow(0.3)};
  const Recorded reference = record<2>(plate(), with_method(options, TimeMethod::central_difference));
  const double size = reference.result.displacement.norm();
  for (const TimeMethod method : methods) {
    const Recorded r = record<2>(plate(), with_method(options, method));
    EXPECT_LE((r.result.displacement - reference.result.displacement).norm(), 1e-5 * size);
    EXPECT_LE((r.result.velocity - reference.result.velocity).norm(),
              1e-4 * reference.result.velocity.norm());
  }
}

TEST(Transient, LoadsAddUp) {
  TransientOptions first = until(0.6);
  first.dt = 0.01;
  first.loads = {plate_blow(0.3)};
  TransientOptions second = first;
  second.loads = {{BodyForce{{0.0, 1e-3}}, {}, {TimeFunction::Kind::ramp, 0.4, 0.0, {}, {}, {}}, {}}};
  TransientOptions both = first;
  both.loads.push_back(second.loads[0]);
  const Eigen::VectorXd sum =
      record<2>(plate(), first).result.displacement + record<2>(plate(), second).result.displacement;
  EXPECT_LE((record<2>(plate(), both).result.displacement - sum).norm(), 1e-13 * sum.norm());
}

/// A bump splits in two waves that run out of a bar with free ends. Without sponges all of the energy comes
/// back from the ends, with them next to nothing.
TEST(Transient, SpongesSwallowWaves) {
  TransientOptions options = until(2.0);
  const Energies free = record<1>(bar(200), options, true).rows.back().energies;
  EXPECT_NEAR(free.kinetic + free.strain, free.initial, 1e-12 * free.initial);
  options.sponge = Sponge{{{0, false}, {0, true}}, 0.25, 0.0, 3.0, {}};
  const Recorded r = record<1>(bar(200), options, true);
  const Energies& left = r.rows.back().energies;
  EXPECT_LE(left.kinetic + left.strain, 1e-4 * left.initial);  // amplitudes below a hundredth
  EXPECT_LE(largest_imbalance(r), 1e-12);
  options.sponge->width = 1e-3;
  EXPECT_THAT([&] { (void)record<1>(bar(200), options); },
              ThrowsMessage<Error>(HasSubstr("a sponge that holds at least one particle")));
}

TEST(Transient, NodalDampingActsInItsRegion) {
  TransientOptions options = until(0.2);
  options.damping = {{5.0, face(0, true, 5), {}}};
  const Recorded far = record<1>(bar(100), options, true);  // the waves have not come there yet
  EXPECT_LE(far.rows.back().energies.damping, 1e-6 * far.rows.back().energies.initial);
  options.end = 1.0;
  const Recorded met = record<1>(bar(100), options, true);
  EXPECT_GT(met.rows.back().energies.damping, 0.1 * met.rows.back().energies.initial);
  options.damping = {{5.0, {BoxRegion{{2.0}, {3.0}}, {}}, {}}};
  EXPECT_THAT([&] { (void)record<1>(bar(100), options); },
              ThrowsMessage<Error>(HasSubstr("at least one particle")));
}

TEST(Transient, FormsOfTheOperatorGiveOneTrajectory) {
  TransientOptions options = until(0.6);
  options.loads = {plate_blow(0.3)};
  const Eigen::VectorXd stencil = record<2>(plate(), options).result.displacement;
  for (const StiffnessForm form : {StiffnessForm::bonds, StiffnessForm::blocks}) {
    options.form = form;
    EXPECT_LE((record<2>(plate(), options).result.displacement - stencil).norm(), 1e-13 * stencil.norm());
  }
}

TEST(Transient, SmallRotationsAreLinear) {
  TransientOptions options = until(0.6);
  options.loads = {plate_blow(0.3)};
  for (Load& load : options.loads) load.what = Traction{{1e-9, -5e-10}};
  const Eigen::VectorXd linear = record<2>(plate(), options).result.displacement;
  options.kinematics = Kinematics::large_rotation;
  const Recorded turning = record<2>(plate(), options);
  EXPECT_EQ(turning.result.plan.form, "bond forces");
  EXPECT_LE((turning.result.displacement - linear).norm(), 1e-6 * linear.norm());
}

/// Odd walls in two dimensions are no symmetric matrix: the remainder of the balance is work of the boundary.
TEST(Transient, UnsymmetricBoundariesDoWork) {
  Model m = box_model({12, 8}, 0.1, 3.0);
  m.volume_correction = VolumeCorrection::linear;
  add_walls(m, 0, WallType::odd);
  add_walls(m, 1, WallType::odd);
  const Recorded r = record<2>(m, until(1.0), true);
  EXPECT_FALSE(r.result.plan.symmetric);
  EXPECT_EQ(r.result.boundary_work, r.rows.back().energies.balance());
  EXPECT_GT(std::abs(r.result.boundary_work), 1e-6 * r.rows.back().energies.initial);
  TransientOptions modal = until(1.0);
  modal.method = TimeMethod::modal;
  EXPECT_THAT([&] { (void)record<2>(m, modal); }, ThrowsMessage<Error>(HasSubstr("a symmetric body")));
  Model mirrored = box_model({12, 8}, 0.1, 3.0);
  add_walls(mirrored, 0, WallType::mirror);
  add_walls(mirrored, 1, WallType::antimirror);
  EXPECT_TRUE(record<2>(mirrored, until(0.2), true).result.plan.symmetric);
}

/// Bonds of the third layer that pull where they should push: short waves have a negative eigenvalue.
TEST(Transient, AMaterialThatSoftensIsRefusedWithItsWave) {
  Model m = bar(60);
  m.periodic[0] = true;
  Body<1> body = build_body<1>(m);
  for (const std::size_t k : {std::size_t{0}, body.constants.kernel.size() - 1})
    body.constants.kernel[k] *= -8.0;
  EXPECT_THAT([&] { (void)run_transient(body, until(0.1), {}); },
              ThrowsMessage<Error>(
                  AllOf(HasSubstr("a material that resists every motion"), HasSubstr("pi/spacing"))));
}

/// Surface nodes in the plane feed some waves: the plan warns, and a run that is long enough ends as
/// unstable.
TEST(Transient, WavesThatABoundaryFeedsAreNamed) {
  Model m = box_model({12, 9}, 0.1, 3.0);
  m.volume_correction = VolumeCorrection::linear;
  add_walls(m, 0, WallType::surface_nodes);
  add_walls(m, 1, WallType::surface_nodes);
  TransientOptions options = until(30.0);
  options.history_every = 10;
  const Recorded r = record<2>(m, options, true);
  EXPECT_THAT(r.result.plan.warnings, ElementsAre(HasSubstr("lets some waves grow")));
  EXPECT_EQ(r.result.status, TransientStatus::unstable);
  EXPECT_LT(r.result.time, 30.0);
  EXPECT_THAT(r.result.message, HasSubstr("unsymmetric boundary"));
  EXPECT_TRUE(record<1>(bar(50), until(1.0), true).result.plan.warnings.empty());
}

TEST(Transient, MirrorSymmetricLoadsMoveTheBodySymmetrically) {
  Model m = box_model({10, 6}, 0.1, 3.0);
  TransientOptions options = until(0.8);
  options.loads = {{Traction{{-1e-3, 0.0}}, face(0, false, 1), half_sine(0.2), {}},
                   {Traction{{1e-3, 0.0}}, face(0, true, 1), half_sine(0.2), {}}};
  const Eigen::VectorXd u = record<2>(m, options).result.displacement;
  const double size = u.cwiseAbs().maxCoeff();
  for (int j = 0; j < 6; ++j) {
    for (int i = 0; i < 10; ++i) {
      const Eigen::Index here = 2 * (i + 10 * j);
      const Eigen::Index there = 2 * ((9 - i) + 10 * j);
      EXPECT_NEAR(u[here], -u[there], 1e-13 * size);
      EXPECT_NEAR(u[here + 1], u[there + 1], 1e-13 * size);
    }
  }
}

TEST(Transient, OptionsThatDoNotFitAreRefused) {
  const auto message = [](const TransientOptions& options, const Model& model) -> std::string {
    try {
      (void)record<1>(model, options);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
      return error.what();
    }
    return "nothing was refused";
  };
  EXPECT_THAT(message(until(-1.0), bar(20)), HasSubstr("an end of the run after its start"));
  TransientOptions options = until(1.0);
  options.dt = -0.1;
  EXPECT_THAT(message(options, bar(20)), HasSubstr("a step dt > 0"));
  options.dt = 2.0;
  EXPECT_THAT(message(options, bar(20)), HasSubstr("dt <= end"));
  options = until(1.0);
  options.method = TimeMethod::newmark;
  options.kinematics = Kinematics::large_rotation;
  EXPECT_THAT(message(options, bar(20)), HasSubstr("central_difference with kinematics"));
  options = until(1.0);
  options.dt = 1e-20;
  EXPECT_THAT(message(options, bar(20)), HasSubstr("at most 1e+12 steps"));
  options = until(1.0);
  options.method = TimeMethod::newmark;
  options.newmark.beta = 0.1;
  options.dt = 0.2;
  EXPECT_THAT(message(options, bar(20)), HasSubstr("beta >= gamma/2"));
  options = until(1.0);
  options.kinematics = Kinematics::large_rotation;
  options.form = StiffnessForm::bonds;
  EXPECT_THAT(message(options, bar(20)), HasSubstr("operator: auto"));
  options = until(1.0);
  options.loads = {{Traction{{1.0}}, Region{BoxRegion{{3.0}, {4.0}}, {}}, {}, {}}};
  EXPECT_THAT(message(options, bar(20)), HasSubstr("region that holds at least one particle"));
  Model held = bar(4);
  held.boundary.push_back({Fix{{0}, face(0, false, 4)}, {}});
  EXPECT_THAT(message(until(1.0), held), HasSubstr("a body that can move"));
}

}  // namespace
}  // namespace perimode
