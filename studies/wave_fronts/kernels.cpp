// SPDX-License-Identifier: BSD-3-Clause
#include "kernels.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "perimode/dispersion/waves.hpp"

namespace perimode::studies {
namespace {

constexpr double band_error = 0.05;

/// Largest error of long-wave speeds over directions of the irreducible part of the sphere.
double long_wave_error(const Lattice<3>& lattice) {
  const std::array<double, 2> c = {classical_speed(lattice.medium, Branch::pressure),
                                   classical_speed(lattice.medium, Branch::shear)};
  constexpr int steps = 12;
  double worst = 0.0;
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; j <= i; ++j) {
      const Point<3> direction = Point<3>(1.0, double(i) / steps, double(j) / steps).normalized();
      const PlaneWaves<3> waves = plane_waves<3>(lattice, Point<3>::Zero(), direction);
      for (std::size_t b = 0; b < 3; ++b)
        worst = std::max(worst, std::abs(waves.phase_velocity[b] / c[b == 0 ? 0 : 1] - 1.0));
    }
  }
  return worst;
}

std::array<double, 2> bands(const Lattice<3>& lattice) {
  std::array<double, 2> least = {10.0, 10.0};
  for (const Point<3>& towards : {Point<3>(1, 0, 0), Point<3>(1, 1, 0), Point<3>(1, 1, 1)}) {
    const double longest = std::numbers::pi * towards.norm();
    for (const Branch branch : {Branch::pressure, Branch::shear}) {
      const BranchBand band = branch_band<3>(lattice, branch, towards.normalized(), longest, band_error);
      double& least_of = least[branch == Branch::pressure ? 0 : 1];
      least_of = std::min(least_of, band.band_k);
    }
  }
  return least;
}

KernelWaves examine(std::string name, int ratio, const Micromodulus& kernel) {
  KernelWaves waves;
  waves.name = std::move(name);
  waves.ratio = ratio;
  waves.kernel = kernel;
  waves.lattice = make_lattice<3>(solid(ratio, 7, kernel));
  waves.zone = survey_zone<3>(waves.lattice, 33);
  waves.error = contour_error<3>(waves.lattice);
  waves.long_wave_error = long_wave_error(waves.lattice);
  waves.band = bands(waves.lattice);
  return waves;
}

}  // namespace

Model solid(int ratio, int cells, const Micromodulus& kernel) {
  Model model;
  model.dimension = 3;
  const double half = 0.5 * cells;
  model.particles = GridSpec{.lower = {-half, -half, -half}, .upper = {half, half, half}, .spacing = 1.0};
  model.horizon = {HorizonSpec::Rule::ratio, static_cast<double>(ratio), {}};
  model.periodic = {true, true, true};
  model.material.youngs_modulus = 1.0;
  model.material.density = 1.0;
  model.material.micromodulus = kernel;
  return model;
}

Kernels kernels_of(int ratio) {
  Kernels kernels;
  kernels.original = examine("original", ratio, {});
  const Lattice<3>& lattice = kernels.original.lattice;
  const auto optimised = [&](const char* name, ErrorDomain domain, OptimisedMicromodulus& optimum) {
    OptimiseOptions options;
    options.domain = domain;
    optimum = optimise_micromodulus<3>(lattice, options);
    Micromodulus kernel;
    kernel.kernel = Kernel::shells;
    kernel.shells.reserve(optimum.alpha.size());
    for (std::size_t s = 0; s < optimum.alpha.size(); ++s)
      kernel.shells.push_back({lattice.family.shell[s], optimum.alpha[s]});
    return examine(name, ratio, kernel);
  };
  kernels.contour = optimised("contour", ErrorDomain::contour, kernels.on_contour);
  kernels.zone = optimised("zone", ErrorDomain::zone, kernels.on_zone);
  return kernels;
}

}  // namespace perimode::studies
