// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "perimode/assembly/body.hpp"
#include "perimode/assembly/breakable_stiffness.hpp"
#include "perimode/boundary/loads.hpp"
#include "perimode/geometry/crack.hpp"

namespace perimode {

/// The load at which a crack grows by Griffith's criterion, from two static solutions: with the potential
/// energies Pi = U - f . u at load factor 1 before and after the crack is longer by one increment,
///   G = (Pi_before - Pi_after) / area,  load_factor = sqrt(G0 / G).
/// Converges to linear elastic fracture mechanics as the horizon shrinks (docs/theory/14_quasistatic.md).
struct GriffithLoad {
  double load_factor = 0.0;
  double energy_release_rate = 0.0;  ///< G at load factor 1, J/m2
  double fracture_energy = 0.0;      ///< G0, J/m2
  double increment = 0.0;            ///< area of the increment, m2
  Offset cut = 0;                    ///< bonds it cuts
};

/// The first pre-crack made longer by `spacings` spacings of the grid (clouds: mean spacing
/// (V/section)^(1/Dim)), straight on at its `to` end; in 3D at its far edge, that whose middle lies furthest
/// from the line of its first edge, in its plane and at right angles to that edge: what it adds, as a crack
/// joined to it. Throws invalid_input without a pre-crack and in 1D, where it has no length.
template <int Dim>
[[nodiscard]] Crack<Dim> crack_increment(const Model& model, const Body<Dim>& body, double spacings = 1.0);

/// Length (2D, m) or area (3D, m2) of a crack; 1 in 1D.
template <int Dim>
[[nodiscard]] double extent(const Crack<Dim>& crack);

/// Bonds alive that cross a crack, images included (with_images); what is marked as joined is cut as well.
/// Cost O(particles + bonds near the crack).
template <int Dim>
[[nodiscard]] std::vector<BondRef> crossing_bonds(const Body<Dim>& body, const Crack<Dim>& crack);

/// Fracture energy of the material of the body's first breakable block, J/m2: its own, or that of its
/// critical stretch at the horizon (material/critical_stretch.hpp, assembly/critical_stretches.hpp). Throws
/// invalid_input where no block has either.
template <int Dim>
[[nodiscard]] double fracture_energy_of(const Model& model, const Body<Dim>& body);

/// The Griffith load of a body whose crack grows by `increment` under `loads`; without loads, under its given
/// motion. Throws invalid_input: an increment that cuts no bond, and as solve_static. Cost: two static
/// solutions.
template <int Dim>
[[nodiscard]] GriffithLoad griffith_load(const Body<Dim>& body, const std::vector<Load>& loads,
                                         const Crack<Dim>& increment, double fracture_energy);

}  // namespace perimode
