// SPDX-License-Identifier: BSD-3-Clause
#include "report.hpp"

#include <fmt/format.h>

namespace perimode::studies {
namespace {

Key key_of(const char* quantity, const std::string& body, int squared_ratio, double at = 0.0) {
  return {quantity, body, 0.0, squared_ratio, at};
}

}  // namespace

void print_energies(const std::vector<int>& squared_ratios, const std::vector<int>& in_plane,
                    const Results& results, const ExpectedResults& expected) {
  fmt::print("strain energy under pure dilation / exact - 1\n{:<14}{:>16}{:>16}{:>16}\n", "(delta/dx)^2",
             "original", "expected", "normalised");
  const auto rows = [&](const std::vector<int>& ratios, const std::string& suffix) {
    for (const int r : ratios) {
      const Key original = key_of("energy_error", "original" + suffix, r);
      fmt::print("{:<14}{:>16}{:>16}{:>16}\n", fmt::format("{}{}", r, suffix),
                 text(results, original, "{:+.8f}"), text(expected, original, "{:+.8f}"),
                 text(results, key_of("energy_error", "normalised" + suffix, r), "{:+.1e}"));
    }
  };
  rows(squared_ratios, "");
  rows(in_plane, " 2D");
}

void print_speeds(const std::vector<int>& squared_ratios, const Results& results,
                  const ExpectedResults& expected) {
  fmt::print("\nspeed of long waves along [100] / classical\n{:<14}{:<14}{:>14}{:>14}{:>14}\n",
             "(delta/dx)^2", "", "symbol", "expected", "signal");
  for (const char* body : {"normalised", "original"})
    for (const int r : squared_ratios)
      fmt::print("{:<14}{:<14}{:>14}{:>14}{:>14}\n", r, body,
                 text(results, key_of("speed", body, r), "{:.8f}"),
                 text(expected, key_of("speed", body, r), "{:.8f}"),
                 text(results, key_of("signal_speed", body, r), "{:.6f}"));
}

void print_peaks(const std::vector<int>& squared_ratios, const std::vector<int>& cells,
                 const Results& results, const ExpectedResults& expected) {
  fmt::print("\ntop of the pulse when a classical wave has gone 0.7\n{:<14}{:<14}{:>8}{:>14}{:>14}{:>24}\n",
             "(delta/dx)^2", "", "cells", "found", "expected", "u from the closed form");
  for (const char* body : {"normalised", "original"})
    for (const int n : cells)
      for (const int r : squared_ratios) {
        const Key key = key_of("peak", body, r, n);
        if (results.contains(key))
          fmt::print("{:<14}{:<14}{:>8}{:>14}{:>14}{:>24}\n", r, body, n, text(results, key, "{:.8f}"),
                     text(expected, key, "{:.8f}"),
                     text(results, key_of("discrete_error", body, r, n), "{:.1e}"));
      }
}

void print_clouds(int levels, const Results& results) {
  fmt::print(
      "\nthe pulse in tetrahedra, each a particle with its 30 nearest\n{:<8}{:>12}{:>14}{:>12}{:>12}{:>12}\n",
      "level", "particles", "radii 1 :", "top at", "height", "scatter");
  for (int level = 0; level < levels; ++level) {
    const auto cell = [&](const char* quantity, const char* format) {
      return text(results, key_of(quantity, "tetrahedra", 0, level), format);
    };
    fmt::print("{:<8}{:>12}{:>14}{:>12}{:>12}{:>12}\n", level, cell("particles", "{:.0f}"),
               cell("radius_ratio", "{:.1f}"), cell("peak", "{:.4f}"), cell("height", "{:.4f}"),
               cell("scatter", "{:.4f}"));
  }
}

}  // namespace perimode::studies
