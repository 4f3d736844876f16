// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "io/case_sections.hpp"
#include "io/number_table.hpp"

namespace perimode::case_file {

namespace {

using Kind = TimeFunction::Kind;

TimeFunction read_time_table(const Cursor& cursor, InputFiles& files) {
  const std::filesystem::path file = files.add(cursor, "force.csv");
  NumberTable table = read_number_table(file, {"time,value"});
  const std::vector<double>& time = table.column[0];
  for (std::size_t k = 1; k < time.size(); ++k) {
    if (time[k] > time[k - 1]) continue;
    invalid_input({fmt::format("a time > {} s, that of the line before", time[k - 1]),
                   fmt::format("{}", time[k]),
                   "give ascending times, each once",
                   {file.string(), table.line[k], 1}});
  }
  TimeFunction function{Kind::table};
  function.time = std::move(table.column[0]);
  function.value = std::move(table.column[1]);
  return function;
}

TimeFunction read_time_formula(const Cursor& cursor) {
  TimeFunction function{Kind::expression};
  function.formula.emplace(cursor.text("\"sin(2*pi*50*t)\""), cursor.where());
  for (const char axis : std::string_view("xyz")) {
    if (function.formula->uses(axis)) {
      cursor.complain("a formula of t alone",
                      fmt::format("take {} out: time functions hold everywhere", axis));
    }
  }
  return function;
}

TimeFunction read_gaussian(const Cursor& cursor) {
  const std::vector<Cursor> numbers = cursor.items("[3.0e-4, 1.0e-4]");
  if (numbers.size() != 2) {
    cursor.complain("a list of 2 times in s, the peak and the width", "for example [3.0e-4, 1.0e-4]");
  }
  return {Kind::gaussian, numbers[0].number({"s", "3.0e-4", Sign::any}), numbers[1].number({"s", "1.0e-4"})};
}

}  // namespace

TimeFunction read_time(const Cursor& cursor, InputFiles& files) {
  if (cursor.node().kind == CaseNode::Kind::scalar && cursor.node().text == "constant") return {};
  if (cursor.node().kind != CaseNode::Kind::map) {
    cursor.complain("constant, or a map of one time function", "for example { ramp: 1.0e-3 }");
  }
  const Section time(cursor, {"ramp", "step", "half_sine", "ricker", "gaussian", "table", "expression"});
  const std::string_view kind =
      time.exactly_one({"ramp", "step", "half_sine", "ricker", "gaussian", "table", "expression"});
  const Cursor value = *time.find(kind);
  if (kind == "table") return read_time_table(value, files);
  if (kind == "expression") return read_time_formula(value);
  if (kind == "gaussian") return read_gaussian(value);
  if (kind == "step") return {Kind::step, value.number({"s", "1.0e-3", Sign::non_negative})};
  if (kind == "ricker") return {Kind::ricker, value.number({"Hz", "1.0e+4"})};
  return {kind == "ramp" ? Kind::ramp : Kind::half_sine, value.number({"s", "1.0e-3"})};
}

}  // namespace perimode::case_file
