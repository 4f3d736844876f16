// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/assembly/precracks.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "perimode/geometry/grid.hpp"

namespace perimode {

template <int Dim>
std::vector<Crack<Dim>> precracks(const Model& model) {
  std::vector<Crack<Dim>> cracks;
  for (const auto& spec : model.precracks) {
    Crack<Dim> crack;
    for (const auto& corner : spec.points)
      crack.corner.push_back(to_point<Dim>(corner, "a pre-crack corner", spec.where));
    const std::size_t least = Dim;  // a point, a segment, a polygon
    if (crack.corner.size() < least || (Dim < 3 && crack.corner.size() > least)) {
      invalid_input({fmt::format("{} corner{} of a pre-crack", Dim == 3 ? "at least 3" : std::to_string(Dim),
                                 Dim == 1 ? "" : "s"),
                     fmt::format("{}", crack.corner.size()), "see the case reference", spec.where});
    }
    if constexpr (Dim > 1) {
      for (std::size_t k = 0; k < crack.corner.size(); ++k) {
        if (crack.corner[k] == crack.corner[(k + 1) % crack.corner.size()]) {
          invalid_input(
              {"a pre-crack of positive length", "two equal corners", "move one of them", spec.where});
        }
      }
    }
    if constexpr (Dim == 3) {
      const Point<3> normal =
          (crack.corner[1] - crack.corner[0]).cross(crack.corner[2] - crack.corner[0]).normalized();
      for (const auto& c : crack.corner) {
        if (!(std::abs(normal.dot(c - crack.corner[0])) <=
              1e-9 * (crack.corner[1] - crack.corner[0]).norm())) {
          invalid_input({"a plane polygon, its first three corners not on a line", "corners out of plane",
                         "split it into plane pieces", spec.where});
        }
      }
    }
    cracks.push_back(crack);
  }
  return cracks;
}

template std::vector<Crack<1>> precracks<1>(const Model&);
template std::vector<Crack<2>> precracks<2>(const Model&);
template std::vector<Crack<3>> precracks<3>(const Model&);

}  // namespace perimode
