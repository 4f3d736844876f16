// SPDX-License-Identifier: BSD-3-Clause
#include "results.hpp"

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
  if (!std::getline(in, line) || line != "quantity,body,horizon,ratio,mode,value,tolerance,source")
    invalid_input({"a table of expected results", line, "restore the file", {file.string(), 1, 1}});
  while (std::getline(in, line)) {
    ++number;
    std::vector<std::string> cells;
    std::istringstream cut(line);
    for (std::string cell; std::getline(cut, cell, ',');) cells.push_back(cell);
    if (cells.size() != 8)
      invalid_input(
          {"8 cells", fmt::to_string(cells.size()), "restore the file", {file.string(), number, 1}});
    expected[{cells[0], cells[1], std::stod(cells[2]), std::stoi(cells[3]), std::stoi(cells[4])}] = {
        std::stod(cells[5]), std::stod(cells[6]), cells[7]};
  }
  return expected;
}

void write_results(const std::filesystem::path& file, const Results& results) {
  Table table;
  table.columns = {"quantity", "body", "horizon", "ratio", "mode", "value"};
  for (const auto& [key, value] : results)
    table.rows.push_back({key.quantity, key.body, key.horizon, Offset{key.ratio}, Offset{key.mode}, value});
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
    if (std::abs(found->second - wanted.value) <= wanted.tolerance * std::abs(wanted.value)) continue;
    comparison.different.push_back(fmt::format(
        "{} of {}, horizon {}, m {}, mode {}: {:.10e}, expected {:.10e} within {:.0e}", key.quantity,
        key.body, key.horizon, key.ratio, key.mode, found->second, wanted.value, wanted.tolerance));
  }
  return comparison;
}

}  // namespace perimode::studies
