// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "perimode/io/table.hpp"
#include "studies/common/results.hpp"

namespace perimode::studies {

inline constexpr double pulse_horizon = 0.1;  // m
inline constexpr double pulse_step = 2e-7;    // s, that of [scabbia2023]

/// The instants of [scabbia2023] fig. 5, s.
[[nodiscard]] const std::vector<double>& pulse_times();

/// One bar: ends "surface_nodes", "odd", "zero_layer" or "free", each also with " self_cell" and any words
/// after; `ratio` cells per horizon, time step `dt`.
struct BarRun {
  std::string name;
  int ratio = 10;
  double dt = pulse_step;
  std::vector<double> times = pulse_times();
};

/// Lets the bar go from the pulse and adds, per instant: max_error and l2_error = sqrt(sum e^2 dx) against
/// the series of the peridynamic continuum; discrete_error, the largest difference from the closed form of
/// odd walls on the same lattice at the same step (where that is cheap: up to 2000 cells); largest = max|u|;
/// u(N/2), u(N/4), u(0), the displacements of these cells. Rows (curve, time, x, u) of the displacements go
/// to `profiles` unless it is null.
void run_bar(const BarRun& run, Results& results, Table* profiles = nullptr);

/// The series at x = 1/2 and its curves, with those of classical elasticity, for `profiles`.
void add_series(Results& results, Table& profiles);

/// Adds, at 0.2 ms, "rate from m=A" under B: log(error ratio)/log(B/A) of the largest errors, and "l2 rate
/// ...".
void add_rate(const std::string& name, int from, int to, Results& results);

}  // namespace perimode::studies
