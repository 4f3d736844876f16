// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "perimode/boundary/time_function.hpp"
#include "perimode/geometry/region.hpp"

namespace perimode {

/// u = 0 for the listed components (0 x, 1 y, 2 z) of the particles in `at`.
struct Fix {
  std::vector<int> components;
  Region at;
};

/// u = value h(t) for the listed components. A modal analysis is about that state, so it acts as a Fix; a
/// static one takes the value in full.
struct Prescribe {
  std::vector<std::pair<int, double>> components;  ///< (component, value in m)
  Region at;
  TimeFunction time = {};
};

/// What fictitious particles beyond a face do; reflection is about the face of the grid's box.
/// odd / even: all components change / keep sign. mirror: normal odd, tangential even.
/// antimirror: normal even, tangential odd. zero_layer: u = 0. surface_nodes: linear
/// extrapolation through the surface point [scabbia2023].
enum class WallType { odd, even, mirror, antimirror, zero_layer, surface_nodes };

struct Wall {
  Face face;
  WallType type = WallType::mirror;
  /// surface_nodes: u_s(x, y, z) at the surface point, m, one formula per component (empty: zero).
  std::vector<Expression> displacement = {};
  /// surface_nodes in 1D: instead of u_s, the force flux through the surface, Pa (positive: tension).
  std::optional<double> traction = {};
  TimeFunction time = {};  ///< of displacement or traction
};

struct BoundaryCondition {
  std::variant<Fix, Prescribe, Wall> what;
  Where where = {};
};

}  // namespace perimode
