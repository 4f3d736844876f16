// SPDX-License-Identifier: BSD-3-Clause
#include "studies/common/results.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "perimode/core/error.hpp"
#include "perimode/io/table.hpp"

namespace perimode::studies {

ExpectedResults read_expected(const std::filesystem::path& file) {
  ExpectedResults expected;
  std::ifstream in(file);
  std::string line;
  int number = 1;
  if (!std::getline(in, line) || line != "quantity,body,horizon,ratio,at,value,relative,absolute,source")
    invalid_input({"a table of expected results", line, "restore the file", {file.string(), 1, 1}});
  while (std::getline(in, line)) {
    ++number;
    std::vector<std::string> cells;
    std::istringstream cut(line);
    for (std::string cell; std::getline(cut, cell, ',');) cells.push_back(cell);
    if (cells.size() != 9)
      invalid_input(
          {"9 cells", fmt::to_string(cells.size()), "restore the file", {file.string(), number, 1}});
    expected[{cells[0], cells[1], std::stod(cells[2]), std::stoi(cells[3]), std::stod(cells[4])}] = {
        std::stod(cells[5]), std::stod(cells[6]), std::stod(cells[7]), cells[8]};
  }
  return expected;
}

void write_results(const std::filesystem::path& file, const Results& results) {
  Table table;
  table.columns = {"quantity", "body", "horizon", "ratio", "at", "value"};
  for (const auto& [key, value] : results)
    table.rows.push_back({key.quantity, key.body, key.horizon, Offset{key.ratio}, key.at, value});
  write_csv(file, table);
}

Comparison compare(const Results& results, const ExpectedResults& expected) {
  Comparison comparison;
  for (const auto& [key, wanted] : expected) {
    const auto found = results.find(key);
    if (found == results.end()) {
      ++comparison.missing;
      continue;
    }
    ++comparison.compared;
    if (std::abs(found->second - wanted.value) <= wanted.relative * std::abs(wanted.value) + wanted.absolute)
      continue;
    comparison.different.push_back(
        fmt::format("{} of {}, horizon {}, m {}, at {}: {:.10e}, expected {:.10e} within {:.1e}",
                    key.quantity, key.body, key.horizon, key.ratio, key.at, found->second, wanted.value,
                    wanted.relative * std::abs(wanted.value) + wanted.absolute));
  }
  return comparison;
}

int report_comparison(const Comparison& comparison, const ExpectedResults& expected, bool coarse) {
  fmt::print("\n{} of {} expected numbers compared, {} disagreements\n", comparison.compared, expected.size(),
             comparison.different.size());
  for (const std::string& line : comparison.different) fmt::print("  {}\n", line);
  const bool complete = comparison.compared > 0 && (coarse || comparison.missing == 0);
  return comparison.different.empty() && complete ? 0 : 1;
}

std::string text(const Results& results, const Key& key, const char* format) {
  const auto found = results.find(key);
  return found == results.end() ? "-" : fmt::format(fmt::runtime(format), found->second);
}

std::string text(const ExpectedResults& expected, const Key& key, const char* format) {
  const auto found = expected.find(key);
  return found == expected.end() ? "" : fmt::format(fmt::runtime(format), found->second.value);
}

}  // namespace perimode::studies
