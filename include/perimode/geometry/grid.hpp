// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "perimode/core/types.hpp"
#include "perimode/geometry/region.hpp"

namespace perimode {

/// Box of equal cells. Cell (i, j, k) is number i + nx (j + ny k); its centre lies at
/// lower + (i + 1/2, j + 1/2, k + 1/2) spacing.
template <int Dim>
struct Grid {
  Point<Dim> lower = Point<Dim>::Zero();
  double spacing = 0.0;
  std::array<Index, Dim> cells = {};

  [[nodiscard]] Offset count() const;
  [[nodiscard]] Point<Dim> upper() const;
  [[nodiscard]] std::array<Index, Dim> cell(Index number) const;
  [[nodiscard]] Point<Dim> centre(const std::array<Index, Dim>& cell) const;
};

/// Checks that the box holds a whole number (>= 1) of cells per axis, to 1e-9 of one, and fewer
/// than 2^31 in all. Throws invalid_input.
template <int Dim>
[[nodiscard]] Grid<Dim> make_grid(const Coordinates& lower, const Coordinates& upper, double spacing,
                                  const Where& where = {});

/// A coordinate list of exactly Dim finite numbers as a point. Throws invalid_input, naming `what`.
template <int Dim>
[[nodiscard]] Point<Dim> to_point(const Coordinates& coordinates, const char* what, const Where& where = {});

}  // namespace perimode
