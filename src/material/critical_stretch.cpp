// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/material/critical_stretch.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/quadrature.hpp"

namespace perimode {

namespace {

/// int_0^1 g(s delta) s^n ds.
double shape_moment(const Micromodulus& micromodulus, double horizon, int n) {
  constexpr int panels = 64;  // of 16 points: a Gaussian of p = 10 and cosines of 200 rad to round-off
  return integrate(0.0, 1.0, panels, [&](double s) {
    return kernel_shape(micromodulus, s * horizon, horizon) * std::pow(s, n);
  });
}

}  // namespace

double fracture_energy(const Micromodulus& micromodulus, double youngs_modulus, double critical_stretch,
                       double horizon, const Continuum& continuum) {
  const double c0 = micromodulus_constant(micromodulus, youngs_modulus, horizon, continuum);
  const int n = continuum.dimension;
  const double directions = n == 1 ? 2.0 : (n == 2 ? 4.0 : 6.283185307179586);  // S <|cos|>
  return 0.25 * critical_stretch * critical_stretch * continuum.section * c0 * directions *
         shape_moment(micromodulus, horizon, n + 1) * std::pow(horizon, n + 2);
}

double critical_stretch(const Micromodulus& micromodulus, double youngs_modulus, double fracture_energy,
                        double horizon, const Continuum& continuum) {
  if (!(fracture_energy > 0.0) || !std::isfinite(fracture_energy)) {
    invalid_input(
        {"fracture_energy > 0", fmt::format("{}", fracture_energy), "give it in J/m2, or leave it out"});
  }
  return std::sqrt(fracture_energy /
                   perimode::fracture_energy(micromodulus, youngs_modulus, 1.0, horizon, continuum));
}

}  // namespace perimode
