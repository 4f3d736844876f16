// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace perimode::studies {

/// Names one number of the study.
struct Key {
  std::string quantity;  ///< "omega", "error", ...
  std::string body;      ///< "odd", "surface_nodes self_cell", "mirror constant S", ...
  double horizon = 0.0;
  int ratio = 0;  ///< m = horizon / spacing; 0: of the continuum
  int mode = 0;   ///< 0: of all modes
  auto operator<=>(const Key&) const = default;
};

using Results = std::map<Key, double>;

struct Expected {
  double value = 0.0;
  double tolerance = 0.0;  ///< relative
  std::string source;
};
using ExpectedResults = std::map<Key, Expected>;

/// Reads a table with the columns of Key, then value, tolerance and source.
/// Throws invalid_input for any other file.
[[nodiscard]] ExpectedResults read_expected(const std::filesystem::path& file);

/// Writes results as a table with the columns of Key and value.
void write_results(const std::filesystem::path& file, const Results& results);

struct Comparison {
  int compared = 0;
  int missing = 0;                     ///< expected, but not computed in this run
  std::vector<std::string> different;  ///< one line for each disagreement
};
[[nodiscard]] Comparison compare(const Results& results, const ExpectedResults& expected);

}  // namespace perimode::studies
