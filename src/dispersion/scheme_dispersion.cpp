// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "perimode/dispersion/zone.hpp"

namespace perimode {

double central_difference_frequency(double omega, double dt) {
  return 2.0 / dt * std::asin(0.5 * omega * dt);
}

double newmark_frequency(double omega, double dt) { return 2.0 / dt * std::atan(0.5 * omega * dt); }

double finite_difference_frequency(double k, double speed, double dx, double courant) {
  const double s = std::sin(0.5 * k * dx);
  if (courant == 0.0) return 2.0 * speed / dx * s;
  return 2.0 * speed / (courant * dx) * std::asin(courant * s);
}

}  // namespace perimode
