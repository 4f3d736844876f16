// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "perimode/core/expression.hpp"

namespace perimode {

/// How a load or a prescribed displacement varies in time, as a factor h(t) of its value:
///   constant    1
///   ramp        min(t / a, 1)
///   step        1 from t = a on, 0 before
///   half_sine   sin(pi t / a) for 0 <= t <= a, 0 later
///   ricker      (1 - 2 s) exp(-s), s = (pi a (t - 1.5/a))^2: a in Hz, the peak at 1.5/a
///   gaussian    exp(-((t - a) / b)^2)
///   table       straight lines through the points, constant beyond the first and the last
///   expression  a formula of t
struct TimeFunction {
  enum class Kind { constant, ramp, step, half_sine, ricker, gaussian, table, expression };
  Kind kind = Kind::constant;
  double a = 0.0;                          ///< s; ricker: Hz
  double b = 0.0;                          ///< s
  std::vector<double> time = {};           ///< table: ascending, s
  std::vector<double> value = {};          ///< table
  std::optional<Expression> formula = {};  ///< expression
};

/// h(t). A step counts as reached within 1e-9 of its time (relative), so that a step of the integrator that
/// ends there meets it. Throws invalid_input where a formula has no finite value.
[[nodiscard]] double value_at(const TimeFunction& function, double t);

/// Whether two functions are the same: kind, numbers, formula text.
[[nodiscard]] bool same(const TimeFunction& a, const TimeFunction& b);

}  // namespace perimode
