// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "perimode/assembly/model.hpp"
#include "perimode/io/table.hpp"
#include "rules.hpp"
#include "studies/common/models.hpp"
#include "studies/common/results.hpp"

namespace perimode::studies {

inline constexpr double bar_step = 1e-8;      // s, that of [bouaraquia2024]
inline constexpr int bar_sampled_every = 10;  // steps

/// What stands at the ends of a bar, "odd/even" being the fixed and the free end of [bouaraquia2024].
struct EndsKind {
  std::string name;  ///< "odd/even", "odd/free", "zero_layer/free", "surface_nodes/free"
  BarEnds ends;
};
[[nodiscard]] const std::vector<EndsKind>& ends_kinds();

/// One bar of the study.
struct BarRun {
  Micromodulus kernel;
  Rule rule = Rule::corrected;
  EndsKind ends = ends_kinds().front();
  int cells = 800;
  int ratio = 5;
  int periods = 3;  ///< of 4 L/c
};

/// "constant corrected odd/even", "gaussian2 normalised odd/even", ...
[[nodiscard]] std::string name_of(const BarRun& run);

/// Lets the bar go from the uniform strain e0 and follows the strain e(t) at x = 1/2. Adds, per number of
/// periods: l2_error = |e - exact|/|exact| in L2 of time, exact being the classical square wave; for the
/// first period far_error = max|e - exact|/e0 farther than 0.1 L/c from jumps; overshoot = max|e|/e0;
/// strain/e0 at given instants; discrete_error, the largest difference e/e0 from the closed form of the
/// lattice (odd/even). All under Key::horizon = the horizon. Rows (curve, time, strain) of one period go to
/// `histories` unless null.
void run_bar(const BarRun& run, Results& results, Table* histories = nullptr);

/// Columns of `histories`, and the exact strain of one period.
void add_exact(Table& histories);

}  // namespace perimode::studies
