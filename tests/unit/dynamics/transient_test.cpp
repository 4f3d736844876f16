// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/dynamics/transient.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "perimode/assembly/fields.hpp"
#include "support/models.hpp"

namespace perimode {
namespace {

using test::add_wall;
using test::add_walls;
using test::box_model;
using test::fix_face;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

Region face(int axis, bool upper, int layers) { return {FaceRegion{{axis, upper}, layers, 0.0}, {}}; }

TimeFunction half_sine(double t) { return {TimeFunction::Kind::half_sine, t, 0.0, {}, {}, {}}; }

/// A bar of `n` particles and length 1, E = rho = 1: waves travel at about 1.
Model bar(int n) {
  Model m = box_model({n}, 1.0 / n, 3.0);
  m.volume_correction = VolumeCorrection::linear;
  return m;
}

/// A plate held at x-, 12 x 8 particles of 0.1.
Model plate() {
  Model m = box_model({12, 8}, 0.1, 3.0);
  m.volume_correction = VolumeCorrection::linear;
  fix_face(m, 0, false, 2, {0, 1});
  return m;
}

TransientOptions until(double end) {
  TransientOptions options;
  options.end = end;
  return options;
}

/// A blow on the free end of a bar.
Load blow(double seconds) { return {Traction{{1e-3}}, face(0, true, 1), half_sine(seconds), {}}; }
Load plate_blow(double seconds) {
  return {Traction{{1e-3, -5e-4}}, face(0, true, 1), half_sine(seconds), {}};
}

/// u = f(x) along x at the start.
template <int Dim, class F>
InitialState displaced(const Body<Dim>& body, const F& f) {
  InitialState state;
  state.displacement = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(body.count()) * Dim);
  for (Index i = 0; i < body.count(); ++i)
    state.displacement[static_cast<Eigen::Index>(i) * Dim] = f(body.particles.position[i][0]);
  return state;
}

struct Recorded {
  std::vector<HistoryRow> rows;
  std::vector<std::int64_t> frames;
  std::vector<IntegratorState> checkpoints;
  TransientResult result;
};

template <int Dim>
Recorded record(const Model& model, const TransientOptions& options, bool initial_bump = false,
                const IntegratorState* resume = nullptr, std::int64_t stop_at = -1) {
  Body<Dim> body = build_body<Dim>(model);
  Recorded r;
  std::int64_t step = 0;
  TransientObserver<Dim> observer;
  observer.history = [&](const HistoryRow& row) {
    r.rows.push_back(row);
    step = row.step;
  };
  observer.fields = [&](const TransientFrame<Dim>& frame) { r.frames.push_back(frame.step); };
  observer.checkpoint = [&](const IntegratorState& state) { r.checkpoints.push_back(state); };
  observer.stop = [&] { return stop_at >= 0 && step >= stop_at; };
  const InitialState initial = initial_bump ? displaced(body,
                                                        [](double x) {  // its waves are about 0.22 long
                                                          const double s = (x - 0.5) * (x - 0.5) / 0.0025;
                                                          return 1e-3 * (1.0 - 2.0 * s) * std::exp(-s);
                                                        })
                                            : InitialState{};
  r.result = run_transient(body, options, initial, observer, resume);
  return r;
}

double largest_imbalance(const Recorded& r) {
  double largest = 0.0;
  double scale = 0.0;
  for (const HistoryRow& row : r.rows) {
    largest = std::max(largest, std::abs(row.energies.balance()));
    scale = std::max(scale, row.energies.kinetic + row.energies.strain);
  }
  return largest / scale;
}

constexpr TimeMethod methods[] = {TimeMethod::central_difference, TimeMethod::newmark, TimeMethod::hht,
                                  TimeMethod::modal};

TransientOptions with_method(TransientOptions options, TimeMethod method) {
  options.method = method;
  if (method == TimeMethod::hht) options.newmark.alpha = -0.1;
  options.modes = 10000;
  return options;
}

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

/// Prescribed motion that is only defined while the run lasts, and its speed at the start and the end.
TEST(Transient, FunctionsOfTimeAreAskedAboutTheRunAlone) {
  Model m = bar(20);
  const TimeFunction root{TimeFunction::Kind::expression, 0.0, 0.0, {}, {}, Expression("sqrt(t*(1-t))+2*t")};
  m.boundary.push_back({Prescribe{{{0, 1.0}}, face(0, false, 3), root}, {}});
  TransientOptions options = until(1.0);
  options.dt = 1.0 / 64.0;
  options.probes = {{"v", TransientProbe::Kind::velocity, {0.0}, {}, {}}};
  const Recorded r = record<1>(m, options);
  const double h = std::sqrt(options.dt * (1.0 - options.dt));
  EXPECT_NEAR(r.rows.front().probes[0], h / options.dt + 2.0, 1e-12);
  EXPECT_NEAR(r.rows.back().probes[0], -h / options.dt + 2.0, 1e-12);
}

/// A surface that moves by a ramp has not moved at the start: fields there show a body at rest.
TEST(Transient, FieldsKnowWhereSurfacesAre) {
  Model m = bar(20);
  Wall wall{{0, true},
            WallType::surface_nodes,
            {Expression("0.01")},
            {},
            {TimeFunction::Kind::ramp, 10.0, 0.0, {}, {}, {}}};
  m.boundary.push_back({wall, {}});
  Body<1> body = build_body<1>(m);
  TransientOptions options = until(1.0);
  options.fields_at = {0.0};
  double largest = -1.0;
  TransientObserver<1> observer;
  observer.fields = [&](const TransientFrame<1>& frame) {
    largest = strain(*frame.body, frame.displacement).cwiseAbs().maxCoeff();
  };
  (void)run_transient(body, options, {}, observer);
  EXPECT_EQ(largest, 0.0);
  EXPECT_GT(strain(body, Eigen::VectorXd::Zero(20)).cwiseAbs().maxCoeff(), 1e-3);  // the map is in full again
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

TEST(Transient, ResumesBitForBit) {
  for (const TimeMethod method : methods) {
    TransientOptions options = with_method(until(0.6), method);
    options.loads = {plate_blow(0.3)};
    options.dt = 0.02;
    options.rayleigh_mass = 0.5;
    options.checkpoint_every = 7;
    options.history_every = 3;
    const Recorded whole = record<2>(plate(), options);
    ASSERT_GT(whole.checkpoints.size(), 1U);
    for (const IntegratorState& state : whole.checkpoints) {
      const Recorded rest = record<2>(plate(), options, false, &state);
      EXPECT_EQ(rest.result.first_step, state.step);
      EXPECT_EQ(rest.result.displacement, whole.result.displacement);
      EXPECT_EQ(rest.result.velocity, whole.result.velocity);
      EXPECT_EQ(rest.rows.back().energies.external_work, whole.rows.back().energies.external_work);
      EXPECT_EQ(rest.rows.back().energies.damping, whole.rows.back().energies.damping);
      EXPECT_EQ(rest.rows.back().energies.strain, whole.rows.back().energies.strain);
    }
  }
}

TEST(Transient, StopsAfterTheStepWithACheckpoint) {
  TransientOptions options = until(0.6);
  options.dt = 0.02;
  options.loads = {plate_blow(0.3)};
  const Recorded whole = record<2>(plate(), options);
  const Recorded part = record<2>(plate(), options, false, nullptr, 5);
  EXPECT_EQ(part.result.status, TransientStatus::interrupted);
  ASSERT_EQ(part.checkpoints.size(), 1U);
  EXPECT_EQ(part.checkpoints[0].step, 5);
  const Recorded rest = record<2>(plate(), options, false, part.checkpoints.data());
  EXPECT_EQ(rest.rows.front().step, 6);
  EXPECT_EQ(rest.result.displacement, whole.result.displacement);
}

TEST(Transient, FieldsComeAtTheNearestSteps) {
  TransientOptions options = until(1.0);
  options.dt = 0.01;
  options.fields_at = {0.0, 0.254, 0.256, 1.0};
  EXPECT_THAT(record<1>(bar(50), options).frames, ElementsAre(0, 25, 26, 100));
  options.fields_at = {};
  options.fields_every = 40;
  EXPECT_THAT(record<1>(bar(50), options).frames, ElementsAre(0, 40, 80, 100));
  options.fields_every = 0;
  EXPECT_THAT(record<1>(bar(50), options).frames, ElementsAre(100));
  options.fields_at = {1.2};
  EXPECT_THROW((void)record<1>(bar(50), options), Error);
}

TEST(Transient, RowsComeAsAskedAndAtTheEnd) {
  TransientOptions options = until(1.0);
  options.dt = 0.01;
  options.history_every = 30;
  std::vector<std::int64_t> steps;
  for (const HistoryRow& row : record<1>(bar(50), options).rows) steps.push_back(row.step);
  EXPECT_THAT(steps, ElementsAre(0, 30, 60, 90, 100));
}

/// Two particles pulled apart as 2e-3 x: displacement, strain and their rates.
TEST(Transient, ProbesShowTheirParticles) {
  const Model m = bar(10);
  Body<1> body = build_body<1>(m);
  TransientOptions options = until(0.05);
  using Kind = TransientProbe::Kind;
  options.probes = {{"u", Kind::displacement, {0.31}, {}, {}},
                    {"tie", Kind::displacement, {0.4}, {}, {}},
                    {"v", Kind::velocity, {0.0}, {}, {}},
                    {"e", Kind::strain, {0.75}, {0.35}, {}}};
  EXPECT_THAT(probe_columns(options.probes, 1), ElementsAre("u_x", "tie_x", "v_x", "e"));
  EXPECT_THAT(probe_columns({options.probes[2]}, 3), ElementsAre("v_x", "v_y", "v_z"));
  InitialState state = displaced(body, [](double x) { return 2e-3 * x; });
  state.velocity = Eigen::VectorXd::Constant(10, 0.25);
  std::vector<double> first;
  TransientObserver<1> observer;
  observer.history = [&](const HistoryRow& row) {
    if (row.step == 0) first = row.probes;
  };
  (void)run_transient(body, options, state, observer);
  ASSERT_EQ(first.size(), 4U);
  EXPECT_DOUBLE_EQ(first[0], 2e-3 * 0.35);
  EXPECT_DOUBLE_EQ(first[1], 2e-3 * 0.45);  // a tie goes to the higher coordinate
  EXPECT_NEAR(first[2], 0.25, 1e-12);
  EXPECT_NEAR(first[3], 2e-3, 1e-15);
}

TEST(Transient, ProbesOutsideTheBodyAreRefused) {
  Model m = plate();
  std::get<GridSpec>(m.particles).remove = {{BallRegion{{0.6, 0.4}, 0.15}, {}}};
  for (const Coordinates& at : std::vector<Coordinates>{{1.3, 0.4}, {-0.01, 0.4}, {0.6, 0.4}}) {
    TransientOptions options = until(0.1);
    options.probes = {{"p", TransientProbe::Kind::displacement, at, {}, {}}};
    EXPECT_THAT([&] { (void)record<2>(m, options); },
                ThrowsMessage<Error>(HasSubstr("a point of the body for the probe 'p'")));
  }
  TransientOptions options = until(0.1);
  options.probes = {{"s", TransientProbe::Kind::strain, {0.11, 0.1}, {0.12, 0.1}, {}}};
  EXPECT_THAT([&] { (void)record<2>(m, options); }, ThrowsMessage<Error>(HasSubstr("two particles")));
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
  EXPECT_FALSE(r.result.symmetric);
  EXPECT_EQ(r.result.boundary_work, r.rows.back().energies.balance());
  EXPECT_GT(std::abs(r.result.boundary_work), 1e-6 * r.rows.back().energies.initial);
  TransientOptions modal = until(1.0);
  modal.method = TimeMethod::modal;
  EXPECT_THAT([&] { (void)record<2>(m, modal); }, ThrowsMessage<Error>(HasSubstr("a symmetric body")));
  Model mirrored = box_model({12, 8}, 0.1, 3.0);
  add_walls(mirrored, 0, WallType::mirror);
  add_walls(mirrored, 1, WallType::antimirror);
  EXPECT_TRUE(record<2>(mirrored, until(0.2), true).result.symmetric);
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
