// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace perimode::studies {

/// How far a classical pressure wave goes before the pulse is looked at, m.
inline constexpr double pulse_travel = 0.7;

/// What a bar is let go from: exp(-(x/width)^2), whose motion is even about its end.
[[nodiscard]] inline double end_pulse(double x, double width) { return std::exp(-(x / width) * (x / width)); }

}  // namespace perimode::studies
