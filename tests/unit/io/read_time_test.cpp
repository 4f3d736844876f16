// SPDX-License-Identifier: BSD-3-Clause
#include "unit/io/bad_case.hpp"

namespace perimode {
namespace {

using test::BadCase;
using test::replace_line;
using test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using Kind = TimeFunction::Kind;

/// A plate whose first boundary condition varies as `time`; `table` lies beside it as force.csv.
Case read_time(const std::string& time, const std::string& table = "") {
  const TemporaryFolder folder;
  if (!table.empty()) (void)folder.write("force.csv", table);
  const std::string line =
      "  - { prescribe: { y: 1.0e-4 }, at: { face: y-, layers: 1 }, time: " + time + " }";
  return read_case(
      folder.write("case.yaml", replace_line(test::sample_cases().at("plate"), "- { fix", line)));
}

TimeFunction time_of(const std::string& time, const std::string& table = "") {
  return std::get<Prescribe>(read_time(time, table).model.boundary[0].what).time;
}

std::string complaint_about_table(const std::string& table) {
  try {
    (void)read_time("{ table: force.csv }", table);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
    return error.what();
  }
  return "no error";
}

TEST(ReadTime, ParametersOfEveryFunction) {
  const auto check = [](const std::string& text, Kind kind, double a, double b) {
    const TimeFunction f = time_of(text);
    EXPECT_EQ(f.kind, kind) << text;
    EXPECT_EQ(f.a, a) << text;
    EXPECT_EQ(f.b, b) << text;
  };
  check("constant", Kind::constant, 0.0, 0.0);
  check("{ ramp: 1.0e-3 }", Kind::ramp, 1e-3, 0.0);
  check("{ step: 0 }", Kind::step, 0.0, 0.0);
  check("{ half_sine: 2.0e-3 }", Kind::half_sine, 2e-3, 0.0);
  check("{ ricker: 5.0e+4 }", Kind::ricker, 5e4, 0.0);
  check("{ gaussian: [-3.0e-4, 1.0e-4] }", Kind::gaussian, -3e-4, 1e-4);
}

TEST(ReadTime, FormulaOfTime) {
  const TimeFunction f = time_of("{ expression: \"2*t^2 + 1\" }");
  EXPECT_EQ(f.kind, Kind::expression);
  EXPECT_EQ(value_at(f, 3.0), 19.0);  // small whole numbers: exact
}

TEST(ReadTime, TableBesideTheCase) {
  const TimeFunction f = time_of("{ table: force.csv }", "time,value\r\n0,0\r\n 1.0e-3 , +2\n\n2e-3,-1\n\n");
  EXPECT_EQ(f.kind, Kind::table);
  EXPECT_THAT(f.time, ElementsAre(0.0, 1e-3, 2e-3));
  EXPECT_THAT(f.value, ElementsAre(0.0, 2.0, -1.0));
}

TEST(ReadTime, TheCaseKnowsItsFilesOnce) {
  const TemporaryFolder folder;
  (void)folder.write("force.csv", "time,value\n0,1\n");
  (void)folder.write("cloud.csv", test::sample_cloud());
  const std::string analysis =
      "analysis: { static: { loads: [ { body_force: [0, 1], time: { table: force.csv } }, "
      "{ force: [0, 1], time: { table: force.csv } } ] } }";
  const Case c = read_case(
      folder.write("case.yaml", replace_line(test::sample_cases().at("cloud"), "analysis", analysis)));
  EXPECT_THAT(c.files, ElementsAre(folder.path() / "cloud.csv", folder.path() / "force.csv"));
}

TEST(ReadTime, BadTablesAreNamedWithTheirLine) {
  EXPECT_THAT(complaint_about_table("t,value\n0,1\n"),
              HasSubstr("force.csv:1:1: expected the header time,value, got 't,value'"));
  EXPECT_THAT(complaint_about_table("time,value\n0,1\n1\n"), HasSubstr("force.csv:3:1: expected 2 fields"));
  EXPECT_THAT(complaint_about_table("time,value\n0,1\n1, 2 m\n"),
              HasSubstr("force.csv:3:4: expected a finite number for value, got '2 m'"));
  EXPECT_THAT(complaint_about_table("time,value\n0,1\n2,1\n\n2,3\n"),
              HasSubstr("force.csv:5:1: expected a time > 2 s, that of the line before, got 2"));
  EXPECT_THAT(complaint_about_table("time,value\n"), HasSubstr("force.csv:1:1: expected at least one line"));
  EXPECT_THAT(complaint_about_table("time,value\n0,nan\n"), HasSubstr("force.csv:2:3"));
}

class BadTimeTest : public testing::TestWithParam<BadCase> {};

TEST_P(BadTimeTest, GivesOneErrorWithPlaceExpectationAndRemedy) { test::expect_complaint(GetParam()); }

constexpr const char* condition = "- { fix";
#define PERIMODE_TIME(text) "  - { prescribe: { y: 1 }, at: { nearest: [0, 0] }, time: " text " }"
const BadCase times[] = {
    {"word", "plate", condition, PERIMODE_TIME("^ramp"), {"constant, or a map", "{ ramp: 1.0e-3 }"}},
    {"empty",
     "plate",
     condition,
     "  - { prescribe: { y: 1 }, at: { nearest: [0, 0] }, ^time: {} }",
     {"one of ramp, step, half_sine, ricker"}},
    {"unknown", "plate", condition, PERIMODE_TIME("{ ^rickr: 1 }"), {"nearest valid key is ricker"}},
    {"two", "plate", condition, PERIMODE_TIME("{ ramp: 1, ^step: 1 }"), {"both 'ramp' and 'step'"}},
    {"no_ramp", "plate", condition, PERIMODE_TIME("{ ramp: ^0 }"), {"a number > 0 in s"}},
    {"unit", "plate", condition, PERIMODE_TIME("{ half_sine: ^1 ms }"), {"units are not read"}},
    {"early_step", "plate", condition, PERIMODE_TIME("{ step: ^-1 }"), {"a number >= 0 in s"}},
    {"frequency", "plate", condition, PERIMODE_TIME("{ ricker: ^-1 }"), {"a number > 0 in Hz"}},
    {"gaussian_of_one", "plate", condition, PERIMODE_TIME("{ gaussian: ^[1] }"), {"the peak and the width"}},
    {"gaussian_width", "plate", condition, PERIMODE_TIME("{ gaussian: [1, ^0] }"), {"a number > 0 in s"}},
    {"no_table", "plate", condition, PERIMODE_TIME("{ table: ^none.csv }"), {"relative to the case file"}},
    {"syntax", "plate", condition, PERIMODE_TIME("{ expression: ^\"sin(t\" }"), {"a formula", "'sin(t'"}},
    {"place", "plate", condition, PERIMODE_TIME("{ expression: ^\"t*x\" }"), {"a formula of t alone"}},
    {"name", "plate", condition, PERIMODE_TIME("{ expression: ^\"2*time\" }"), {"a formula", "time"}},
    {"nothing", "plate", condition, PERIMODE_TIME("{ expression: ^\"\" }"), {"text"}},
};
#undef PERIMODE_TIME

INSTANTIATE_TEST_SUITE_P(Times, BadTimeTest, testing::ValuesIn(times), test::name_of);

}  // namespace
}  // namespace perimode
