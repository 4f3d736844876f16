// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/fracture/quasistatic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <string>

#include "perimode/assembly/assemble.hpp"
#include "perimode/core/error.hpp"
#include "perimode/statics/static.hpp"
#include "unit/fracture/quasistatic_models.hpp"

namespace perimode {
namespace {

using namespace test;

std::string refusal(const std::function<void()>& run) {
  try {
    run();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::invalid_input);
    return e.what();
  }
  return "";
}

template <int Dim>
double largest_stretch(const Body<Dim>& body, const Eigen::VectorXd& u) {
  double largest = 0.0;
  for (Index i = 0; i < body.count(); ++i) {
    for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
      const Point<Dim> eta = partner_displacement(body.boundary, u.data(), end.neighbour, body.count()) -
                             u.segment<Dim>(static_cast<Eigen::Index>(i) * Dim);
      largest = std::max(largest, end.xi.dot(eta) / (end.length * end.length));
    });
  }
  return largest;
}

QuasistaticOptions pulled(const Model& m, const Body<2>& body) {
  QuasistaticOptions o = options_of(m, body);
  o.loads = {pull({0.0, 1.0}, face(1, true))};
  return o;
}

TEST(Quasistatic, TheFirstBreakIsWhereTheLargestStretchOfTheStaticSolutionMeetsItsLimit) {
  const Model m = cracked_plate(16, 0.25);
  Body<2> body = build_body<2>(m);
  const QuasistaticOptions o = pulled(m, body);
  StaticOptions s;
  s.loads = o.loads;
  const StaticResult unit = solve_static(body, m.boundary, s);
  const double expected = o.critical_stretch[0] / largest_stretch(body, unit.displacement);
  Told<2> told;
  QuasistaticOptions one = o;
  one.stop.events = 1;
  const QuasistaticResult result = run_quasistatic(body, one, told.observer());
  EXPECT_EQ(result.status, QuasistaticStatus::events);
  ASSERT_EQ(told.rows.size(), 1U);
  EXPECT_NEAR(told.rows[0].load_factor, expected, 1e-10 * expected);
  EXPECT_NEAR(told.rows[0].stored_energy, expected * expected * unit.strain_energy,
              1e-9 * expected * expected * unit.strain_energy);
  EXPECT_EQ(told.rows[0].broken_bonds, 0);
  EXPECT_EQ(told.rows[0].breaking_bonds, static_cast<Offset>(told.broken.size()));
  EXPECT_EQ(count_bonds(body.bonds, body.count()) + result.broken_bonds,
            count_bonds(build_body<2>(m).bonds, body.count()));
}

// Work, stored energy, energy of broken bonds and relaxation are summed from different numbers. Residuals of
// 1e-12 in u enter energies to first order, a few hundred times.
TEST(Quasistatic, EnergiesBalanceUpToSeparation) {
  const Model m = cracked_plate(16, 0.25);
  Body<2> body = build_body<2>(m);
  Told<2> told;
  const QuasistaticResult result = run_quasistatic(body, pulled(m, body), told.observer());
  EXPECT_EQ(result.status, QuasistaticStatus::separated) << result.message;
  EXPECT_GT(told.rows.size(), 20U);
  for (const QuasistaticRow& row : told.rows) {
    EXPECT_LE(std::abs(row.balance()), 1e-10 * row.external_work) << row.event;
    EXPECT_NEAR(row.dissipated_energy, row.bond_energy_released + row.relaxation_energy,
                1e-10 * row.external_work);
  }
  EXPECT_EQ(told.rows.back().broken_bonds + told.rows.back().breaking_bonds, result.broken_bonds);
  EXPECT_EQ(static_cast<Offset>(told.broken.size()), result.broken_bonds);
  EXPECT_EQ(told.frames.front(), 1);
  EXPECT_EQ(told.frames.back(), result.events);
}

TEST(Quasistatic, GivenMotionDrivesToSeparationWithBalancedEnergies) {
  Model m = cracked_plate(14, 0.3);
  prescribe(m, 1, 1e-2, face(1, true));
  Body<2> body = build_body<2>(m);
  Told<2> told;
  const QuasistaticResult result = run_quasistatic(body, options_of(m, body), told.observer());
  EXPECT_EQ(result.status, QuasistaticStatus::separated) << result.message;
  EXPECT_LE(result.worst_balance, 1e-10);
  // Snap-back: the displacement falls between some events, which no given displacement could follow.
  EXPECT_TRUE(std::adjacent_find(told.rows.begin(), told.rows.end(), [](const auto& a, const auto& b) {
                return b.displacement < a.displacement;
              }) != told.rows.end());
}

TEST(Quasistatic, AMirrorSymmetricPlateBreaksSymmetrically) {
  Model m = box_model({16, 16}, 1.0 / 16, 3.0);
  m.material.fracture_energy = 1e-4;
  add_crack(m, {{0.0, 0.5}, {0.25, 0.5}});
  prescribe(m, 1, 1.0, face(1, true));
  prescribe(m, 1, -1.0, face(1, false));
  m.boundary.push_back({Fix{{0}, face(0, true)}, {}});
  Body<2> body = build_body<2>(m);
  Told<2> told;
  const QuasistaticResult result = run_quasistatic(body, options_of(m, body), told.observer());
  EXPECT_EQ(result.status, QuasistaticStatus::separated);
  const auto mirror = [](Index i) { return (15 - i / 16) * 16 + i % 16; };
  std::set<std::pair<Index, Index>> broken;
  for (const auto& b : told.broken) broken.insert(std::minmax(b.first, b.second));
  for (const auto& [i, j] : broken) EXPECT_TRUE(broken.contains(std::minmax(mirror(i), mirror(j))));
}

TEST(Quasistatic, AWallMirrorsTheBodyThatBreaks) {
  // The right half of a plate with a central crack, and all of it.
  const auto half = [] {
    Model m = box_model({8, 16}, 1.0 / 16, 3.0);
    add_wall(m, 0, false, WallType::mirror);
    add_crack(m, {{0.0, 0.5}, {0.125, 0.5}});
    return m;
  };
  Model whole = box_model({16, 16}, 1.0 / 16, 3.0);
  std::get<GridSpec>(whole.particles).lower[0] = -0.5;
  std::get<GridSpec>(whole.particles).upper[0] = 0.5;
  add_crack(whole, {{-0.125, 0.5}, {0.125, 0.5}});
  std::vector<std::vector<double>> loads;
  std::vector<Offset> broken;
  for (Model m : {half(), whole}) {
    m.material.fracture_energy = 1e-4;
    prescribe(m, 1, 1.0, face(1, true));
    fix_face(m, 1, false, 1, {0, 1});
    Body<2> body = build_body<2>(m);
    Told<2> told;
    QuasistaticOptions o = options_of(m, body);
    o.stop.events = 30;
    const QuasistaticResult result = run_quasistatic(body, o, told.observer());
    EXPECT_LE(result.worst_balance, 1e-10);
    loads.emplace_back();
    for (const auto& row : told.rows) loads.back().push_back(row.load_factor);
    double work = told.rows.back().external_work;
    loads.back().push_back(m.boundary.size() == 3 ? 2.0 * work : work);
  }
  ASSERT_EQ(loads[0].size(), loads[1].size());
  for (std::size_t k = 0; k < loads[0].size(); ++k)
    EXPECT_NEAR(loads[0][k], loads[1][k], 1e-8 * std::abs(loads[1][k])) << k;
}

TEST(Quasistatic, AFreeBodyUnderBalancedTractionsSeparates) {
  Model m = box_model({12, 16}, 1.0 / 12, 3.0);
  m.material.fracture_energy = 1e-4;
  add_crack(m, {{0.0, 8.0 / 12}, {0.25, 8.0 / 12}});
  Body<2> body = build_body<2>(m);
  QuasistaticOptions o = options_of(m, body);
  o.loads = {pull({0.0, 1.0}, face(1, true)), pull({0.0, -1.0}, face(1, false))};
  Told<2> told;
  const QuasistaticResult result = run_quasistatic(body, o, told.observer());
  EXPECT_EQ(result.plan.rigid_modes, 3);
  EXPECT_EQ(result.status, QuasistaticStatus::separated) << result.message;
  EXPECT_LE(result.worst_balance, 1e-10);
  EXPECT_TRUE(result.displacement.allFinite());
}

TEST(Quasistatic, EveryWayOfSolvingFollowsTheSamePath) {
  const Model m = cracked_plate(12, 0.25);
  std::vector<std::vector<std::int64_t>> paths;
  for (const auto way : {SolveWay::update, SolveWay::stale, SolveWay::refactor, SolveWay::iterate}) {
    Body<2> body = build_body<2>(m);
    QuasistaticOptions o = pulled(m, body);
    o.solver.only = way;
    o.solver.tolerance = 1e-11;
    Told<2> told;
    const QuasistaticResult result = run_quasistatic(body, o, told.observer());
    EXPECT_EQ(result.status, QuasistaticStatus::separated) << name(way) << ": " << result.message;
    paths.emplace_back();
    for (const auto& b : told.broken) {
      for (const std::int64_t x :
           {b.event, static_cast<std::int64_t>(b.first), static_cast<std::int64_t>(b.second)})
        paths.back().push_back(x);
    }
    EXPECT_EQ(paths.back(), paths.front()) << name(way);
  }
}

TEST(Quasistatic, StepsStayWithinTheCriticalStretchAndFollowTheirProgram) {
  Model m = cracked_plate(14, 0.3);
  prescribe(m, 1, 4e-2, face(1, true), {TimeFunction::Kind::ramp, 1.0});
  for (const Index most : {0, 1}) {
    Body<2> body = build_body<2>(m);
    QuasistaticOptions o = options_of(m, body);
    o.control = QuasistaticControl::steps;
    o.steps = 40;
    o.break_at_once = most;
    Told<2> told;
    auto observer = told.observer();
    observer.fields = [&](const QuasistaticFrame<2>& frame) {
      EXPECT_LE(largest_stretch(*frame.body, frame.displacement), o.critical_stretch[0] * (1.0 + 1e-9));
    };
    o.fields_every = 1;
    const QuasistaticResult result = run_quasistatic(body, o, observer);
    EXPECT_EQ(result.status, QuasistaticStatus::separated) << result.message;
    EXPECT_LE(result.worst_balance, 1e-10);
    EXPECT_DOUBLE_EQ(told.rows[3].load_factor, 0.1);
    EXPECT_GT(result.broken_bonds, 0);
  }
}

TEST(Quasistatic, StepsBeyondThePeakEndWithTheirLastStateOfEquilibrium) {
  const Model m = cracked_plate(14, 0.3);
  Body<2> body = build_body<2>(m);
  QuasistaticOptions o = pulled(m, body);
  o.stop.events = 1;
  const double first = run_quasistatic(body, o).first_load;
  body = build_body<2>(m);
  o = pulled(m, body);
  o.loads[0] = pull({0.0, 3.0 * first}, face(1, true));
  o.control = QuasistaticControl::steps;
  o.steps = 2;
  Told<2> told;
  const QuasistaticResult result = run_quasistatic(body, o, told.observer());
  EXPECT_EQ(result.status, QuasistaticStatus::separated) << result.message;
  EXPECT_NE(result.message.find("in step 1"), std::string::npos) << result.message;
  ASSERT_EQ(told.rows.size(), 1U);
  EXPECT_EQ(told.rows[0].breaking_bonds, result.broken_bonds);
  EXPECT_GT(told.rows[0].external_work, 0.0);
  EXPECT_LE(result.worst_balance, 1e-10);
}

TEST(Quasistatic, MotionThroughZeroIsNoSeparation) {
  Model m = cracked_plate(12, 0.25);
  TimeFunction there_and_back{TimeFunction::Kind::table};
  there_and_back.time = {0.0, 1.0, 2.0, 4.0};
  there_and_back.value = {0.0, 1.0, 0.0, 2.0};
  prescribe(m, 1, 2.5e-2, face(1, true), there_and_back);
  Body<2> body = build_body<2>(m);
  QuasistaticOptions o = options_of(m, body);
  o.control = QuasistaticControl::steps;
  o.steps = 4;
  o.end = 4.0;
  Told<2> told;
  const QuasistaticResult result = run_quasistatic(body, o, told.observer());
  ASSERT_EQ(told.rows.size(), 4U) << result.message;
  EXPECT_GT(told.rows[0].breaking_bonds, 0);
  EXPECT_EQ(told.rows[1].breaking_bonds, 0);  // unloading heals nothing and breaks nothing
  EXPECT_GE(told.rows[3].breaking_bonds, 0);
}

TEST(Quasistatic, ALoadedPieceOnAHingeIsRefusedBeforeTheFirstBreak) {
  Model m = box_model({12, 4}, 0.1, 1.5);
  fix_face(m, 0, false, 2, {0, 1});
  m.material.critical_stretch = 1e-3;
  add_crack(m, {{0.6, -0.1}, {0.6, 0.301}});  // the upper row alone ties the right half: a hinge or less
  Body<2> body = build_body<2>(m);
  QuasistaticOptions o = options_of(m, body);
  o.loads = {pull({0.0, 1.0}, face(0, true))};
  EXPECT_NE(refusal([&] { (void)run_quasistatic(body, o); }).find("hold the body"), std::string::npos);
}

TEST(Quasistatic, DeadLoadsActInFullAndTheOthersTakeWhatIsLeft) {
  // Under one and the same traction as dead and as live load, the factors add up.
  const Model m = cracked_plate(12, 0.25);
  Body<2> body = build_body<2>(m);
  QuasistaticOptions o = pulled(m, body);
  o.stop.events = 1;
  const double alone = run_quasistatic(body, o).first_load;
  body = build_body<2>(m);
  o.dead_loads = {pull({0.0, 0.25 * alone}, face(1, true))};
  EXPECT_NEAR(run_quasistatic(body, o).first_load, 0.75 * alone, 1e-9 * alone);
  body = build_body<2>(m);
  o.dead_loads = {pull({0.0, 1.5 * alone}, face(1, true))};
  EXPECT_NE(refusal([&] { (void)run_quasistatic(body, o); }).find("load factor 0"), std::string::npos);
}

TEST(Quasistatic, LoosePiecesAreHeldOrRemoved) {
  // Four cells at the right are tied by bonds ten times weaker, and nothing loads them: they come off first.
  for (const LoosePieces what : {LoosePieces::hold, LoosePieces::remove}) {
    Model m = box_model({20, 8}, 0.05, 2.0);
    fix_face(m, 0, false, 2, {0, 1});
    m.material.critical_stretch = 1e-3;
    m.blocks = {{"tip", {BoxRegion{{0.9, 0.0}, {1.0, 0.1}}, {}}}};
    Material weak = m.material;
    weak.critical_stretch = 1e-5;
    m.block_materials["tip"] = weak;
    Body<2> body = build_body<2>(m);
    QuasistaticOptions o = options_of(m, body);
    o.loads = {pull({1.0, 0.0}, {BoxRegion{{0.7, 0.0}, {0.8, 0.4}}, {}})};
    o.loads[0] = {BodyForce{{1.0, 0.0}}, Region{BoxRegion{{0.7, 0.0}, {0.8, 0.4}}, {}}};
    o.loads.push_back({BodyForce{{1.0, 0.0}}, Region{BoxRegion{{0.9, 0.0}, {1.0, 0.1}}, {}}});
    o.loose = what;
    o.stop.separated = false;
    o.stop.events = 60;
    Told<2> told;
    const QuasistaticResult result = run_quasistatic(body, o, told.observer());
    ASSERT_FALSE(result.loose.empty());
    EXPECT_TRUE(result.displacement.allFinite());
    EXPECT_LE(result.worst_balance, 1e-9);
    for (const auto& row : told.rows) EXPECT_TRUE(std::isfinite(row.load_factor));
  }
}

TEST(Quasistatic, AResumedRunIsTheSameToTheLastBit) {
  const Model m = cracked_plate(12, 0.25);
  Body<2> body = build_body<2>(m);
  QuasistaticOptions o = pulled(m, body);
  o.checkpoint_every = 7;
  Told<2> all;
  const QuasistaticResult whole = run_quasistatic(body, o, all.observer());
  ASSERT_GE(all.checkpoints.size(), 2U);
  Body<2> again = build_body<2>(m);
  Told<2> rest;
  const QuasistaticResult resumed = run_quasistatic(again, o, rest.observer(), &all.checkpoints[0]);
  EXPECT_EQ(resumed.events, whole.events);
  EXPECT_EQ(resumed.broken_bonds, whole.broken_bonds);
  EXPECT_EQ(resumed.peak_load, whole.peak_load);
  EXPECT_EQ(resumed.worst_balance, whole.worst_balance);
  ASSERT_EQ(rest.rows.size() + 7, all.rows.size());
  for (std::size_t k = 0; k < rest.rows.size(); ++k) {
    EXPECT_EQ(rest.rows[k].load_factor, all.rows[k + 7].load_factor);
    EXPECT_EQ(rest.rows[k].external_work, all.rows[k + 7].external_work);
    EXPECT_EQ(rest.rows[k].crack_length, all.rows[k + 7].crack_length);
  }
  EXPECT_TRUE((resumed.displacement.array() == whole.displacement.array()).all());
}

TEST(Quasistatic, RefusesWhatMakesNoRun) {
  Model m = cracked_plate(8, 0.25);
  Body<2> body = build_body<2>(m);
  const auto message = [&](const std::function<void(QuasistaticOptions&)>& change) {
    QuasistaticOptions o = pulled(m, body);
    change(o);
    return refusal([&] { (void)run_quasistatic(body, o); });
  };
  EXPECT_NE(message([](auto& o) { o.loads.clear(); }).find("loads or moves"), std::string::npos);
  EXPECT_NE(message([](auto& o) {
              o.loads = {pull({0.0, 0.0}, face(1, true))};
            }).find("loads or moves"),
            std::string::npos);
  EXPECT_NE(message([](auto& o) {
              o.critical_stretch = {std::numeric_limits<double>::infinity()};
            }).find("material that breaks"),
            std::string::npos);
  EXPECT_NE(message([](auto& o) { o.loads[0].time.kind = TimeFunction::Kind::ramp; }).find("control: steps"),
            std::string::npos);
  EXPECT_NE(message([](auto& o) {
              o.no_fail = {{BoxRegion{{-1.0, -1.0}, {2.0, 2.0}}, {}}};
            }).find("stretches a bond"),
            std::string::npos);
  m.boundary.clear();
  body = build_body<2>(m);
  EXPECT_NE(message([](auto&) {}).find("in equilibrium"), std::string::npos);
}

}  // namespace
}  // namespace perimode
