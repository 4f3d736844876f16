// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "perimode/dispersion/lattice.hpp"

namespace perimode {

/// An influence function alpha(r) = a0 + sum_j a_j cos(j w r/spacing), [alebrahim2021] eq. (50), fitted to
/// the multipliers of a lattice's orbits (kernel `fourier`).
struct InfluenceFit {
  Micromodulus micromodulus;       ///< Kernel::fourier, with its spacing
  double largest_deviation = 0.0;  ///< over the orbits; not 0 where two orbits of one distance differ
  /// int alpha |xi| dV over int |xi| dV within the horizon: 1 where the function stores the energy of the
  /// constant kernel, [alebrahim2021] eq. (5) at the theory's Poisson's ratio.
  double energy_ratio = 0.0;
  double least = 0.0;     ///< smallest value within [0, horizon]
  double least_at = 0.0;  ///< where, m
};

/// Least squares over the orbits, each counted once, with `terms` cosines (0 <= terms < 2 x orbits) and w
/// between pi/2 and 3 pi/2 over the horizon in spacings (half a period is from 2/3 to twice the horizon).
/// - Fewer coefficients (a0 included) than different distances: w makes the sum of squares least.
/// - Otherwise the function passes through every distance (the mean of its orbits); of all such functions of
///   one w that of least bending B = int_0^delta alpha''^2 dr is taken, and w makes B least.
/// w from 101 samples and golden sections around the best: the least of its valley, to 1e-8. Throws
/// invalid_input for a size that does not fit. Cost O(200 orbits terms^2).
template <int Dim>
[[nodiscard]] InfluenceFit fit_influence(const Lattice<Dim>& lattice, const std::vector<double>& alpha,
                                         int terms);

/// energy_ratio (to 1e-13), least and least_at (to 1e-8) of a given function; throws invalid_input for
/// another kernel than `fourier`. The critical stretch is that of critical_stretch.hpp.
[[nodiscard]] InfluenceFit examine_influence(const Micromodulus& fourier, double horizon,
                                             const Continuum& continuum);

}  // namespace perimode
