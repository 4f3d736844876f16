// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "perimode/boundary/boundary_map.hpp"

namespace perimode {

/// Surface nodes of a given traction t, in a map whose ghosts follow surface nodes at rest. u_s makes the
/// force through the surface t A (docs/theory/03_boundaries.md):
///   sum_b k_b (u_f - u_i) = +- t A over the bonds b from i inside to f outside, + at the upper end,
///   u_s = (+- t A + sum_b k_b (u_i + r_f u_p)) / sum_b k_b (1 + r_f),
/// so that the ghosts follow all particles with bonds across it. Throws invalid_input: a body shorter than
/// the reach of its bonds, no bonds across the surface. Cost O(bonds) where there is a traction.
void add_tractions(BoundaryMap<1>& map, const Particles<1>& particles, const Bonds<1>& bonds,
                   const std::vector<BoundaryCondition>& conditions, const BondStiffness<1>& stiffness);

}  // namespace perimode
