// SPDX-License-Identifier: BSD-3-Clause
#include "report.hpp"

#include <fmt/format.h>

#include <array>
#include <functional>

#include "plates.hpp"

namespace perimode::studies {
namespace {

constexpr std::array<int, 7> listed = {1, 2, 3, 5, 10, 15, 20};

/// One line of the listed modes; none if all cells are empty.
void print_line(const std::string& head, const std::function<std::string(double)>& cell) {
  std::string line;
  bool empty = true;
  for (const int mode : listed) {
    const std::string text = cell(mode);
    empty = empty && text.empty();
    line += fmt::format("{:>13}", text);
  }
  if (!empty) fmt::print("{:<12}{}\n", head, line);
}

void print_modes_header(const std::string& title) {
  fmt::print("\n{}\n", title);
  print_line("mode", [](double mode) { return fmt::format("{:g}", mode); });
}

}  // namespace

void print_bar(const std::string& name, double horizon, const std::vector<int>& ratios,
               const Results& results, const ExpectedResults& expected) {
  print_modes_header(fmt::format("{}, horizon {}: frequency / separation of variables - 1", name, horizon));
  for (const int m : ratios) {
    print_line(fmt::format("m = {}", m), [&](double mode) {
      return text(results, {"error", name, horizon, m, mode}, "{:.4e}");
    });
    print_line("  expected", [&](double mode) {
      return text(expected, {"error", name, horizon, m, mode}, "{:.4e}");
    });
    if (m != ratios.front())
      print_line("  order", [&](double mode) {
        return text(results, {"order", name, horizon, m, mode}, "{:.2f}");
      });
  }
}

void print_surface_nodes(double horizon, const std::vector<int>& ratios, const Results& results,
                         const ExpectedResults& expected) {
  const std::string name = "surface_nodes";
  print_modes_header(fmt::format("surface nodes / odd walls - 1, horizon {}", horizon));
  for (const int m : ratios) {
    print_line(fmt::format("m = {}", m), [&](double mode) {
      return text(results, {"bias", name, horizon, m, mode}, "{:+.2e}");
    });
    print_line("  expected", [&](double mode) {
      return text(expected, {"bias", name, horizon, m, mode}, "{:+.2e}");
    });
  }
  fmt::print("\nspectrum of the surface nodes, all modes\n{:<12}{:>22}{:>34}\n", "", "max|K - K'| / max|K|",
             "max|Im lambda| / max|lambda|");
  for (const int m : ratios)
    fmt::print("{:<12}{:>22}{:>34}\n", fmt::format("m = {}", m),
               text(results, {"asymmetry", name, horizon, m, 0}, "{:.3f}"),
               text(results, {"imaginary", name, horizon, m, 0}, "{:.1e}"));
}

void print_horizons(const std::string& name, const std::vector<double>& horizons, int ratio,
                    const Results& results) {
  fmt::print("\n{}, m = {}, first and fifth mode\n{:<12}{:>26}{:>26}\n{:<12}{:>13}{:>13}{:>13}{:>13}\n", name,
             ratio, "", "against separation", "against classical", "horizon", 1, 5, 1, 5);
  for (const double horizon : horizons) {
    fmt::print("{:<12}", horizon);
    for (const char* quantity : {"error", "classical_error"})
      for (const double mode : {1.0, 5.0})
        fmt::print("{:>13}", text(results, {quantity, name, horizon, ratio, mode}, "{:.4e}"));
    fmt::print("\n");
  }
}

void print_plates(const std::vector<int>& ratios, const Results& results, const ExpectedResults& expected) {
  fmt::print("\nplates 1 x 0.5, horizon {}, waves (1, 1): S and P\n", plate_horizon);
  fmt::print("{:<21}{:>4}{:>16}{:>15}{:>15}{:>15}{:>12}\n", "", "m", "20 modes, max", "omega", "expected",
             "continuum", "error");
  for (const std::string& name : plate_names()) {
    for (const char* branch : {" S", " P"}) {
      const std::string wave = name + branch;
      for (const int m : ratios) {
        const Key omega = {"omega", wave, plate_horizon, m, 1};
        fmt::print("{:<21}{:>4}{:>16}{:>15}{:>15}{:>15}{:>12}\n", wave, m,
                   text(results, {"discrete_error", name, plate_horizon, m, 0}, "{:.1e}"),
                   text(results, omega, "{:.10f}"), text(expected, omega, "{:.10f}"),
                   text(results, {"continuum", wave, plate_horizon, 0, 1}, "{:.10f}"),
                   text(results, {"error", wave, plate_horizon, m, 1}, "{:+.2e}"));
      }
    }
  }
}

}  // namespace perimode::studies
