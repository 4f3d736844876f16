// SPDX-License-Identifier: BSD-3-Clause
//
// bouaraquia2024 [--coarse] EXPECTED.csv [OUT]: strain history of a bar let go from a uniform strain, fig. 12
// of [bouaraquia2024], for constant and Gaussian kernels and three ways to sum. Prints tables, compares them
// with EXPECTED.csv and writes OUT/results.csv and OUT/histories.csv. Exit code 1: disagreement.
#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "bars.hpp"
#include "report.hpp"

namespace {

using namespace perimode::studies;
using perimode::Kernel;
using perimode::Micromodulus;
using perimode::Table;

std::vector<BarRun> coarse_runs() {
  const EndsKind walls = ends_kinds().front();
  std::vector<BarRun> runs;
  for (const Micromodulus& kernel : {constant, gaussian(2.0)})
    for (const Rule rule : {Rule::corrected, Rule::normalised})
      runs.push_back({kernel, rule, walls, 800, 5, 1});
  return runs;
}

std::vector<BarRun> all_runs() {
  std::vector<BarRun> runs;
  for (const Micromodulus& kernel : {constant, gaussian(2.0)})
    for (const Rule rule : {Rule::corrected, Rule::uncorrected, Rule::normalised})
      runs.push_back({kernel, rule});
  for (const double p : {1.0, 3.0}) runs.push_back({gaussian(p), Rule::normalised});
  for (std::size_t ends = 1; ends < ends_kinds().size(); ++ends)
    for (const Micromodulus& kernel : {constant, gaussian(2.0)})
      runs.push_back({kernel, Rule::corrected, ends_kinds()[ends]});
  for (const auto& [cells, ratio] : {std::pair{1600, 5}, std::pair{800, 10}})
    for (const Rule rule : {Rule::corrected, Rule::normalised})
      for (const Micromodulus& kernel : {constant, gaussian(2.0)})
        if (rule == Rule::corrected || kernel.kernel == Kernel::gaussian)
          runs.push_back({kernel, rule, ends_kinds().front(), cells, ratio, 1});
  return runs;
}

/// What holds whatever the numbers: odd and even walls move as their closed form says, to round-off.
std::vector<std::string> broken_rules(const Results& results) {
  std::vector<std::string> broken;
  for (const auto& [key, value] : results)
    if (key.quantity == "discrete_error" && value > 1e-10)
      broken.push_back(fmt::format("{}, m {}: {:.1e} from the closed form", key.body, key.ratio, value));
  return broken;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  const bool coarse = std::erase(words, "--coarse") > 0;
  if (words.empty() || words.size() > 2) {
    fmt::print(stderr, "usage: bouaraquia2024 [--coarse] EXPECTED.csv [OUT]\n");
    return 2;
  }
  try {
    const ExpectedResults expected = read_expected(words[0]);
    const std::vector<BarRun> runs = coarse ? coarse_runs() : all_runs();
    Results results;
    Table histories;
    add_exact(histories);
    for (const BarRun& run : runs) run_bar(run, results, &histories);
    const auto l2 = [&](const char* kernel) {
      return results.at({"l2_error", fmt::format("{} normalised odd/even", kernel), 5.0 / 800.0, 5, 1.0});
    };
    results[{"l2_ratio", "gaussian2/constant normalised", 5.0 / 800.0, 5, 1.0}] =
        l2("gaussian2") / l2("constant");

    print_bars(runs, results, expected);
    print_strains(runs, results, expected);
    if (words.size() == 2) {
      std::filesystem::create_directories(words[1]);
      write_results(std::filesystem::path(words[1]) / "results.csv", results);
      write_csv(std::filesystem::path(words[1]) / "histories.csv", histories);
    }
    Comparison comparison = compare(results, expected);
    for (const std::string& rule : broken_rules(results)) comparison.different.push_back(rule);
    return report_comparison(comparison, expected, coarse);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bouaraquia2024: {}\n", error.what());
    return 1;
  }
}
