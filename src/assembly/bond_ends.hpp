// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "perimode/assembly/breakable_stiffness.hpp"

namespace perimode {

[[nodiscard]] inline bool operator<(const BondRef& a, const BondRef& b) {
  return a.particle < b.particle || (a.particle == b.particle && a.slot < b.slot);
}

/// Whether the bond carries force.
template <int Dim>
[[nodiscard]] bool alive(const Body<Dim>& body, const BondRef& bond);

/// The other end of a bond between particles; nothing for a bond to a ghost. Cost O(1), on a cloud O(log
/// family).
template <int Dim>
[[nodiscard]] std::optional<BondRef> other_end(const Body<Dim>& body, const BondRef& bond);

/// The image of a bond to a ghost: with the reflections M of the ghost of particle j, the bond of j along -M
/// xi to the ghost of this particle, which may be the bond itself. Nothing for bonds between particles and
/// for ghosts that stand still. Cost O(log family).
template <int Dim>
[[nodiscard]] std::optional<BondRef> wall_image(const Body<Dim>& body, const BondRef& bond);

}  // namespace perimode
