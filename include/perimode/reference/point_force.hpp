// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "perimode/core/types.hpp"

namespace perimode {

/// An endless elastic solid and the force on one of its points, force h(t) with h the Ricker wavelet of
/// TimeFunction: (1 - 2 s) exp(-s), s = (pi f (t - 1.5/f))^2.
struct PointForce {
  double density = 0.0;               ///< kg/m3
  double pressure_speed = 0.0;        ///< alpha, m/s
  double shear_speed = 0.0;           ///< beta, m/s
  Point<3> force = Point<3>::Zero();  ///< at the wavelet's peak, N
  double frequency = 0.0;             ///< f, Hz
};

/// Displacement (m) at the place x (m, from the force) and time t (s), Stokes' solution
/// [aki_richards2002] eq. (4.23):
///   4 pi rho u = (3 g g^T - 1) F / r^3 int_{r/alpha}^{r/beta} s h(t - s) ds + g g^T F h(t -
///   r/alpha)/(alpha^2 r)
///                + (1 - g g^T) F h(t - r/beta)/(beta^2 r),   g = x/r.
/// h is the second derivative of a Gaussian, so the integral is closed. h is continued to t < 0, where it is
/// below 3e-9. Throws invalid_input at x = 0.
[[nodiscard]] Point<3> displacement_of_force(const PointForce& source, const Point<3>& x, double t);

}  // namespace perimode
