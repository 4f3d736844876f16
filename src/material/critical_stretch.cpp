// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/material/critical_stretch.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace perimode {

namespace {

/// int_0^1 g(s delta) s^n ds by Gauss-Legendre rules of five points on equal panels.
double shape_moment(const Micromodulus& micromodulus, int n) {
  constexpr std::array<double, 5> node = {-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831,
                                          0.9061798459386640};
  constexpr std::array<double, 5> weight = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                            0.4786286704993665, 0.2369268850561891};
  constexpr int panels = 256;
  double sum = 0.0;
  for (int panel = 0; panel < panels; ++panel) {
    for (std::size_t k = 0; k < node.size(); ++k) {
      const double s = (panel + 0.5 * (1.0 + node[k])) / panels;
      sum += weight[k] * kernel_shape(micromodulus, s, 1.0) * std::pow(s, n);
    }
  }
  return 0.5 * sum / panels;
}

}  // namespace

double fracture_energy(const Micromodulus& micromodulus, double youngs_modulus, double critical_stretch,
                       double horizon, const Continuum& continuum) {
  const double c0 = micromodulus_constant(micromodulus, youngs_modulus, horizon, continuum);
  const int n = continuum.dimension;
  const double directions = n == 1 ? 2.0 : (n == 2 ? 4.0 : 6.283185307179586);  // S <|cos|>
  return 0.25 * critical_stretch * critical_stretch * continuum.section * c0 * directions *
         shape_moment(micromodulus, n + 1) * std::pow(horizon, n + 2);
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
