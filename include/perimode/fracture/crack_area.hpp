// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "perimode/assembly/body.hpp"
#include "perimode/assembly/breakable_stiffness.hpp"

namespace perimode {

/// How much crack a broken bond stands for: V_i V_j beta / norm, norm the sum of V_i V_j beta over the bonds
/// that cross a unit area of a plane crack (each once), so that a plane cut counts as its area. On a grid the
/// norm is that of a lattice plane, exact for straight cracks along the axes; on a cloud that of the
/// continuum,
///   (1/2) section int_0^delta r <|cos|> S r^(n-1) dr  (as fracture_energy).
struct CrackAreaScale {
  double norm = 1.0;     ///< m^6/m^(Dim-1) at the section's thickness
  double initial = 0.0;  ///< m (2D), m2 (3D), number (1D): of the pre-cracks, as given
};

/// Cost O(family), on a cloud O(bond ends).
template <int Dim>
[[nodiscard]] CrackAreaScale crack_area_scale(const Model& model, const Body<Dim>& body);

/// Length (2D, m), area (3D, m2) or number (1D) of crack that broken bonds stand for; of a bond to a ghost
/// that follows, half. `bonds` as with_images returns them.
template <int Dim>
[[nodiscard]] double crack_area(const Body<Dim>& body, const CrackAreaScale& scale,
                                std::span<const BondRef> bonds);

}  // namespace perimode
