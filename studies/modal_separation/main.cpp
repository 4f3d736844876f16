// SPDX-License-Identifier: BSD-3-Clause
//
// modal_separation [--coarse] EXPECTED.csv [OUT]: eigenfrequencies of bars and plates against separation of
// variables. Prints tables, compares them with EXPECTED.csv and writes OUT/results.csv. Exit code 1:
// disagreement.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "bars.hpp"
#include "plates.hpp"
#include "report.hpp"

namespace {

using namespace perimode::studies;

/// What holds for every body, whatever its numbers: where the lattice has a closed form the frequencies are
/// that one (1e-10 leaves room for eps times the condition of a bar of 1000 cells), and spectra are real.
std::vector<std::string> broken_rules(const Results& results) {
  std::vector<std::string> broken;
  for (const auto& [key, value] : results) {
    const double limit = key.quantity == "discrete_error" ? 1e-10
                         : key.quantity == "imaginary"    ? 1e-8
                                                          : HUGE_VAL;
    if (std::abs(value) > limit)
      broken.push_back(fmt::format("{} of {}, m {}: {:.2e}, at most {:.0e}", key.quantity, key.body,
                                   key.ratio, value, limit));
  }
  return broken;
}

double largest_discrete_error(const Results& results) {
  double largest = 0.0;
  for (const auto& [key, value] : results)
    if (key.quantity == "discrete_error") largest = std::max(largest, std::abs(value));
  return largest;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  const bool coarse = std::erase(words, "--coarse") > 0;
  if (words.empty() || words.size() > 2) {
    fmt::print(stderr, "usage: modal_separation [--coarse] EXPECTED.csv [OUT]\n");
    return 2;
  }
  try {
    const ExpectedResults expected = read_expected(words[0]);
    constexpr double horizon = 0.1;
    constexpr int fixed_ratio = 10;
    const std::vector<int> ratios = coarse ? std::vector{5, 10, 25} : std::vector{5, 10, 25, 50, 100};
    const std::vector<double> horizons =
        coarse ? std::vector{0.2, 0.05} : std::vector{0.2, 0.05, 0.025, 0.0125};
    const std::vector<int> plate_ratios = coarse ? std::vector{3} : std::vector{3, 6, 9, 12};

    Results results;
    for (const std::string& name : bar_names()) {
      for (const int m : ratios) run_bar(name, horizon, m, results);
      for (const double delta : horizons) run_bar(name, delta, fixed_ratio, results);
    }
    derive({horizon}, ratios, results);
    for (const std::string& name : plate_names())
      for (const int m : plate_ratios) run_plate(name, m, results);

    for (const std::string& name : bar_names()) print_bar(name, horizon, ratios, results, expected);
    print_surface_nodes(horizon, ratios, results, expected);
    std::vector<double> all_horizons = horizons;
    all_horizons.insert(all_horizons.begin() + 1, horizon);
    for (const std::string& name : bar_names()) print_horizons(name, all_horizons, fixed_ratio, results);
    print_plates(plate_ratios, results, expected);

    fmt::print(
        "\nlargest relative difference from closed forms of the lattice, all bars and plates: {:.1e}\n",
        largest_discrete_error(results));

    if (words.size() == 2) {
      std::filesystem::create_directories(words[1]);
      write_results(std::filesystem::path(words[1]) / "results.csv", results);
    }
    Comparison comparison = compare(results, expected);
    for (const std::string& rule : broken_rules(results)) comparison.different.push_back(rule);
    return report_comparison(comparison, expected, coarse);
  } catch (const std::exception& error) {
    fmt::print(stderr, "modal_separation: {}\n", error.what());
    return 1;
  }
}
