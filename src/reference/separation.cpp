// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/reference/separation.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

#include "dispersion/direction_mean.hpp"
#include "perimode/material/micromodulus.hpp"

namespace perimode {
namespace {

using std::numbers::pi;

/// a in C(r) = a g(r)/r, from (1/2) int C (xi.e)^2 dV = 1: long waves run at speed 1. It is the constant of
/// the unit medium (E = section = 1) up to a factor, both being set by the same moment of g.
double scalar_constant(const Micromodulus& kernel, double horizon, int dimension) {
  const double share = dimension == 1 ? 1.0 : (dimension == 2 ? 2.0 / 3.0 : 0.5);
  return share * micromodulus_constant(kernel, 1.0, horizon, {dimension, Plane::stress, 1.0});
}

}  // namespace

std::vector<AxisWave> axis_waves(Ends ends, double length, int cells) {
  std::vector<AxisWave> waves;
  switch (ends) {
    case Ends::mirror:
    case Ends::antimirror: {
      const bool mirror = ends == Ends::mirror;
      for (int p = 0; p <= cells; ++p) {
        const bool sine = p > 0, cosine = p < cells;
        waves.push_back({pi * p / length, 1, mirror ? sine : cosine, mirror ? cosine : sine});
      }
      break;
    }
    case Ends::mixed:
      for (int p = 1; p <= cells; ++p) waves.push_back({pi * (p - 0.5) / length, 1, true, true});
      break;
    case Ends::periodic:
      for (int p = 0; 2 * p <= cells; ++p) {
        const bool alone = p == 0 || 2 * p == cells;  // k and -k are the same wave
        waves.push_back({2.0 * pi * p / length, alone ? 1 : 2, true, true});
      }
      break;
  }
  return waves;
}

template <int Dim>
double lattice_lambda(const Micromodulus& kernel, const Family<Dim>& family, const Point<Dim>& k) {
  const double a = scalar_constant(kernel, family.horizon, Dim);
  const double volume = std::pow(family.spacing, Dim);
  const std::vector<double> shape = kernel_shapes(kernel, family);
  double lambda = 0.0;
  for (std::size_t j = 0; j < family.length.size(); ++j) {
    double phase = 0.0;
    for (int axis = 0; axis < Dim; ++axis) {
      phase += k[axis] * family.spacing * family.offset[j][static_cast<std::size_t>(axis)];
    }
    const double r = family.length[j], s = std::sin(0.5 * phase);
    lambda += a * shape[j] / r * family.weight[j] * volume * 2.0 * s * s;
  }
  return lambda;
}

template double lattice_lambda<1>(const Micromodulus&, const Family<1>&, const Point<1>&);
template double lattice_lambda<2>(const Micromodulus&, const Family<2>&, const Point<2>&);
template double lattice_lambda<3>(const Micromodulus&, const Family<3>&, const Point<3>&);

double continuum_lambda(const Micromodulus& kernel, double horizon, int dimension, double k) {
  const double a = scalar_constant(kernel, horizon, dimension);
  return radial_integral(DirectionWeight::one, dimension, horizon, k, panels_of(kernel, horizon),
                         [&](double r) { return a * kernel_shape(kernel, r, horizon) / r; });
}

double scabbia_lambda(double horizon, double k) {
  const double z = std::abs(k) * horizon;
  const double sine_integral =
      integrate(0.0, z, 1 + static_cast<int>(z / 4.0), [](double t) { return std::sin(t) / t; });
  const double s = std::sin(0.5 * z);
  return 2.0 / (horizon * horizon) * (z * sine_integral - 2.0 * s * s);
}

}  // namespace perimode
