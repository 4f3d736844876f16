// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <utility>

#include "perimode/assembly/model.hpp"

namespace perimode::studies {

/// What stands at the two ends of a bar: a wall each, or nothing (a free end).
using BarEnds = std::pair<std::optional<WallType>, std::optional<WallType>>;

/// The bar of [scabbia2023]: length 1 m, inverse-distance kernel, wave speed 5000 m/s, bonds at the horizon
/// counted half; `ratio` cells per horizon, so ratio/horizon cells in all.
/// @pre ratio/horizon is a whole number.
[[nodiscard]] Model separable_bar(double horizon, int ratio, const BarEnds& ends, bool self_cell = false);

/// Plate 1 m x 0.5 m in plane stress with E = rho = 1 and the same wall (mirror or antimirror) on its four
/// edges, linear volume correction; `cells` along x, an even number.
[[nodiscard]] Model separable_plate(int cells, double ratio, Micromodulus kernel, WallType wall);

}  // namespace perimode::studies
