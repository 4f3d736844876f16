// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "perimode/bonds/bonds.hpp"

namespace perimode {

/// An end of a bond.
struct CrossingEnd {
  Index particle = 0;
  Offset slot = 0;
};

/// Ends of alive bonds that cross one of the cracks, by particle and slot; cracks are repeated in a grid's
/// walls and in periodic images first. What is marked as joined stays so, coinciding ends join. `spacing`
/// scales the tolerance 1e-9. Cost O(particles + bonds near the cracks).
template <int Dim>
[[nodiscard]] std::vector<CrossingEnd> crossing_ends(const Bonds<Dim>& bonds, const Particles<Dim>& particles,
                                                     std::vector<Crack<Dim>> cracks, double spacing);

}  // namespace perimode
