// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "perimode/dispersion/lattice.hpp"

namespace perimode::test {

/// A lattice with E = rho = section = 1.
template <int Dim>
Lattice<Dim> lattice_of(Micromodulus kernel, double spacing, double ratio,
                        VolumeCorrection correction = VolumeCorrection::none, Plane plane = Plane::strain) {
  Medium medium;
  medium.material.youngs_modulus = medium.material.density = 1.0;
  medium.material.micromodulus = std::move(kernel);
  medium.continuum = {Dim, plane, 1.0};
  medium.horizon = ratio * spacing;
  Lattice<Dim> lattice{std::move(medium), make_family<Dim>(spacing, ratio * spacing, correction), {}};
  lattice.rates = bond_rates<Dim>(lattice.medium, lattice.family);
  return lattice;
}

/// Kernel shells with a multiplier for every orbit of the family of the ratio.
template <int Dim>
Micromodulus shells_of(double ratio, const std::vector<double>& alpha) {
  const Family<Dim> family = make_family<Dim>(1.0, ratio, VolumeCorrection::none);
  Micromodulus shells{Kernel::shells};
  shells.shells.resize(family.shell.size());
  for (std::size_t i = 0; i < family.shell.size(); ++i) {
    std::copy(family.shell[i].begin(), family.shell[i].end(), shells.shells[i].offset.begin());
    shells.shells[i].alpha = alpha.at(i);
  }
  return shells;
}

}  // namespace perimode::test
