// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "perimode/dispersion/optimise.hpp"
#include "perimode/dispersion/symbol.hpp"

namespace perimode::test {

/// The lattice of the constant kernel with a horizon of `ratio` spacings and no volume correction; plane
/// strain in 2D, units that are not 1.
template <int Dim>
Lattice<Dim> constant_lattice(double ratio, Plane plane = Plane::strain, double spacing = 0.25) {
  Medium medium;
  medium.material.youngs_modulus = 72e9;
  medium.material.density = 2440.0;
  medium.continuum = {Dim, plane, Dim == 3 ? 1.0 : 0.3};
  medium.horizon = ratio * spacing;
  const Family<Dim> family = make_family<Dim>(spacing, medium.horizon, VolumeCorrection::none);
  const std::vector<double> rates = bond_rates<Dim>(medium, family);
  return {medium, family, rates};
}

inline Eigen::VectorXd as_vector(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

}  // namespace perimode::test
