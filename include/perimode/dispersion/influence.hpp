// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "perimode/dispersion/lattice.hpp"

namespace perimode {

/// An influence function alpha(r) = a0 + sum_j a_j cos(j w r/spacing), [alebrahim2021] eq. (50), fitted to
/// the multipliers of a lattice's orbits (kernel `fourier`).
struct InfluenceFit {
  Micromodulus micromodulus;       ///< Kernel::fourier, with its spacing
  double largest_deviation = 0.0;  ///< over the orbits
  /// int alpha |xi| dV over int |xi| dV within the horizon: 1 where the function stores the energy of the
  /// constant kernel, [alebrahim2021] eq. (5) at the theory's Poisson's ratio.
  double energy_ratio = 0.0;
  double least = 0.0;     ///< smallest value within (0, horizon]
  double least_at = 0.0;  ///< where, m
};

/// Least squares over the orbits with `terms` cosines (0 <= terms < 2 x orbits), the smoothest of the
/// functions that fit best, w such that the deviation is least. Throws invalid_input for a size that does not
/// fit.
template <int Dim>
[[nodiscard]] InfluenceFit fit_influence(const Lattice<Dim>& lattice, const std::vector<double>& alpha,
                                         int terms);

/// energy_ratio, least and least_at of a given function.
[[nodiscard]] InfluenceFit examine_influence(const Micromodulus& fourier, double horizon,
                                             const Continuum& continuum);

}  // namespace perimode
