// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "perimode/bonds/bonds.hpp"

namespace perimode {

/// The slot of the bond of i and j at its end j, `slot` being that at i: on a grid the opposite offset.
template <int Dim>
[[nodiscard]] Offset partner_slot(const GridBonds<Dim>& bonds, Index, Index, Offset slot) {
  return bonds.family.size() - 1 - slot;
}
template <int Dim>
[[nodiscard]] Offset partner_slot(const CloudBonds<Dim>& bonds, Index i, Index j, Offset) {
  const auto first = bonds.neighbour.begin() + bonds.start[j];
  return std::lower_bound(first, bonds.neighbour.begin() + bonds.start[j + 1], i) - bonds.neighbour.begin();
}

}  // namespace perimode
