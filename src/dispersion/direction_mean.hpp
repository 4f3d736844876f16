// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <numbers>

#include "core/quadrature.hpp"
#include "perimode/material/material.hpp"

namespace perimode {

/// What is averaged over all directions n of a space of `dimension` dimensions, mu = n.e.
enum class DirectionWeight {
  one,           ///< 1
  longitudinal,  ///< mu^2
  transverse,    ///< (1 - mu^2)/(dimension - 1)
};

/// <w(mu) (1 - cos(z mu))> over the unit circle or sphere, e.g. in 2D 1 - J0(z), 1/2 - J0(z) + J1(z)/z and
/// 1/2 - J1(z)/z. All terms are positive: no cancellation at small z.
double direction_mean(DirectionWeight weight, int dimension, double z);

/// Panels that resolve the kernel itself within the horizon: one, one per unit of p for the Gaussian, one per
/// three radians of a series' last cosine.
inline int panels_of(const Micromodulus& m, double horizon) {
  if (m.kernel == Kernel::gaussian) return 1 + static_cast<int>(m.p);
  if (m.kernel == Kernel::fourier && m.spacing > 0.0)
    return 1 +
           static_cast<int>(static_cast<double>(m.a.size()) * std::abs(m.w) * horizon / (3.0 * m.spacing));
  return 1;
}

/// int_0^horizon f(r) <w (1 - cos(k r mu))> dV, dV = |S| r^(dimension-1) dr with |S| = 2, 2 pi, 4 pi.
/// `sharpness` is the number of panels that f needs by itself.
template <class Function>
double radial_integral(DirectionWeight weight, int dimension, double horizon, double k, int sharpness,
                       Function f) {
  using std::numbers::pi;
  const double sphere = dimension == 1 ? 2.0 : (dimension == 2 ? 2.0 * pi : 4.0 * pi);
  const int panels = sharpness + static_cast<int>(std::abs(k) * horizon / 3.0);
  return sphere * integrate(0.0, horizon, panels, [&](double r) {
           const double shell = dimension == 1 ? 1.0 : (dimension == 2 ? r : r * r);
           return f(r) * shell * direction_mean(weight, dimension, k * r);
         });
}

}  // namespace perimode
