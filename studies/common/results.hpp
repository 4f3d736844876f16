// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace perimode::studies {

/// Names one number of a study.
struct Key {
  std::string quantity;  ///< "omega", "error", ...
  std::string body;      ///< "odd", "surface_nodes self_cell", "mirror constant S", ...
  double horizon = 0.0;
  int ratio = 0;    ///< m = horizon / spacing; 0: of the continuum
  double at = 0.0;  ///< mode, instant or place the study names; 0: of all
  auto operator<=>(const Key&) const = default;
};

using Results = std::map<Key, double>;

struct Expected {
  double value = 0.0;
  double relative = 0.0;  ///< |found - value| <= relative |value| + absolute
  double absolute = 0.0;
  std::string source;
};
using ExpectedResults = std::map<Key, Expected>;

/// Reads a table with the columns of Key, then value, relative, absolute and source.
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

/// Prints the comparison and returns the exit code of a study: 0 where all that was compared agrees and
/// nothing is missing (`coarse`: something was compared), else 1.
[[nodiscard]] int report_comparison(const Comparison& comparison, const ExpectedResults& expected,
                                    bool coarse);

/// The number as text, "-" where there is none.
[[nodiscard]] std::string text(const Results& results, const Key& key, const char* format);
/// The expected number as text, "" where there is none.
[[nodiscard]] std::string text(const ExpectedResults& expected, const Key& key, const char* format);

}  // namespace perimode::studies
