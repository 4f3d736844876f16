// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "perimode/assembly/body.hpp"
#include "perimode/assembly/breakable_stiffness.hpp"

namespace perimode {

/// How much crack a broken bond stands for: V_i V_j beta / norm, norm the sum of V_i V_j beta over the bonds
/// that cross a unit of a plane crack (each once; of its length in 2D, its area in 3D, one cut in 1D), so
/// that a plane cut counts as its area. On a grid the norm is that of a lattice plane, exact for straight
/// cracks along the axes; on a cloud that of the continuum,
///   (1/2) section^2 int_0^delta r <|cos|> S r^(n-1) dr  (<|cos|>, S as fracture_energy),
/// for each bond at its own horizon. Fewer bonds cross near free surfaces, and at a tip those that touch it
/// alone are not cut: a crack between them comes out shorter by up to a family's share.
struct CrackAreaScale {
  double norm = 1.0;     ///< m^6/m^(Dim-1)
  double horizon = 1.0;  ///< the norm holds for, m; it grows with the horizon to the power Dim + 1
  double initial = 0.0;  ///< m (2D), m2 (3D), number (1D): of the pre-cracks, as given
};

/// Throws invalid_input as precracks. Cost O(family), on a cloud O(1).
template <int Dim>
[[nodiscard]] CrackAreaScale crack_area_scale(const Model& model, const Body<Dim>& body);

/// Length (2D, m), area (3D, m2) or number (1D) of crack that broken bonds stand for; of a bond to a ghost
/// that follows, half. `bonds` as with_images returns them. Cost O(bonds).
template <int Dim>
[[nodiscard]] double crack_area(const Body<Dim>& body, const CrackAreaScale& scale,
                                std::span<const BondRef> bonds);

}  // namespace perimode
