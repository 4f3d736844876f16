// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "perimode/dispersion/lattice.hpp"

namespace perimode {

/// A wave along one side of the contour of the irreducible zone (O-X; O-M-Y-O; O-X-M-R-O), whose
/// polarisation the symmetry of the side fixes, so that omega^2 = a . M(k) a is linear in the multipliers of
/// the orbits (docs/theory/17_optimised_micromoduli.md). At s in [0, pi] of the side k spacing = pi start + s
/// step.
template <int Dim>
struct ContourBranch {
  std::array<int, Dim> start = {};
  std::array<int, Dim> step = {};
  Point<Dim> polarisation = Point<Dim>::Zero();  ///< a, a unit vector
  Branch branch = Branch::pressure;
  int count = 1;  ///< waves that share it: 2 for the shear waves of an axis of the cube
};
template <int Dim>
[[nodiscard]] std::vector<ContourBranch<Dim>> contour_branches();

/// k spacing on a side, and the length of its step.
template <int Dim>
[[nodiscard]] Point<Dim> contour_point(const ContourBranch<Dim>& side, double s);
template <int Dim>
[[nodiscard]] double step_length(const ContourBranch<Dim>& side);

/// c_P^2 and c_S^2 over E/rho at a Poisson's ratio (absent: the theory's):
///   (1 - nu)/((1 + nu)(1 - 2 nu)), in plane stress 1/(1 - nu^2), and 1/(2(1 + nu)); in 1D 1 and 0.
/// Throws invalid_input: a ratio in 1D, or outside (-1, 1/2).
[[nodiscard]] std::array<double, 2> target_speeds(const Continuum& continuum,
                                                  const std::optional<double>& poissons_ratio);

/// Bond rates times rho spacing^2/E: those of the lattice as it is, and those of the constant kernel.
template <int Dim>
[[nodiscard]] std::vector<double> unit_rates(const Lattice<Dim>& lattice);
template <int Dim>
[[nodiscard]] std::vector<double> constant_rates(const Lattice<Dim>& lattice);

/// Throws invalid_input for weights that are negative, not finite or all 0 (in 1D the first counts alone).
void require_weights(const std::array<double, 2>& weights, int dimension);

}  // namespace perimode
