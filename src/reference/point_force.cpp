// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/reference/point_force.hpp"

#include <cmath>
#include <numbers>

#include "perimode/core/error.hpp"

namespace perimode {
namespace {

/// The wavelet as a second derivative: h = G'', x = t - 1.5/f.
struct Wavelet {
  double a = 0.0;      ///< pi f
  double delay = 0.0;  ///< 1.5/f

  [[nodiscard]] double gauss(double x) const { return std::exp(-a * a * x * x); }
  [[nodiscard]] double value(double t) const {
    const double x = t - delay;
    return (1.0 - 2.0 * a * a * x * x) * gauss(x);
  }
  /// An antiderivative of s h(t - s) over s: -s G'(t - s) - G(t - s).
  [[nodiscard]] double moment(double t, double s) const {
    const double x = t - s - delay;
    return (-s * x + 0.5 / (a * a)) * gauss(x);
  }
};

}  // namespace

Point<3> displacement_of_force(const PointForce& source, const Point<3>& x, double t) {
  const double r = x.norm();
  if (!(r > 0.0))
    invalid_input({"a place away from the point force", "the force's own", "choose x != 0", {}});
  const Point<3> g = x / r;
  const Point<3> along = g * g.dot(source.force), across = source.force - along;
  const Wavelet h{std::numbers::pi * source.frequency, 1.5 / source.frequency};
  const double alpha = source.pressure_speed, beta = source.shear_speed;
  const double near = (h.moment(t, r / beta) - h.moment(t, r / alpha)) / (r * r * r);
  const Point<3> u = near * (3.0 * along - source.force) +
                     along * (h.value(t - r / alpha) / (alpha * alpha * r)) +
                     across * (h.value(t - r / beta) / (beta * beta * r));
  return u / (4.0 * std::numbers::pi * source.density);
}

}  // namespace perimode
