// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "perimode/core/error.hpp"
#include "perimode/dynamics/step_breaking.hpp"
#include "perimode/linalg/threads.hpp"
#include "tearing_runs.hpp"

namespace perimode {
namespace {

using test::box_model;
using test::face;
using test::moved_plate;
using test::record;
using test::Recorded;
using test::tearing;
using test::torn_plate;
using test::until;
using test::watch;
using test::Watched;
using test::with_pull;

struct Scheme {
  TimeMethod method;
  NewmarkOptions options;
};

Scheme newmark_with(double beta, double gamma) {
  Scheme s{TimeMethod::newmark, {}};
  s.options.beta = beta;
  s.options.gamma = gamma;
  return s;
}
Scheme hht_with(double alpha) {
  Scheme s{TimeMethod::hht, {}};
  s.options.alpha = alpha;
  return s;
}

double worst_balance(const std::vector<HistoryRow>& rows) {
  double worst = 0.0, scale = 0.0;
  for (const HistoryRow& row : rows) {
    worst = std::max(worst, std::abs(row.energies.balance()));
    scale = std::max(scale, std::abs(row.energies.external_work) + row.energies.initial);
  }
  return worst / scale;
}

class BreakingBalance : public testing::TestWithParam<Scheme> {};

TEST_P(BreakingBalance, ClosesToRoundOffWhileHundredsOfBondsBreak) {
  for (const bool moved : {false, true}) {
    for (const bool damped : {false, true}) {
      TransientOptions options = tearing(GetParam().method, 6.0, 0.05);
      if (!moved) options = with_pull(options);
      options.newmark = GetParam().options;
      if (damped) {
        options.rayleigh_mass = 0.05;
        options.rayleigh_stiffness = 0.02;
        options.damping = {{0.3, face(1, true, 3), {}}};
      }
      const Watched<2> run = watch<2>(moved ? moved_plate() : torn_plate(), options, 0.1);
      EXPECT_EQ(run.result.status, TransientStatus::done);
      EXPECT_GT(run.result.broken_bonds, 200) << moved << damped;
      EXPECT_GT(run.result.energies.broken, 0.0);
      EXPECT_TRUE(run.result.plan.conserves);
      EXPECT_LT(worst_balance(run.rows), 1e-12) << moved << damped;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Newmark, BreakingBalance,
                         testing::Values(newmark_with(0.25, 0.5), newmark_with(0.3, 0.5),
                                         newmark_with(0.3025, 0.6), newmark_with(0.5, 0.8), hht_with(-0.05),
                                         hht_with(-1.0 / 3.0)));

/// Walls share bonds with their images; a blow that runs through the body tears it.
TEST(NewmarkBreaking, TheBalanceClosesBetweenWalls) {
  for (const WallType wall : {WallType::mirror, WallType::antimirror, WallType::zero_layer}) {
    Model m = box_model({14, 8}, 0.1, 2.01);
    test::add_wall(m, 0, false, wall);
    test::add_wall(m, 1, false, WallType::mirror);
    for (const TimeMethod method : {TimeMethod::newmark, TimeMethod::hht}) {
      TransientOptions options = tearing(method, 5.0, 0.05);
      options.loads = {{Traction{{0.05, 0.0}}, face(0, true, 1), test::half_sine(1.5), {}}};
      const Watched<2> run = watch<2>(m, options, 0.1);
      EXPECT_GT(run.result.broken_bonds, 100);
      EXPECT_LT(worst_balance(run.rows), 1e-12);
    }
  }
}

TEST(NewmarkBreaking, ASolidBalances) {
  Model solid = box_model({6, 4, 4}, 0.1, 1.75);
  test::fix_face(solid, 0, false, 1, {0, 1, 2});
  TransientOptions options = tearing(TimeMethod::newmark, 3.0, 0.05);
  options.loads = {
      {Traction{{0.05, 0.0, 0.01}}, face(0, true, 1), {TimeFunction::Kind::ramp, 1.0, 0.0, {}, {}, {}}, {}}};
  options.no_fail = {face(0, true, 1)};
  const Watched<3> run = watch<3>(solid, options);
  EXPECT_GT(run.result.broken_bonds, 50);
  EXPECT_LT(worst_balance(run.rows), 1e-12);
}

TEST(NewmarkBreaking, ABodyThatHoldsMovesAsAnUnbreakableOne) {
  for (const TimeMethod method : {TimeMethod::newmark, TimeMethod::hht}) {
    TransientOptions options = with_pull(tearing(method, 3.0, 0.1));
    options.critical_stretch = {1e3};
    const Watched<2> held = watch<2>(torn_plate(), options);
    options.critical_stretch = {};
    const Watched<2> plain = watch<2>(torn_plate(), options);
    EXPECT_EQ(held.result.broken_bonds, 0);
    for (std::size_t n = 1; n < plain.rows.size(); ++n) {
      ASSERT_LT((held.displacement[n] - plain.displacement[n]).norm(), 1e-12 * plain.displacement[n].norm());
    }
  }
}

/// As the step shrinks, implicit and explicit steps tear a plate along the same bonds.
TEST(NewmarkBreaking, SmallStepsBreakTheBondsThatExplicitStepsBreak) {
  Model m = box_model({12, 4}, 0.1, 2.01);
  test::fix_face(m, 0, false, 2, {0, 1});
  m.boundary.push_back(
      {Prescribe{{{0, 0.08}, {1, 0.0}}, face(0, true, 2), {TimeFunction::Kind::ramp, 20.0, 0.0, {}, {}, {}}},
       {}});
  test::add_crack(m, {{0.6, -0.01}, {0.6, 0.11}});
  const double end = 7.0;
  const Watched<2> implicit = watch<2>(m, tearing(TimeMethod::newmark, end, 1e-3));
  const Watched<2> exact = watch<2>(m, tearing(TimeMethod::central_difference, end, 1e-3));
  ASSERT_GT(exact.result.broken_bonds, 5);
  EXPECT_EQ(implicit.alive.back(), exact.alive.back());
}

/// A bar pulled apart flies off in two pieces that no support holds.
TEST(NewmarkBreaking, FragmentsFlyFreely) {
  Model m = test::bar(40);
  TransientOptions options = tearing(TimeMethod::newmark, 3.0, 0.02);
  options.critical_stretch = {0.01};
  const Watched<1> run = watch<1>(m, options, 0.05);
  EXPECT_EQ(run.result.status, TransientStatus::done);
  EXPECT_GT(run.result.broken_bonds, 3);
  EXPECT_LT(worst_balance(run.rows), 1e-12);
  const Eigen::VectorXd& v = run.result.velocity;
  EXPECT_NEAR(v.sum(), 0.0, 1e-13);
  EXPECT_LT(v.head(20).mean(), -0.005);
  EXPECT_GT(v.tail(20).mean(), 0.005);
}

TEST(NewmarkBreaking, FactorAndConjugateGradientsBreakTheSameBonds) {
  TransientOptions options = with_pull(tearing(TimeMethod::newmark, 4.0, 0.1));
  options.solver = ImplicitSolver::factor;
  const Watched<2> factor = watch<2>(torn_plate(), options);
  options.solver = ImplicitSolver::cg;
  const Watched<2> cg = watch<2>(torn_plate(), options);
  EXPECT_GT(factor.result.broken_bonds, 100);
  EXPECT_GT(cg.result.iterations, 0);
  EXPECT_EQ(factor.alive, cg.alive);
}

/// To the last bit but for the factor, whose BLAS splits its sums by threads.
TEST(NewmarkBreaking, ThreadsBreakTheSameBonds) {
  for (const ImplicitSolver solver : {ImplicitSolver::factor, ImplicitSolver::cg}) {
    std::vector<Watched<2>> runs;
    for (const int threads : {1, 2}) {
      set_threads(threads);
      TransientOptions options = tearing(TimeMethod::hht, 4.0, 0.1);
      options.solver = solver;
      runs.push_back(watch<2>(moved_plate(), options, 0.05));
    }
    set_threads(1);
    EXPECT_GT(runs[0].result.broken_bonds, 100);
    EXPECT_EQ(runs[0].alive, runs[1].alive);
    const double rounding = solver == ImplicitSolver::cg ? 0.0 : 1e-12;
    for (std::size_t n = 0; n < runs[0].rows.size(); ++n) {
      const Eigen::VectorXd& u = runs[0].displacement[n];
      ASSERT_LE((u - runs[1].displacement[n]).norm(), rounding * u.norm()) << n;
    }
    EXPECT_NEAR(runs[0].result.energies.broken, runs[1].result.energies.broken,
                rounding * runs[0].result.energies.broken);
  }
}

TEST(NewmarkBreaking, ResumesBitForBitFromItsCheckpoints) {
  for (const StiffnessForm form : {StiffnessForm::automatic, StiffnessForm::bonds, StiffnessForm::blocks}) {
    for (const ImplicitSolver solver : {ImplicitSolver::factor, ImplicitSolver::cg}) {
      TransientOptions options = tearing(TimeMethod::hht, 4.0, 0.1);
      options.form = form;
      options.solver = solver;
      options.checkpoint_every = 16;
      const Recorded whole = record<2>(moved_plate(), options);
      ASSERT_EQ(whole.checkpoints.size(), 2U);
      for (const IntegratorState& state : whole.checkpoints) {
        const Recorded rest = record<2>(moved_plate(), options, false, &state);
        EXPECT_EQ(rest.result.displacement, whole.result.displacement);
        EXPECT_EQ(rest.result.velocity, whole.result.velocity);
        EXPECT_EQ(rest.result.broken_bonds, whole.result.broken_bonds);
        EXPECT_EQ(rest.result.repeats.all, whole.result.repeats.all);
        EXPECT_EQ(rest.rows.back().energies.balance(), whole.rows.back().energies.balance());
      }
      EXPECT_GT(whole.result.broken_bonds, 40);
    }
  }
}

TEST(NewmarkBreaking, ProtectedParticlesKeepTheirBonds) {
  for (const TimeMethod method : {TimeMethod::central_difference, TimeMethod::newmark}) {
    TransientOptions options = tearing(method, 4.0, 0.02);
    options.no_fail = {Region{BoxRegion{{0.3, 0.0}, {0.9, 1.0}}, {}}};
    const Watched<2> run = watch<2>(moved_plate(), options);
    EXPECT_GT(run.result.broken_bonds, 0);
    Body<2> body = build_body<2>(moved_plate());
    const std::vector<Index> held = select(options.no_fail[0], body.particles);
    std::vector<Offset> before;
    before.reserve(held.size());
    const auto alive_of = [&](Index i) {
      Offset count = 0;
      for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<2>&) { ++count; });
      return count;
    };
    for (const Index i : held) before.push_back(alive_of(i));
    std::visit([&](auto& bonds) { bonds.alive = run.alive.back(); }, body.bonds);
    for (std::size_t k = 0; k < held.size(); ++k) EXPECT_EQ(alive_of(held[k]), before[k]);
  }
}

TEST(NewmarkBreaking, WhatDoesNotFitIsRefused) {
  const auto message = [](const TransientOptions& options, const Model& model) -> std::string {
    try {
      (void)record<2>(model, options);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
      return error.what();
    }
    return "nothing was refused";
  };
  using testing::HasSubstr;
  EXPECT_THAT(message(tearing(TimeMethod::modal, 1.0, 0.1), torn_plate()),
              HasSubstr("central_difference, newmark or hht"));
  Model odd = torn_plate();
  test::add_wall(odd, 1, true, WallType::odd);
  EXPECT_THAT(message(tearing(TimeMethod::newmark, 1.0, 0.1), odd), HasSubstr("a symmetric boundary"));
  TransientOptions options = tearing(TimeMethod::newmark, 1.0, 0.1);
  options.no_fail = {Region{BoxRegion{{5.0, 0.0}, {6.0, 1.0}}, {}}};
  EXPECT_THAT(message(options, torn_plate()), HasSubstr("no_fail regions that hold at least one particle"));
  options = tearing(TimeMethod::newmark, 1.0, 0.1);
  options.checkpoint_every = 5;
  options.critical_stretch = {};
  const Recorded plain = record<2>(torn_plate(), options);
  options.critical_stretch = {0.01};
  EXPECT_THROW((void)record<2>(torn_plate(), options, false, plain.checkpoints.data()), Error);
}

}  // namespace
}  // namespace perimode
