// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "perimode/core/types.hpp"

namespace perimode {

/// A flat cut through the body. 1D: one point. 2D: the ends of a segment. 3D: the corners, in order,
/// of a plane simple polygon. `joined[k]`: end k (2D) or edge k -> k+1 (3D) continues in another crack
/// and is not a tip.
template <int Dim>
struct Crack {
  std::vector<Point<Dim>> corner;
  std::vector<bool> joined;
};

/// Whether the straight bond from a to b crosses the crack's interior by more than `tolerance`.
/// A point within `tolerance` of the crack's plane counts on its positive side: larger x (1D), the side of
/// the left normal (2D), the side the corners turn counter-clockwise about (3D). Touching a
/// tip does not cut; passing through a joined end does.
template <int Dim>
[[nodiscard]] bool crosses(const Crack<Dim>& crack, const Point<Dim>& a, const Point<Dim>& b,
                           double tolerance);

/// The crack reflected about the plane x[axis] = at, with its positive side mirrored as well.
template <int Dim>
[[nodiscard]] Crack<Dim> reflected(const Crack<Dim>& crack, int axis, double at);

/// Marks ends (2D) and edges (3D) that coincide with those of another crack of the set.
template <int Dim>
void join(std::vector<Crack<Dim>>& cracks, double tolerance);

}  // namespace perimode
