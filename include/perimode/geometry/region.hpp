// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "perimode/core/error.hpp"

namespace perimode {

/// A point or vector whose dimension is known at run time only (as read from a case file), m.
using Coordinates = std::vector<double>;

/// One face of the body's bounding box, written "x-", "x+", "y-", ...
struct Face {
  int axis = 0;        ///< 0 x, 1 y, 2 z
  bool upper = false;  ///< true: "+"
};

/// The outermost `layers` layers of a grid, or the particles within `depth` (m) of the extreme
/// particle position of a cloud. Exactly one of the two is positive.
struct FaceRegion {
  Face face;
  int layers = 0;
  double depth = 0.0;
};
struct BoxRegion {
  Coordinates lower, upper;
};
struct BallRegion {
  Coordinates centre;
  double radius = 0.0;
};
struct BlockRegion {
  std::string name;
};
/// The one particle nearest to a point; ties go to the higher coordinate (x first, then y, z).
struct NearestRegion {
  Coordinates point;
};

/// A set of particles: a particle belongs if its centre does (boundaries included). The one
/// syntax for `at`, `remove`, `blocks` and `no_fail`.
struct Region {
  std::variant<FaceRegion, BoxRegion, BallRegion, BlockRegion, NearestRegion> shape;
  Where where = {};
};

}  // namespace perimode
