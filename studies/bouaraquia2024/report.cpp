// SPDX-License-Identifier: BSD-3-Clause
#include "report.hpp"

#include <fmt/format.h>

#include <functional>

namespace perimode::studies {
namespace {

Key key_of(const BarRun& run, const char* quantity, double at) {
  return {quantity, name_of(run), static_cast<double>(run.ratio) / run.cells, run.ratio, at};
}

/// The line of numbers of one bar, computed or expected.
std::string line(const BarRun& run, const std::function<std::string(const Key&, const char*)>& cell) {
  std::string text;
  for (const double periods : {1.0, 2.0, 3.0})
    text += fmt::format("{:>10}", cell(key_of(run, "l2_error", periods), "{:.5f}"));
  text += fmt::format("{:>12}", cell(key_of(run, "far_error", 1.0), "{:.4f}"));
  return text + fmt::format("{:>12}", cell(key_of(run, "overshoot", 1.0), "{:.4f}"));
}

}  // namespace

void print_bars(const std::vector<BarRun>& runs, const Results& results, const ExpectedResults& expected) {
  fmt::print("{:<40}{:>6}{:>4}{:>30}{:>12}{:>12}{:>16}\n", "strain at x = 1/2 against the exact one", "N",
             "m", "L2 over 1, 2, 3 periods", "far, max", "overshoot", "closed form");
  for (const BarRun& run : runs) {
    const auto found = [&](const Key& key, const char* format) { return text(results, key, format); };
    const auto wanted = [&](const Key& key, const char* format) { return text(expected, key, format); };
    fmt::print("{:<40}{:>6}{:>4}{}{:>16}\n", name_of(run), run.cells, run.ratio, line(run, found),
               text(results, key_of(run, "discrete_error", run.periods), "{:.1e}"));
    if (expected.contains(key_of(run, "l2_error", 1.0)))
      fmt::print("{:<50}{}\n", "  expected", line(run, wanted));
  }
}

void print_strains(const std::vector<BarRun>& runs, const Results& results, const ExpectedResults& expected) {
  fmt::print("\n{:<40}{:>16}{:>16}{:>16}{:>16}\n", "strain / e0 at", "0.1 ms", "0.2 ms", "0.3 ms", "0.6 ms");
  for (const BarRun& run : runs) {
    if (!expected.contains(key_of(run, "strain", 1e-4))) continue;
    std::string found, wanted;
    for (const double t : {1e-4, 2e-4, 3e-4, 6e-4}) {
      found += fmt::format("{:>16}", text(results, key_of(run, "strain", t), "{:.10f}"));
      wanted += fmt::format("{:>16}", text(expected, key_of(run, "strain", t), "{:.10f}"));
    }
    fmt::print("{:<40}{}\n{:<40}{}\n", name_of(run), found, "  expected", wanted);
  }
}

}  // namespace perimode::studies
