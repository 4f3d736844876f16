// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "perimode/material/material.hpp"
#include "perimode/material/micromodulus.hpp"

namespace perimode {

/// A homogeneous peridynamic medium without boundaries.
struct Medium {
  Material material = {};
  Continuum continuum = {};
  double horizon = 0.0;  ///< delta, m
};

/// c0 of the medium's kernel (micromodulus.hpp).
[[nodiscard]] double micromodulus_constant(const Medium& medium);

/// Polarisation of a plane wave: along the wave vector or across it (2D, 3D).
enum class Branch { pressure, shear };

/// Speed of classical elastic waves, m/s, at the Poisson's ratio the theory fixes: 1D sqrt(E/rho); plane
/// stress sqrt(9E/8rho), sqrt(3E/8rho); plane strain and 3D sqrt(6E/5rho), sqrt(2E/5rho).
/// Throws invalid_input for a shear wave in 1D.
[[nodiscard]] double classical_speed(const Medium& medium, Branch branch);

/// Angular frequency (rad/s) of a plane wave of wave number k (rad/m) in the peridynamic continuum,
///   omega^2 = (1/rho) int c(r)/r <w(n) (1 - cos(k r n.e))> dV,  e = k/|k|,
/// w = (n.e)^2 for pressure, (1 - (n.e)^2)/(Dim - 1) for shear (docs/theory/05_closed_forms.md eq. (7), (8)).
/// Relative error < 1e-13; cost O((1 + k delta)^2) evaluations. NaN for a table of shells, which is no
/// function of r, and where omega^2 < 0. Throws invalid_input for a shear wave in 1D.
[[nodiscard]] double continuum_frequency(const Medium& medium, Branch branch, double k);

}  // namespace perimode
