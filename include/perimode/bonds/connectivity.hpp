// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "perimode/bonds/bonds.hpp"

namespace perimode {

/// The pieces alive bonds hold together; a bond to a ghost ties a particle to the ghost's image.
struct Pieces {
  std::vector<Index> of;  ///< piece of each particle, numbered by first particle
  Index count = 0;
  Index isolated = 0;  ///< particles without any alive bond
};

/// Cost O(bonds) by union-find.
template <int Dim>
[[nodiscard]] Pieces find_pieces(const Bonds<Dim>& bonds, Index particles);

}  // namespace perimode
