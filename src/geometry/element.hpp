// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "perimode/core/types.hpp"
#include "perimode/geometry/cloud.hpp"

namespace perimode {

/// Elements that become particles.
enum class Shape { triangle, quadrilateral, tetrahedron, hexahedron };

[[nodiscard]] int nodes_of(Shape shape);
[[nodiscard]] int dimension_of(Shape shape);

/// Volume (2D: area) and centroid of an element of straight edges, exact. `volume` is 0 where the element is
/// inverted, folded or flat: where its Jacobian at a corner is below 1e-12 of its longest diagonal's power.
struct ElementSize {
  double volume = 0.0;
  Point<3> centroid = Point<3>::Zero();
};
[[nodiscard]] ElementSize element_size(Shape shape, const std::vector<Point<3>>& corner);

/// Whether corners lie in one plane of constant z, to 1e-9 of the element's size.
[[nodiscard]] bool is_plane(const std::vector<Point<3>>& corner);

/// Position in a list of points of the first pair that is the same, or {-1, -1}. Cost O(n log n).
[[nodiscard]] std::array<std::ptrdiff_t, 2> twin_points(const CloudData& cloud);

}  // namespace perimode
