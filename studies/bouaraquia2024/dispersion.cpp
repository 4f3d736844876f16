// SPDX-License-Identifier: BSD-3-Clause
//
// bouaraquia2024_dispersion EXPECTED.csv [OUT]: figs. 2 and 4 to 10 of [bouaraquia2024], the constant and the
// Gaussian micromodulus and the waves they carry, for three ways to sum. Prints tables, compares them with
// EXPECTED.csv and writes OUT/waves.csv (every number by name), OUT/shapes.csv (fig. 2) and
// OUT/dispersion.csv (figs. 4 to 10). Exit code 1: disagreement.
#include <fmt/format.h>

#include <cmath>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "curves.hpp"

namespace {

using namespace perimode::studies;
using perimode::Micromodulus;

Results measured() {
  Results results;
  for (const Micromodulus& kernel : {constant, gaussian(1.0), gaussian(2.0)}) {
    for (const Rule rule : rules) {
      for (const double horizon : three_spacings) add_waves({kernel, rule, horizon, 3}, results);
      for (const int m : ratios) add_waves({kernel, rule, fixed_horizon, m}, results);
      add_order({kernel, rule, fixed_horizon, 20}, results);
    }
    add_continuum(kernel, fixed_horizon, results);
  }
  for (const double courant : {0.5, 0.0}) add_differences(0.002, courant, results);
  for (const double p : {1.0, 2.0, 3.0}) add_shape(gaussian(p), results);
  return results;
}

void print_frequencies(const Results& results, const ExpectedResults& expected) {
  fmt::print("{:<28}{:>14}{:>4}{:>18}{:>18}{:>18}\n", "omega/v, rad/m", "horizon, mm", "m", "k = 500", "1000",
             "1500");
  for (const auto& entry : results) {
    Key key = entry.first;
    if (key.quantity != "omega" || key.at != 500.0) continue;
    std::string found, wanted;
    for (const double k : {500.0, 1000.0, 1500.0}) {
      key.at = k;
      found += fmt::format("{:>18}", text(results, key, "{:.10f}"));
      wanted += fmt::format("{:>18}", text(expected, key, "{:.10f}"));
    }
    fmt::print("{:<28}{:>14g}{:>4}{}\n", key.body, 1e3 * key.horizon, key.ratio, found);
    if (wanted.find_first_not_of(' ') != std::string::npos) fmt::print("{:<46}{}\n", "  expected", wanted);
  }
}

void print_waves(const Results& results) {
  fmt::print("\n{:<24}{:>4}{:>12}{:>16}{:>12}{:>12}{:>10}{:>12}{:>10}{:>10}\n", "horizon 4 mm", "m",
             "long waves", "5 % to k delta", "cut-off dx", "at k dx/pi", "v dt/dx", "sufficient", "eq. (42)",
             "order");
  for (const auto& entry : results) {
    const Key& key = entry.first;
    if (key.quantity != "long_wave" || key.horizon != fixed_horizon) continue;
    const auto cell = [&key, &results](const char* quantity, const char* format) {
      return text(results, {quantity, key.body, key.horizon, key.ratio, 0.0}, format);
    };
    fmt::print("{:<24}{:>4}{:>12.6f}{:>16}{:>12}{:>12}{:>10}{:>12}{:>10}{:>10}\n", key.body, key.ratio,
               entry.second, cell("band", "{:.4f}"), cell("cut_off", "{:.6f}"), cell("cut_off_k", "{:.4f}"),
               cell("step", "{:.6f}"), cell("sufficient_step", "{:.4f}"), cell("printed_step", "{:.4f}"),
               key.ratio == 10 ? text(results, {"order", key.body, key.horizon, 20, 1000.0}, "{:.3f}") : "");
  }
}

/// What holds whatever the numbers: speeds of long waves that have a closed form, to round-off.
std::vector<std::string> broken_rules(const Results& results) {
  std::vector<std::string> broken;
  for (const auto& [key, speed] : results) {
    if (key.quantity != "long_wave") continue;
    const bool whole = key.body == "constant uncorrected";
    if (!whole && key.body != "constant corrected" && !key.body.ends_with("normalised")) continue;
    const double exact = whole ? std::sqrt(1.0 + 1.0 / key.ratio) : 1.0;
    if (std::abs(speed - exact) > 1e-12)
      broken.push_back(
          fmt::format("long waves of {}, m {}: {:.15f}, not {:.15f}", key.body, key.ratio, speed, exact));
  }
  return broken;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.empty() || words.size() > 2) {
    fmt::print(stderr, "usage: bouaraquia2024_dispersion EXPECTED.csv [OUT]\n");
    return 2;
  }
  try {
    const ExpectedResults expected = read_expected(words[0]);
    const Results results = measured();
    print_frequencies(results, expected);
    print_waves(results);
    if (words.size() == 2) {
      const std::filesystem::path out = words[1];
      std::filesystem::create_directories(out);
      write_results(out / "waves.csv", results);
      write_csv(out / "shapes.csv", shape_curves({constant, gaussian(1.0), gaussian(2.0), gaussian(3.0)}));
      write_csv(out / "dispersion.csv", dispersion_curves(paper_figures()));
    }
    Comparison comparison = compare(results, expected);
    for (const std::string& rule : broken_rules(results)) comparison.different.push_back(rule);
    return report_comparison(comparison, expected, false);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bouaraquia2024_dispersion: {}\n", error.what());
    return 1;
  }
}
