// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/material/critical_stretch.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

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

template <int Dim>
double lattice_fracture_energy(const Micromodulus& micromodulus, double youngs_modulus,
                               double critical_stretch, const Family<Dim>& family,
                               const Continuum& continuum) {
  const double c0 = micromodulus_constant(micromodulus, youngs_modulus, family.horizon, continuum);
  const std::vector<double> shape = kernel_shapes(micromodulus, family);
  double sum = 0.0;
  for (int k = 0; k < family.size(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    const double along = family.spacing * family.offset[at][0];
    if (along > 0.0) sum += shape[at] * family.weight[at] * family.length[at] * along;
  }
  const double volume = continuum.section * std::pow(family.spacing, Dim);
  return 0.5 * critical_stretch * critical_stretch * c0 * sum * volume;
}

double stretch_of(double fracture_energy, double energy_at_unit_stretch) {
  if (!(fracture_energy > 0.0) || !std::isfinite(fracture_energy)) {
    invalid_input(
        {"fracture_energy > 0", fmt::format("{}", fracture_energy), "give it in J/m2, or leave it out"});
  }
  if (!(energy_at_unit_stretch > 0.0)) {
    invalid_input({"a micromodulus whose bonds store energy where a crack crosses them",
                   fmt::format("{:.4g} J/m2 at unit stretch", energy_at_unit_stretch),
                   "use one with smaller negative parts, or give critical_stretch"});
  }
  return std::sqrt(fracture_energy / energy_at_unit_stretch);
}

double critical_stretch(const Micromodulus& micromodulus, double youngs_modulus, double fracture_energy,
                        double horizon, const Continuum& continuum) {
  return stretch_of(fracture_energy,
                    perimode::fracture_energy(micromodulus, youngs_modulus, 1.0, horizon, continuum));
}

template double lattice_fracture_energy<1>(const Micromodulus&, double, double, const Family<1>&,
                                           const Continuum&);
template double lattice_fracture_energy<2>(const Micromodulus&, double, double, const Family<2>&,
                                           const Continuum&);
template double lattice_fracture_energy<3>(const Micromodulus&, double, double, const Family<3>&,
                                           const Continuum&);

}  // namespace perimode
