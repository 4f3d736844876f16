// SPDX-License-Identifier: BSD-3-Clause
//
// alebrahim2021 [--coarse] PAPER.csv EXPECTED.csv [OUT]: tables 1 and 2, figs. 4 to 11 and eqs. (50), (52) of
// [alebrahim2021]. Prints tables beside the paper's numbers and verdicts, compares with EXPECTED.csv and
// writes OUT/results.csv, OUT/fig04.csv ... OUT/fig11.csv. Exit code 1: disagreement.
#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <optional>

#include "bars.hpp"
#include "curves.hpp"
#include "influence.hpp"
#include "plates.hpp"
#include "report.hpp"
#include "ridges.hpp"

namespace {

using namespace perimode::studies;

/// Figs. 5 and 8.
void run_ridges(const Kernels& bars, const Kernels& plates, bool coarse, Results& results, Figure* fig5,
                Figure* fig8) {
  for (const int n : coarse ? std::vector{3} : std::vector{1, 2, 3}) {
    RidgeRun run{std::string(1, static_cast<char>('a' + n - 1)), "original", n, bars.at({"original", n})};
    if (coarse) run.cells = 128, run.instants = 1024;
    run_bar_ridge(run, results, fig5);
    run.panel[0] = static_cast<char>(run.panel[0] + 3);
    run.body = "modified";
    run.alpha = bars.at({n == 2 ? "modified" : "G", n});
    run_bar_ridge(run, results, fig5);
  }
  for (const int n : coarse ? std::vector{2} : std::vector{2, 3})
    for (const bool modified : {false, true}) {
      const char panel = static_cast<char>('a' + (n - 2) * 4 + (modified ? 2 : 0));
      RidgeRun run{std::string(1, panel), modified ? "modified" : "original", n,
                   plates.at({modified ? "QP" : "original", n})};
      run.shear_panel = std::string(1, static_cast<char>(panel + 1));
      if (!modified) run.row_panel = n == 2 ? "row N=2" : "row N=3";
      run.cells = coarse ? 48 : 96;
      run.instants = coarse ? 512 : 2048;
      run_plate_ridge(run, results, fig8);
    }
}

/// What holds whatever the numbers: optimality, constraints, one number in two ways.
std::vector<std::string> broken_rules(const Results& results) {
  std::vector<std::string> broken;
  for (const auto& [which, value] : results) {
    const bool printed = which.body.ends_with("printed");
    if ((which.quantity == "optimality" && value > 1e-9) ||
        (which.quantity == "constraint" && !printed && std::abs(value) > 1e-10 * which.ratio * which.ratio))
      broken.push_back(
          fmt::format("{} of {}, N = {}: {:.1e}", which.quantity, which.body, which.ratio, value));
    if (which.quantity == "ridge_error" &&
        value > results.at({"time_step_shift", which.body, which.horizon, which.ratio, 0.0}) + 1e-3)
      broken.push_back(
          fmt::format("ridge of {}, N = {}: {:.1e} from omega(k)", which.body, which.ratio, value));
    if (which.quantity == "least_squared" && value < 0.0)
      broken.push_back(fmt::format("{}, N = {}: omega^2 = {:.1e}", which.body, which.ratio, value));
  }
  return broken;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  const bool coarse = std::erase(words, "--coarse") > 0;
  if (words.size() < 2 || words.size() > 3) {
    fmt::print(stderr, "usage: alebrahim2021 [--coarse] PAPER.csv EXPECTED.csv [OUT]\n");
    return 2;
  }
  try {
    const ExpectedResults paper = read_expected(words[0]), expected = read_expected(words[1]);
    Results results;
    Kernels bars = optimised_bars({1, 2, 3, 4, 5, 6, 7, 8, 9, 10}, results);
    add_printed_bars(paper, results, bars);
    add_bands(paper, results, bars);
    add_nearest_neighbours(results);
    add_long_waves({1, 2, 3, 4, 5, 6, 7, 8, 9, 10}, results);
    Kernels plates = optimised_plates(coarse ? std::vector{2, 3} : std::vector{2, 3, 4, 5}, results);
    add_table2(paper, results, plates);
    add_numbering(paper, results);
    add_stability(plates, coarse ? 61 : 241, results);
    add_influence(paper, plates, results);
    Figure fig5, fig8;
    const bool draw = words.size() == 3;
    run_ridges(bars, plates, coarse, results, draw ? &fig5 : nullptr, draw ? &fig8 : nullptr);
    const std::vector<Verdict> verdicts = judge(paper, results);

    print_bars(paper, results);
    print_long_waves(results);
    print_table2(results);
    print_optima(results);
    print_influence(paper, results);
    print_ridges(results);
    print_verdicts(verdicts);
    if (draw) {
      const std::filesystem::path out = words[2];
      std::filesystem::create_directories(out);
      write_results(out / "results.csv", results);
      write_figure(out, "fig04", long_wave_figure(results));
      write_figure(out, "fig05", fig5);
      write_figure(out, "fig06", bar_error_figure(bars, results));
      write_figure(out, "fig07", bar_figure(bars, results));
      write_figure(out, "fig08", fig8);
      write_figure(out, "fig09", contour_figure(plates));
      write_figure(out, "fig10", influence_figure(paper, plates));
      write_figure(out, "fig11", plate_error_figure(plates, results));
    }
    Comparison comparison = compare(results, expected);
    for (const std::string& rule : broken_rules(results)) comparison.different.push_back(rule);
    return report_comparison(comparison, expected, coarse);
  } catch (const std::exception& error) {
    fmt::print(stderr, "alebrahim2021: {}\n", error.what());
    return 1;
  }
}
