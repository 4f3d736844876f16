// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "perimode/bonds/bonds.hpp"
#include "perimode/boundary/conditions.hpp"

namespace perimode {

/// What a ghost does, of a body on a grid (docs/theory/03_boundaries.md):
///   u_ghost[a] = sign[a] u[particle][a]                                   without surface nodes,
///   u_ghost[a] = sign[a] ((1 + ratio) u_s[a] - ratio u[particle][a])      with them.
template <int Dim>
struct GhostRule {
  static constexpr int none = -1;

  Index particle = 0;
  std::array<double, Dim> sign = {};  ///< of the walls that reflect
  int wall = none;                    ///< number of the condition that gives u_s; none: no surface nodes
  double ratio = 0.0;                 ///< |x_f - x_s| / |x_p - x_s|
  Point<Dim> surface = Point<Dim>::Zero();  ///< x_s
};

/// Number of the wall at each face, 2 axis + (upper ? 1 : 0), among the conditions, or GhostRule::none.
template <int Dim>
[[nodiscard]] std::array<int, 2 * Dim> wall_numbers(const std::vector<BoundaryCondition>& conditions);

/// The rule of a ghost. Reflecting walls and periodic axes come first; a place that is then left beyond
/// faces of surface nodes is extrapolated through the nearest point of the surface, at an edge or a corner by
/// the last of its walls. Throws invalid_input where no particle lies on the line through it. Cost O(reach).
template <int Dim>
[[nodiscard]] GhostRule<Dim> ghost_rule(const Ghost<Dim>& ghost, const Grid<Dim>& grid,
                                        const GridBonds<Dim>& bonds,
                                        const std::vector<BoundaryCondition>& conditions,
                                        const std::array<int, 2 * Dim>& walls);

}  // namespace perimode
