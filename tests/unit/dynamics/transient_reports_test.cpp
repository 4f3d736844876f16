// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "perimode/assembly/fields.hpp"
#include "unit/dynamics/transient_runs.hpp"

namespace perimode {
namespace {

using test::bar;
using test::displaced;
using test::face;
using test::methods;
using test::plate;
using test::plate_blow;
using test::record;
using test::Recorded;
using test::until;
using test::with_method;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// Prescribed motion that is only defined while the run lasts, and its speed at the start and the end.
TEST(TransientReports, FunctionsOfTimeAreAskedAboutTheRunAlone) {
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
TEST(TransientReports, FieldsKnowWhereSurfacesAre) {
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

TEST(TransientReports, ResumesBitForBit) {
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

TEST(TransientReports, StopsAfterTheStepWithACheckpoint) {
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

TEST(TransientReports, FieldsComeAtTheNearestSteps) {
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

TEST(TransientReports, RowsComeAsAskedAndAtTheEnd) {
  TransientOptions options = until(1.0);
  options.dt = 0.01;
  options.history_every = 30;
  std::vector<std::int64_t> steps;
  for (const HistoryRow& row : record<1>(bar(50), options).rows) steps.push_back(row.step);
  EXPECT_THAT(steps, ElementsAre(0, 30, 60, 90, 100));
}

/// Two particles pulled apart as 2e-3 x: displacement, strain and their rates.
TEST(TransientReports, ProbesShowTheirParticles) {
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

TEST(TransientReports, ProbesOutsideTheBodyAreRefused) {
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

}  // namespace
}  // namespace perimode
