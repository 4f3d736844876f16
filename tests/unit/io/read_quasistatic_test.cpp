// SPDX-License-Identifier: BSD-3-Clause
#include "unit/io/bad_case.hpp"

namespace perimode {
namespace {

using test::replace_line;
using test::TemporaryFolder;
using testing::HasSubstr;

/// A sample case with `section` as its analysis.quasistatic.
Case read_quasistatic(const std::string& section, const std::vector<std::string>& overrides = {}) {
  const TemporaryFolder folder;
  const std::string line = "analysis: { quasistatic: " + section + " }";
  return read_case(
      folder.write("case.yaml", replace_line(test::sample_cases().at("plate"), "analysis", line)), overrides);
}

QuasistaticOptions options(const std::string& section) {
  return read_quasistatic(section).quasistatic.value();
}

/// The complaint about a section.
std::string refused_quasistatic(const std::string& section, const std::vector<std::string>& overrides = {}) {
  try {
    (void)read_quasistatic(section, overrides);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
    return error.what();
  }
  return "taken";
}

TEST(ReadQuasistatic, NothingIsAllDefaults) {
  for (const char* section : {"", "{}"}) {
    const Case c = read_quasistatic(section);
    ASSERT_TRUE(c.quasistatic.has_value());
    const QuasistaticOptions& o = *c.quasistatic;
    EXPECT_EQ(o.control, QuasistaticControl::event);
    EXPECT_TRUE(o.loads.empty());
    EXPECT_TRUE(o.no_fail.empty());
    EXPECT_TRUE(o.stop.separated);
    EXPECT_EQ(o.stop.events, 0);
    EXPECT_EQ(o.stop.load_drop, 0.0);
    EXPECT_EQ(o.loose, LoosePieces::hold);
    EXPECT_FALSE(o.solver.only.has_value());
    EXPECT_EQ(o.solver.tolerance, 1e-10);
    EXPECT_FALSE(o.matrix_free);
    EXPECT_FALSE(o.griffith);
    EXPECT_EQ(o.fields_every, 0);
    EXPECT_EQ(o.checkpoint_every, 0);
    EXPECT_EQ(c.quasistatic_where.line, 20);
    EXPECT_EQ(o.where.line, 20);
    EXPECT_FALSE(c.modal.has_value());
  }
}

TEST(ReadQuasistatic, EveryKeyOfEventControl) {
  const QuasistaticOptions o = options(
      "{ control: event, loads: [ { traction: [0, 1.0e+6], at: { face: y+, layers: 1 } }, { force: [1, 0], "
      "time: constant } ], dead_loads: [ { body_force: [0, -9.81] } ], no_fail: [ { face: y-, layers: 2 }, { "
      "block: inclusion } ], stop: { separated: false, events: 12, load_drop: 0.75 }, loose: remove, solver: "
      "update, tolerance: 1.0e-8, fields_every: 3, checkpoint_every: 40 }");
  ASSERT_EQ(o.loads.size(), 2U);
  EXPECT_EQ(std::get<Traction>(o.loads[0].what).value, (Coordinates{0.0, 1e6}));
  ASSERT_EQ(o.dead_loads.size(), 1U);
  ASSERT_EQ(o.no_fail.size(), 2U);
  EXPECT_EQ(std::get<FaceRegion>(o.no_fail[0].shape).layers, 2);
  EXPECT_EQ(std::get<BlockRegion>(o.no_fail[1].shape).name, "inclusion");
  EXPECT_FALSE(o.stop.separated);
  EXPECT_EQ(o.stop.events, 12);
  EXPECT_EQ(o.stop.load_drop, 0.75);
  EXPECT_EQ(o.loose, LoosePieces::remove);
  EXPECT_EQ(o.solver.only, SolveWay::update);
  EXPECT_EQ(o.solver.tolerance, 1e-8);
  EXPECT_EQ(o.fields_every, 3);
  EXPECT_EQ(o.checkpoint_every, 40);
}

TEST(ReadQuasistatic, EveryKeyOfSteps) {
  const QuasistaticOptions o = options(
      "{ control: steps, steps: 7, end: 3.5, break_at_once: 2, loads: [ { force: [1, 0], time: { ramp: 3.5 } "
      "} ] }");
  EXPECT_EQ(o.control, QuasistaticControl::steps);
  EXPECT_EQ(o.steps, 7);
  EXPECT_EQ(o.end, 3.5);
  EXPECT_EQ(o.break_at_once, 2);
  EXPECT_EQ(options("{ control: steps, break_at_once: all }").break_at_once, 0);
  EXPECT_EQ(options("{ control: steps }").break_at_once, 1);
  EXPECT_EQ(o.loads.at(0).time.kind, TimeFunction::Kind::ramp);
}

TEST(ReadQuasistatic, SolversAreWaysOfUpdatedSolver) {
  EXPECT_FALSE(options("{ solver: auto }").solver.only.has_value());
  EXPECT_EQ(options("{ solver: stale }").solver.only, SolveWay::stale);
  EXPECT_EQ(options("{ solver: refactor }").solver.only, SolveWay::refactor);
  const QuasistaticOptions iterate = options("{ solver: iterate }");
  EXPECT_EQ(iterate.solver.only, SolveWay::iterate);
  EXPECT_TRUE(iterate.matrix_free);
  EXPECT_FALSE(options("{ solver: stale }").matrix_free);
}

TEST(ReadQuasistatic, TheGriffithLoadNeedsAPreCrack) {
  EXPECT_THAT(refused_quasistatic("{ griffith: true }", {"body.precracks=[]"}), HasSubstr("pre-crack"));
  EXPECT_TRUE(
      read_quasistatic("{ griffith: true }", {"body.precracks=[ { from: [0.5, 0], to: [0.5, 0.2] } ]"})
          .quasistatic->griffith);
}

TEST(ReadQuasistatic, WrongValuesAreRefusedWhereTheyStand) {
  const std::vector<std::pair<std::string, std::string>> bad = {
      {"{ control: events }", "the nearest is event"},
      {"{ controll: event }", "the nearest valid key is control"},
      {"{ loads: 3 }", "a list"},
      {"{ loads: [ { force: [1] } ] }", "2 numbers"},
      {"{ loads: [ { force: [1, 0], time: { ramp: 1 } } ] }", "give control: steps"},
      {"{ dead_loads: [ { force: [1, 0], time: { step: 1 } } ] }",
       "act in full at every load factor: remove it"},
      {"{ control: steps, dead_loads: [] }", "put it into loads"},
      {"{ control: steps, griffith: false }", "control: event"},
      {"{ griffith: true, dead_loads: [ { force: [1, 0] } ] }", "dead_loads"},
      {"{ steps: 4 }", "give control: steps"},
      {"{ end: 4 }", "give control: steps"},
      {"{ control: event, break_at_once: 4 }", "give control: steps"},
      {"{ control: steps, steps: 0 }", "whole number >= 1"},
      {"{ control: steps, end: 0 }", "> 0 in s"},
      {"{ control: steps, break_at_once: 1.5 }", "whole number"},
      {"{ control: steps, break_at_once: some }", "or all"},
      {"{ no_fail: { face: y-, layers: 2 } }", "a list"},
      {"{ no_fail: [ { block: nowhere } ] }", "nowhere"},
      {"{ loads: [ { force: [1, 0], at: { block: nowhere } } ] }", "nowhere"},
      {"{ dead_loads: [ { force: [1, 0], at: { block: nowhere } } ] }", "nowhere"},
      {"{ stop: 3 }", "a map"},
      {"{ stop: { event: 3 } }", "events"},
      {"{ stop: { separated: 1 } }", "true, false"},
      {"{ stop: { events: 0 } }", "whole number >= 1"},
      {"{ stop: { load_drop: 0 } }", "> 0"},
      {"{ stop: { load_drop: 1 } }", "< 1"},
      {"{ loose: delete }", "hold, remove"},
      {"{ solver: lu }", "update, stale, refactor, iterate"},
      {"{ tolerance: 1.0 }", "< 1"},
      {"{ tolerance: 1.0e-17 }", ">= 1e-15"},
      {"{ fields_every: 0 }", "whole number >= 1"},
      {"{ checkpoint_every: -1 }", "whole number >= 1"},
      {"[]", "a map"},
  };
  for (const auto& [section, words] : bad) {
    const std::string what = refused_quasistatic(section);
    EXPECT_THAT(what, HasSubstr(words)) << section;
    EXPECT_THAT(what, HasSubstr("case.yaml:20:")) << section;
  }
}

}  // namespace
}  // namespace perimode
