// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "perimode/assembly/fields.hpp"
#include "verification/held_body.hpp"

namespace perimode::test {

/// Kirsch's solution: an infinite sheet of E = 1 in plane stress (nu = 1/3) with a hole of radius `a` at the
/// origin, pulled along x by the far stress S = 1. [kirsch1898], docs/theory/09_static.md eq. (6).
struct Kirsch {
  double a = 0.25;

  static constexpr double nu = 1.0 / 3.0;
  static constexpr double shear = 1.0 / (2.0 * (1.0 + nu));
  static constexpr double kappa = (3.0 - nu) / (1.0 + nu);

  [[nodiscard]] Point<2> displacement(const Point<2>& x) const {
    const double r = x.norm();
    const double c = x[0] / r;
    const double s = x[1] / r;
    const double cos2 = c * c - s * s;
    const double sin2 = 2.0 * s * c;
    const double a2 = a * a;
    const double ur =
        ((kappa - 1.0) * r * r + 2.0 * a2 + 2.0 * (a2 * (kappa + 1.0) + r * r - a2 * a2 / (r * r)) * cos2) /
        (8.0 * shear * r);
    const double ut = -(a2 * (kappa - 1.0) + r * r + a2 * a2 / (r * r)) * sin2 / (4.0 * shear * r);
    return {ur * c - ut * s, ur * s + ut * c};
  }

  /// sigma_xx on the y axis, the hoop stress there: 3 at the hole.
  [[nodiscard]] double hoop_on_y(double y) const {
    const double q = a * a / (y * y);
    return 0.5 * (2.0 + q + 3.0 * q * q);
  }
};

struct KirschErrors {
  double displacement = 0.0;   ///< relative L2 over the free particles
  double at_horizon = 0.0;     ///< of the hoop stress, one horizon from the hole on the y axis, relative
  double concentration = 0.0;  ///< hoop stress in the first particle above the hole, carried on to its edge
};

/// Box [-1, 1]^2 of `cells` cells a side with the hole cut out and Kirsch's displacements given in the outer
/// 8 layers. Horizon 4 spacings, calibration discrete. Stress is Hooke's, from the strain field.
inline KirschErrors kirsch_errors(int cells) {
  const Kirsch exact;
  const double spacing = 2.0 / cells;
  Model m = box_model({cells, cells}, spacing, 4.0);
  auto& grid = std::get<GridSpec>(m.particles);
  grid.lower = {-1.0, -1.0};
  grid.upper = {1.0, 1.0};
  grid.remove = {{BallRegion{{0.0, 0.0}, exact.a}, {}}};
  m.calibration = Calibration::discrete;
  m.volume_correction = VolumeCorrection::linear;
  auto body = build_body<2>(m);
  hold_outer_layers(body, 8, [&](const Point<2>& x) { return exact.displacement(x); });
  const StaticResult r = solve_held(body);

  double difference = 0.0;
  double size = 0.0;
  for (Index i = 0; i < body.count(); ++i) {
    if (body.boundary.free_number[2 * static_cast<std::size_t>(i)] < 0) continue;
    const Point<2> expected = exact.displacement(body.particles.position[i]);
    difference += (r.displacement.segment<2>(2 * i) - expected).squaredNorm();
    size += expected.squaredNorm();
  }
  const Eigen::MatrixXd e = strain(body, r.displacement);
  const auto hoop = [&](Index i) {
    return (e(0, i) + Kirsch::nu * e(1, i)) / (1.0 - Kirsch::nu * Kirsch::nu);
  };
  KirschErrors errors;
  errors.displacement = std::sqrt(difference / size);
  bool first = true;
  for (Index i = 0; i < body.count(); ++i) {  // upwards along the column beside the y axis
    const Point<2>& x = body.particles.position[i];
    if (x[0] < 0.0 || x[0] > spacing || x[1] < 0.0) continue;
    if (first) errors.concentration = hoop(i) + 3.0 - exact.hoop_on_y(x[1]);
    first = false;
    errors.at_horizon = hoop(i) / exact.hoop_on_y(x[1]) - 1.0;
    if (x[1] > exact.a + 4.0 * spacing) break;
  }
  return errors;
}

}  // namespace perimode::test
