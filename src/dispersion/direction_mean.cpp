// SPDX-License-Identifier: BSD-3-Clause
#include "dispersion/direction_mean.hpp"

namespace perimode {
namespace {

double weight_of(DirectionWeight weight, int dimension, double mu) {
  switch (weight) {
    case DirectionWeight::one:
      return 1.0;
    case DirectionWeight::longitudinal:
      return mu * mu;
    case DirectionWeight::transverse:
      return (1.0 - mu * mu) / (dimension - 1);
  }
  return 0.0;
}

/// 1 - cos x without cancellation.
double one_minus_cos(double x) {
  const double s = std::sin(0.5 * x);
  return 2.0 * s * s;
}

}  // namespace

double direction_mean(DirectionWeight weight, int dimension, double z) {
  const auto f = [&](double mu) { return weight_of(weight, dimension, mu) * one_minus_cos(z * mu); };
  if (dimension == 1) return f(1.0);
  if (dimension == 2) {
    // Midpoint rule over the circle, four-fold symmetric. Its error is of the size of J_n(z), n the number
    // of points on the circle, which is below 1e-16 for n > z + 12 cbrt(z) + 24.
    const int quarter = static_cast<int>((std::abs(z) + 12.0 * std::cbrt(std::abs(z)) + 28.0) / 4.0);
    double sum = 0.0;
    for (int i = 0; i < quarter; ++i) sum += f(std::cos(0.5 * std::numbers::pi * (i + 0.5) / quarter));
    return sum / quarter;
  }
  return integrate(0.0, 1.0, 1 + static_cast<int>(std::abs(z) / 4.0), f);
}

}  // namespace perimode
