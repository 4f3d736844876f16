// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "perimode/core/types.hpp"

namespace perimode {

/// Which cells belong to the family of a lattice particle and how much of each counts.
enum class VolumeCorrection { none, linear, exact };

/// The family of an interior particle of a uniform grid: all lattice offsets within reach, without
/// the particle itself, in ascending order of (z, y, x), so both ends of every bond are present and
/// offset k is the negative of offset size()-1-k.
template <int Dim>
struct Family {
  double spacing = 0.0;
  double horizon = 0.0;                      ///< delta, m
  std::vector<std::array<int, Dim>> offset;  ///< in cells, x first
  std::vector<double> length;                ///< |xi| = spacing |offset|, m
  std::vector<double> weight;                ///< beta: share of the cell inside the horizon
  std::vector<int> orbit;                    ///< number of each member's orbit: its place in `shell`
  /// The orbits: offsets that share their absolute components, x >= y >= z >= 0, in ascending order of
  /// length, those of one length ((2,2,1) and (3,0,0)) lexicographically.
  std::vector<std::array<int, Dim>> shell;

  [[nodiscard]] int size() const { return static_cast<int>(offset.size()); }
  /// Largest |component| of an offset: how many layers of cells a bond can cross.
  [[nodiscard]] int reach() const;
};

/// none: |xi| <= delta (1 + 1e-9), beta = 1. linear: |xi| < delta + spacing/2 with
/// beta = min(1, (delta + spacing/2 - |xi|)/spacing) [bouaraquia2024] eq. (36). exact (1D): the fraction
/// of the cell inside the horizon. `self_cell` (1D) adds 1/2 to beta of the two nearest
/// neighbours: the half cells the inverse-distance sum drops (docs/theory).
/// Cost O((2 delta/spacing + 2)^Dim). Throws invalid_input where the family would be empty.
template <int Dim>
[[nodiscard]] Family<Dim> make_family(double spacing, double horizon, VolumeCorrection correction,
                                      bool self_cell = false);

}  // namespace perimode
