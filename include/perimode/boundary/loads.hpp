// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <variant>
#include <vector>

#include "perimode/boundary/time_function.hpp"
#include "perimode/geometry/particles.hpp"

namespace perimode {

/// Traction (Pa, global axes) on the face of a `face` region: acts on its outermost layers (or depth) as the
/// body force traction / (layers * spacing) or traction / depth.
struct Traction {
  Coordinates value;
};
/// Force per volume, N/m3.
struct BodyForce {
  Coordinates value;
};
/// Total force, N, shared by volume.
struct TotalForce {
  Coordinates value;
};

struct Load {
  std::variant<Traction, BodyForce, TotalForce> what;
  std::optional<Region> at = {};  ///< empty: the whole body; a traction needs its face
  TimeFunction time = {};         ///< a static analysis takes loads in full
  Where where = {};
};

/// Forces of all loads on all particle dofs, N (point-major). Throws invalid_input: a region that holds no
/// particle, a traction on a region that is no face or has more layers than the body, a wrong number of
/// components. Cost O(particles * loads).
template <int Dim>
[[nodiscard]] Eigen::VectorXd load_vector(const Particles<Dim>& particles, const std::vector<Load>& loads);

}  // namespace perimode
