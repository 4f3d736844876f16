// SPDX-License-Identifier: BSD-3-Clause
//
// ganzenmueller2013_opening [--coarse] EXPECTED.csv [--out OUT]: the crack opening of the paper with
// parameters of our own: first failure, peak and Griffith load against linear elastic fracture mechanics,
// and a ramped run. Prints tables, compares them with EXPECTED.csv and writes OUT/opening.csv. Exit code 1:
// disagreement.
#include "studies/common/crack_opening.hpp"

#include <fmt/format.h>

#include <cmath>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "openings.hpp"

namespace {

using namespace perimode::studies;
using perimode::Calibration;

constexpr double claimed = 146.9;  ///< Pa, what the paper finds and calls the analytical load

void print_openings(const Results& results, const ExpectedResults& expected) {
  fmt::print(
      "loads over that of LEFM, {:.7f} Pa; with the critical stretch as printed in the paper all are\n"
      "1/sqrt(2) of it (the problem is linear), in Pa in the last "
      "column\n{:<8}{:>4}{:>6}{:>14}{:>12}{:>10}{:>9}{:>10}{:>10}"
      "{:>9}{:>16}\n",
      crack_opening_stress(opening_crack), "", "m", "W/dx", "first", "expected", "peak", "expected",
      "Griffith", "expected", "events", "printed, Pa");
  for (const auto& entry : results) {
    const Key& key = entry.first;
    if (key.quantity != "griffith") continue;
    const auto same = [&](const char* quantity) {
      return Key{quantity, key.body, key.horizon, key.ratio, key.at};
    };
    const auto first = results.find(same("first"));
    const std::string printed =
        first == results.end()
            ? "-"
            : fmt::format("{:.1f} / {:.1f}",
                          first->second * crack_opening_stress(opening_crack) / std::sqrt(2.0),
                          results.at(same("peak")) * crack_opening_stress(opening_crack) / std::sqrt(2.0));
    fmt::print("{:<8}{:>4}{:>6.0f}{:>14}{:>12}{:>10}{:>9}{:>10}{:>10}{:>9}{:>16}\n", key.body, key.ratio,
               key.at, text(results, same("first"), "{:.10f}"), text(expected, same("first"), "{:.6f}"),
               text(results, same("peak"), "{:.6f}"), text(expected, same("peak"), "{:.6g}"),
               text(results, same("griffith"), "{:.6f}"), text(expected, same("griffith"), "{:.6f}"),
               text(results, same("events"), "{:.0f}"), printed);
  }
  fmt::print("paper: {} Pa, found and analytical alike\n", claimed);
}

void print_ramps(const Results& results) {
  for (const auto& entry : results) {
    const Key& key = entry.first;
    if (key.quantity != "ramp_first") continue;
    const auto of = [&](const char* quantity) {
      return results.at({quantity, key.body, key.horizon, key.ratio, key.at});
    };
    const Key still = {"first", key.body, 0.0, key.ratio, key.at};
    fmt::print(
        "ramped, W/dx {:.0f}, {:.0f} s ({:.0f} waves through the height, rows at {:.1e} of sound): first "
        "break {:.4f} "
        "(quasi-static {}), collapse {:.4f} (peak {})\n",
        key.at, key.horizon, of("ramp_transits"), of("ramp_velocity"), entry.second,
        text(results, still, "{:.4f}"), of("ramp_collapse"),
        text(results, {"peak", key.body, 0.0, key.ratio, key.at}, "{:.4f}"));
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  const bool coarse = std::erase(words, "--coarse") > 0;
  std::string out;
  if (words.size() == 3 && words[1] == "--out") {
    out = words[2];
    words.resize(1);
  }
  if (words.size() != 1) {
    fmt::print(stderr, "usage: ganzenmueller2013_opening [--coarse] EXPECTED.csv [--out OUT]\n");
    return 2;
  }
  try {
    const ExpectedResults expected = read_expected(words[0]);
    const std::vector<int> sizes = coarse ? std::vector{24, 40} : std::vector{24, 40, 60, 80, 120, 160, 200};
    Results results;
    for (const int cells : sizes) {
      for (const Calibration c : {Calibration::discrete, Calibration::discrete_cut, Calibration::continuum})
        add_opening(cells, 3, c, results);
      for (const int ratio : {2, 4, 5}) {
        if (cells > (ratio == 5 ? 40 : 120)) continue;
        add_opening(cells, ratio, Calibration::discrete_cut, results);
        add_opening_griffith(cells, ratio, Calibration::discrete, results);
      }
      fmt::print(stderr, "W/dx {} done\n", cells);
    }
    for (const double seconds : coarse ? std::vector{10.0} : std::vector{10.0, 60.0})
      add_ramped_opening(40, seconds, results);
    print_openings(results, expected);
    print_ramps(results);
    if (!out.empty()) {
      std::filesystem::create_directories(out);
      write_results(std::filesystem::path(out) / "opening.csv", results);
    }
    return report_comparison(compare(results, expected), expected, coarse);
  } catch (const std::exception& error) {
    fmt::print(stderr, "ganzenmueller2013_opening: {}\n", error.what());
    return 1;
  }
}
