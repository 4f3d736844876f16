// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "perimode/material/micromodulus.hpp"

namespace perimode {

/// Energy of all bonds that cross a unit area of a crack at stretch s0, each counted once, J/m2: with the
/// energy c(r) s0^2 r/2 per bond (and volume squared) and the mean of |cos| over directions,
///   G0 = (s0^2/4) section int_0^delta c(r) r^2 <|cos|> S r^(n-1) dr,
/// <|cos|> = 1, 2/pi, 1/2 and S = 2, 2 pi, 4 pi in n = 1, 2, 3 dimensions. With c = c0 g(r) of the continuum
/// (micromodulus_constant), whatever the calibration of a body. The constant kernel gives
///   s0 = sqrt(5 G0/(9 K delta)) in 3D,  sqrt(5 pi G0/(12 E delta)) in plane strain.
/// Relative error < 1e-12. Throws invalid_input as micromodulus_constant, and for shells, which are no
/// function of r: lattice_fracture_energy.
[[nodiscard]] double fracture_energy(const Micromodulus& micromodulus, double youngs_modulus,
                                     double critical_stretch, double horizon, const Continuum& continuum);

/// The same on a grid: the bonds that cross a unit area of a plane between two layers of particles. Of a
/// family member xi with xi_x > 0, xi_x/spacing bonds cross the face of every cell, V/spacing:
///   G0 = (s0^2/2) sum_{xi_x > 0} c(xi) beta |xi| xi_x V,  V = section spacing^n,
/// with c = c0 g(r) or c0 times the alpha of the orbit; by the symmetry of orbits the axis does not matter.
/// Cost O(family).
template <int Dim>
[[nodiscard]] double lattice_fracture_energy(const Micromodulus& micromodulus, double youngs_modulus,
                                             double critical_stretch, const Family<Dim>& family,
                                             const Continuum& continuum);

/// The critical stretch s0 of a fracture energy G0 > 0 (J/m2) at which all crossing bonds store
/// `energy_at_unit_stretch` (J/m2) times s0^2. Throws invalid_input: G0 <= 0, an energy that is not > 0, as
/// that of a micromodulus with large negative parts.
[[nodiscard]] double stretch_of(double fracture_energy, double energy_at_unit_stretch);

/// The inverse of fracture_energy.
[[nodiscard]] double critical_stretch(const Micromodulus& micromodulus, double youngs_modulus,
                                      double fracture_energy, double horizon, const Continuum& continuum);

}  // namespace perimode
