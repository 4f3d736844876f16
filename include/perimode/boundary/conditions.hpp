// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <variant>
#include <vector>

#include "perimode/geometry/region.hpp"

namespace perimode {

/// u = 0 for the listed components (0 x, 1 y, 2 z) of the particles in `at`.
struct Fix {
  std::vector<int> components;
  Region at;
};

/// u = value for the listed components; in a modal analysis the motion is about that state, so
/// it acts as a Fix.
struct Prescribe {
  std::vector<std::pair<int, double>> components;  ///< (component, value in m)
  Region at;
};

/// What fictitious particles beyond a face do; reflection is about the face of the grid's box.
/// odd / even: all components change / keep sign. mirror: normal odd, tangential even.
/// antimirror: normal even, tangential odd. zero_layer: u = 0. surface_nodes: linear
/// extrapolation through the surface point (1D) [scabbia2023].
enum class WallType { odd, even, mirror, antimirror, zero_layer, surface_nodes };

struct Wall {
  Face face;
  WallType type = WallType::mirror;
  Coordinates displacement = {};  ///< surface_nodes: u_s, m (empty: zero)
};

struct BoundaryCondition {
  std::variant<Fix, Prescribe, Wall> what;
  Where where = {};
};

}  // namespace perimode
