// SPDX-License-Identifier: BSD-3-Clause
#include "report.hpp"

#include <fmt/format.h>

#include <array>

namespace perimode::studies {
namespace {

bool has(const Results& results, const std::string& name, int ratio, double time) {
  return results.contains({"max_error", name, pulse_horizon, ratio, time});
}

}  // namespace

void print_errors(const std::string& name, const std::vector<int>& ratios, const Results& results,
                  const ExpectedResults& expected) {
  fmt::print("\n{}: max and L2 difference from the series of the continuum\n{:<12}", name, "time, ms");
  for (const double t : pulse_times()) fmt::print("{:>22.2f}", 1e3 * t);
  fmt::print("\n");
  for (const int m : ratios) {
    if (!has(results, name, m, pulse_times().back())) continue;
    std::string found = fmt::format("m = {:<8}", m), wanted = fmt::format("{:<12}", "  expected");
    bool any = false;
    for (const double t : pulse_times()) {
      for (const char* quantity : {"max_error", "l2_error"}) {
        const Key key = {quantity, name, pulse_horizon, m, t};
        found += fmt::format("{:>11}", text(results, key, "{:.3e}"));
        const std::string value = text(expected, key, "{:.3e}");
        any = any || !value.empty();
        wanted += fmt::format("{:>11}", value);
      }
    }
    fmt::print("{}\n", found);
    if (any) fmt::print("{}\n", wanted);
  }
}

void print_rates(const std::vector<std::string>& names, const std::vector<int>& ratios,
                 const Results& results) {
  fmt::print("\norder of convergence in 1/m at 0.2 ms (largest error, L2)\n");
  for (const std::string& name : names)
    for (const int from : ratios)
      for (const int to : ratios) {
        const Key key = {fmt::format("rate from m={}", from), name, pulse_horizon, to, pulse_times().back()};
        if (!results.contains(key)) continue;
        Key l2 = key;
        l2.quantity = "l2_" + key.quantity;
        fmt::print("{:<26}{:>5} -> {:<5}{:>8}{:>8}\n", name, from, to, text(results, key, "{:.3f}"),
                   text(results, l2, "{:.3f}"));
      }
}

void print_long(const std::vector<std::string>& names, const std::vector<int>& ratios,
                const std::vector<double>& times, const Results& results) {
  fmt::print("\n{:<26}{:>6}{:>10}{:>14}{:>22}{:>12}\n", "long times", "m", "time, ms", "from series",
             "from lattice, odd", "max|u|");
  for (const std::string& name : names)
    for (const int m : ratios)
      for (const double t : times) {
        if (!has(results, name, m, t)) continue;
        fmt::print("{:<26}{:>6}{:>10g}{:>14}{:>22}{:>12}\n", name, m, 1e3 * t,
                   text(results, {"max_error", name, pulse_horizon, m, t}, "{:.2e}"),
                   text(results, {"discrete_error", name, pulse_horizon, m, t}, "{:.2e}"),
                   text(results, {"largest", name, pulse_horizon, m, t}, "{:.4f}"));
      }
}

void print_probes(const std::vector<std::string>& names, const std::vector<int>& ratios,
                  const Results& results, const ExpectedResults& expected) {
  constexpr std::array<const char*, 3> cells = {"u(N/2)", "u(N/4)", "u(0)"};
  fmt::print("\n{:<26}{:>6}{:>10}{:>20}{:>20}{:>20}\n", "displacement of cells, m", "m", "time, ms", "N/2",
             "N/4", "0");
  for (const std::string& name : names)
    for (const int m : ratios)
      for (const double t : {0.1e-3, 0.2e-3}) {
        if (!expected.contains({cells[0], name, pulse_horizon, m, t}) || !has(results, name, m, t)) continue;
        std::string found, wanted;
        for (const char* cell : cells) {
          found += fmt::format("{:>20}", text(results, {cell, name, pulse_horizon, m, t}, "{:.10e}"));
          wanted += fmt::format("{:>20}", text(expected, {cell, name, pulse_horizon, m, t}, "{:.10e}"));
        }
        fmt::print("{:<26}{:>6}{:>10g}{}\n{:<42}{}\n", name, m, 1e3 * t, found, "  expected", wanted);
      }
}

}  // namespace perimode::studies
