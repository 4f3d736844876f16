// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "perimode/core/types.hpp"
#include "perimode/geometry/grid.hpp"
#include "perimode/geometry/region.hpp"

namespace perimode {

/// The particles of a body. On a grid they are the cells that were not removed, in cell order;
/// `cell` then holds the cell number of each (empty for a cloud).
template <int Dim>
struct Particles {
  std::vector<Point<Dim>> position;  ///< m
  std::vector<double> volume;        ///< m3 (thickness or area included)
  std::vector<int> block;            ///< index into block_names; 0 = no named block
  std::vector<std::string> block_names = {""};
  std::optional<Grid<Dim>> grid;
  std::vector<Index> cell;

  [[nodiscard]] Index count() const { return static_cast<Index>(position.size()); }
};

/// One particle per grid cell; `section` is the thickness, the area or 1 (3D).
template <int Dim>
[[nodiscard]] Particles<Dim> grid_particles(const Grid<Dim>& grid, double section);

/// Numbers of the particles in a region, ascending. The face of a grid is that of its box; the face
/// of a cloud is the extreme particle position. Boundaries of boxes and balls belong to them, to 1e-9 of
/// the body's spacing. Throws invalid_input: wrong dimension, unknown block, layers on a cloud
/// or depth on a grid. Cost O(particles).
template <int Dim>
[[nodiscard]] std::vector<Index> select(const Region& region, const Particles<Dim>& particles);

/// The particles that are left when those in `removed` (ascending) are taken out.
template <int Dim>
[[nodiscard]] Particles<Dim> without(const Particles<Dim>& particles, const std::vector<Index>& removed);

/// Grid spacing, or for a cloud the mean over particles of (volume/section)^(1/Dim), m.
template <int Dim>
[[nodiscard]] double typical_spacing(const Particles<Dim>& particles, double section);

}  // namespace perimode
