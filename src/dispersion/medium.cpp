// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/dispersion/medium.hpp"

#include <cmath>
#include <limits>

#include "dispersion/direction_mean.hpp"

namespace perimode {
namespace {

void require_shear_exists(const Medium& medium, Branch branch) {
  if (branch == Branch::shear && medium.continuum.dimension == 1) {
    invalid_input({"a pressure wave in one dimension", "a shear wave", "a bar has one branch only"});
  }
}

}  // namespace

double micromodulus_constant(const Medium& medium) {
  return micromodulus_constant(medium.material.micromodulus, medium.material.youngs_modulus, medium.horizon,
                               medium.continuum);
}

double classical_speed(const Medium& medium, Branch branch) {
  require_shear_exists(medium, branch);
  const double bar = std::sqrt(medium.material.youngs_modulus / medium.material.density);
  if (medium.continuum.dimension == 1) return bar;
  const bool pressure = branch == Branch::pressure;
  const bool plane_stress = medium.continuum.dimension == 2 && medium.continuum.plane == Plane::stress;
  if (plane_stress) return bar * std::sqrt(pressure ? 9.0 / 8.0 : 3.0 / 8.0);
  return bar * std::sqrt(pressure ? 6.0 / 5.0 : 2.0 / 5.0);
}

double continuum_frequency(const Medium& medium, Branch branch, double k) {
  require_shear_exists(medium, branch);
  const Micromodulus& kernel = medium.material.micromodulus;
  if (kernel.kernel == Kernel::shells) return std::numeric_limits<double>::quiet_NaN();
  const double scale = micromodulus_constant(medium) * medium.continuum.section / medium.material.density;
  const auto weight =
      branch == Branch::pressure ? DirectionWeight::longitudinal : DirectionWeight::transverse;
  const double squared = radial_integral(
      weight, medium.continuum.dimension, medium.horizon, k, panels_of(kernel, medium.horizon),
      [&](double r) { return scale * kernel_shape(kernel, r, medium.horizon) / r; });
  return std::sqrt(squared);
}

}  // namespace perimode
