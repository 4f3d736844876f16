// SPDX-License-Identifier: BSD-3-Clause
#include "report.hpp"

#include <fmt/format.h>

#include <cmath>

namespace perimode::studies {
namespace {

std::string cell(const Results& results, const char* quantity, const std::string& body, int n, double at,
                 const char* format) {
  return text(results, key(quantity, body, n, at), format);
}

void print_table1(const ExpectedResults& paper, const Results& results) {
  fmt::print("table 1: printed / computed / difference\n");
  for (const int n : {3, 5, 10}) {
    if (!results.contains(key("alpha", "P.C", n, 1))) continue;
    fmt::print("N = {:<10}", n);
    for (const std::string& method : method_names) fmt::print("{:<32}", method);
    for (int i = 1; i <= n; ++i) {
      fmt::print("\n  alpha_{:<6}", i);
      for (const std::string& method : method_names) {
        const Key which = key("alpha", method, n, i);
        const double printed = paper.at(which).value, found = results.at(which);
        fmt::print("{:>7} {:>12.6f} {:>+7.3f}     ", printed, found, found - printed);
      }
    }
    fmt::print("\n");
  }
}

}  // namespace

void print_bars(const ExpectedResults& paper, const Results& results) {
  print_table1(paper, results);
  for (const auto& [quantity, title] : {std::pair{"error49", "eq. (49) over that of the original N = 3"},
                                        std::pair{"squared_residual", "int R^2 dk of eq. (44)"}}) {
    fmt::print("\n{}\n{:<4}{:>14}{:>14}{:>14}{:>14}{:>14}{:>14}\n", title, "N", "original", "P.C", "S.C",
               "L.S", "G", "L1");
    for (int n = 1; n <= 10; ++n) {
      if (!results.contains(key(quantity, "original", n))) continue;
      std::string line;
      for (const char* name : {"original", "P.C", "S.C", "L.S", "G", "L1"})
        line += fmt::format("{:>14}", cell(results, quantity, name, n, 0, "{:.10f}"));
      fmt::print("{:<4}{}\n", n, line);
      if (!results.contains(key(quantity, "P.C printed", n))) continue;
      line.clear();
      for (const std::string& method : method_names)
        line += fmt::format("{:>14}", cell(results, quantity, method + " printed", n, 0, "{:.5f}"));
      fmt::print("{:<18}{}\n", "  as printed", line);
    }
  }
}

void print_long_waves(const Results& results) {
  fmt::print(
      "\nspeeds of long waves over the classical ones, original "
      "plates\n{:<4}{:>7}{:>7}{:>14}{:>14}{:>14}{:>14}\n",
      "N", "bonds", "orbits", "P at 0", "P at 45", "S at 0", "S at 45");
  for (int n = 1; n <= 10; ++n) {
    if (!results.contains(key("bonds", "plate", n))) continue;
    std::string line;
    for (const char* branch : {"P", "S"})
      for (const double degrees : {0.0, 45.0})
        line += fmt::format("{:>14}", cell(results, "long_wave_speed", branch, n, degrees, "{:.10f}"));
    fmt::print("{:<4}{:>7}{:>7}{}\n", n, cell(results, "bonds", "plate", n, 0, "{:.0f}"),
               cell(results, "orbits", "plate", n, 0, "{:.0f}"), line);
  }
}

void print_table2(const Results& results) {
  fmt::print(
      "\ntable 2 as printed: nu = 1/4 wants A = 1.2, B = 0.4, speeds "
      "1\n{:<18}{:>18}{:>18}{:>8}{:>8}{:>8}{:>8}{:>6}{:>9}{:>9}\n",
      "", "A", "B", "Vp 0", "Vs 0", "Vp 45", "Vs 45", "(39)", "(51)", "(45)");
  for (const int n : {2, 3})
    for (const char* set : {" optimal", " positive"})
      for (const std::string& method : method_names) {
        const std::string name = method + set;
        if (!results.contains(key("A", name, n))) continue;
        const auto number = [&](const char* quantity, double at, const char* format) {
          return cell(results, quantity, name, n, at, format);
        };
        const double holds = results.at(key("eq39", name, n));
        fmt::print("{:<18}{:>18}{:>18}{:>8}{:>8}{:>8}{:>8}{:>6}{:>9}{:>9}\n", fmt::format("{} {}", n, name),
                   number("A", 0, "{:.4f}") + number("A_half_digit", 0, " +-{:.3f}"),
                   number("B", 0, "{:.4f}") + number("B_half_digit", 0, " +-{:.3f}"),
                   number("Vp", 0, "{:.3f}"), number("Vs", 0, "{:.3f}"), number("Vp", 45, "{:.3f}"),
                   number("Vs", 45, "{:.3f}"), holds > 1.5 ? "yes" : (holds > 0.5 ? "1 dig." : "no"),
                   number("error51", 0, "{:.5f}"), number("error45", 0, "{:.5f}"));
      }
  for (const int n : {2, 3})
    fmt::print("numbering, N = {}: eq. (39) missed by {} rms; the next best numbering {}\n", n,
               cell(results, "numbering_miss", "table 2", n, 1, "{:.3f}"),
               cell(results, "numbering_miss", "table 2", n, 2, "{:.3f}"));
}

void print_optima(const Results& results) {
  fmt::print(
      "\nours, eq. (39) exact: errors over those of the original of the same "
      "N\n{:<12}{:>11}{:>11}{:>11}{:>9}{:>10}{:>10}  {}\n",
      "N", "(51)", "(45)", "omega_max", "s^2 min", "25 ns <", "optimality", "multipliers by length");
  for (const int n : {2, 3, 4, 5})
    for (const std::string name : {"original", "QP", "L1", "QP 0.5", "QP 0"}) {
      if (!results.contains(key("error51", name, n))) continue;
      std::string alpha;
      for (int i = 1; results.contains(key("alpha", name, n, i)); ++i)
        alpha += fmt::format(" {:.6f}", results.at(key("alpha", name, n, i)));
      fmt::print("{:<12}{:>11}{:>11}{:>11}{:>9}{:>10}{:>10} {}\n", fmt::format("{} {}", n, name),
                 cell(results, "error51", name, n, 0, "{:.7f}"),
                 cell(results, "error45", name, n, 0, "{:.7f}"),
                 cell(results, "omega_max", name, n, 0, "{:.4f}"),
                 cell(results, "least_speed_squared", name, n, 0, "{:.3f}"),
                 cell(results, "stable_step_ns", name, n, 0, "{:.1f} ns"),
                 cell(results, "optimality", name + " plate", n, 0, "{:.0e}"), alpha);
    }
  for (const std::string& method : method_names)
    for (const char* set : {" optimal", " positive"})
      if (results.contains(key("omega_max", method + set, 3)))
        fmt::print("{:<34}{:>11}{:>9}{:>10}\n", "3 " + method + set,
                   cell(results, "omega_max", method + set, 3, 0, "{:.4f}"),
                   cell(results, "least_speed_squared", method + set, 3, 0, "{:.3f}"),
                   cell(results, "stable_step_ns", method + set, 3, 0, "{:.1f} ns"));
}

void print_influence(const ExpectedResults& paper, const Results& results) {
  fmt::print("\n{:<26}{:>14}{:>14}{:>14}\n", "influence function", "eq. (50)", "our fit", "S.C positive");
  const std::vector<double> column =
      by_orbit(printed_column(paper, "table2", "S.C positive", 3), table2_orbits(3));
  std::size_t orbit = 0;
  for (const int squared : {1, 2, 4, 5, 8, 9})
    fmt::print("{:<26}{:>14}{:>14}{:>14}\n", fmt::format("at sqrt({})", squared),
               cell(results, "influence", "eq. 50", 3, squared, "{:.4f}"),
               cell(results, "influence", "fit", 3, squared, "{:.4f}"), column[orbit++]);
  for (const char* quantity : {"energy_ratio", "least", "least_at", "influence_deviation"})
    fmt::print("{:<26}{:>14}{:>14}\n", quantity, cell(results, quantity, "eq. 50", 3, 0, "{:.5f}"),
               cell(results, quantity, "fit", 3, 0, "{:.5f}"));
  for (const char* branch : {"P", "S"})
    fmt::print("{:<26}{:>14}{:>14}\n", fmt::format("long waves on the grid, {}", branch),
               cell(results, "long_wave_speed", fmt::format("{} eq. 50", branch), 3, 0, "{:.5f}"),
               cell(results, "long_wave_speed", fmt::format("{} fit", branch), 3, 0, "{:.5f}"));
  for (const std::string glass : {"soda-lime", "Duran 50"}) {
    fmt::print("critical stretch, {:<10}", glass);
    for (const char* name : {" original", " eq. 50", " fit"})
      fmt::print("{}: {} ({})   ", name, cell(results, "critical_stretch", glass + name, 3, 0, "{:.9f}"),
                 text(paper, key("critical_stretch", glass + name, 3), "{}"));
    fmt::print("\n");
  }
}

void print_ridges(const Results& results) {
  fmt::print("\n{:<28}{:>18}{:>24}\n", "ridge of a simulation", "from eq. (10), (15)",
             "from the stepped, bins");
  for (const auto& [which, value] : results)
    if (which.quantity == "ridge_bins")
      fmt::print("{:<28}{:>18}{:>24.4f}\n", fmt::format("{}, N = {}", which.body, which.ratio),
                 cell(results, "ridge_error", which.body, which.ratio, 0, "{:.2e}"), value);
  for (const auto& [which, value] : results)
    if (which.quantity == "row_ghost")
      fmt::print("{}, N = {}, one row of nodes: {:.0f} % of {} peaks at gathering frequencies\n", which.body,
                 which.ratio, 100.0 * value,
                 cell(results, "row_peaks", which.body, which.ratio, 0, "{:.0f}"));
}

void print_verdicts(const std::vector<Verdict>& verdicts) {
  fmt::print("\n{:<46}{:<26}{:<46}{}\n", "the paper", "says", "here", "verdict");
  for (const Verdict& verdict : verdicts)
    fmt::print("{:<46}{:<26}{:<46}{}; {}\n", verdict.item, verdict.paper, verdict.here,
               verdict.reproduced ? "reproduced" : "NOT reproduced", verdict.reason);
}

}  // namespace perimode::studies
