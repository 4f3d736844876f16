// SPDX-License-Identifier: BSD-3-Clause
#include "boundary/ghost_rule.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstdlib>
#include <numeric>

namespace perimode {

namespace {

/// Sign of component `component` after one reflection at a wall normal to `axis`; 0 for a zero layer.
double reflection(WallType type, int axis, int component) {
  switch (type) {
    case WallType::odd:
      return -1.0;
    case WallType::even:
      return 1.0;
    case WallType::mirror:
      return axis == component ? -1.0 : 1.0;
    case WallType::antimirror:
      return axis == component ? 1.0 : -1.0;
    case WallType::zero_layer:
    case WallType::surface_nodes:  // set apart: no reflection
      break;
  }
  return 0.0;
}

/// The particle of a cell of the grid, or absent.
template <int Dim>
Index particle_at(const GridBonds<Dim>& bonds, const std::array<Index, Dim>& cell) {
  Index padded = 0;
  Index stride = 1;
  for (int a = 0; a < Dim; ++a) {
    padded += stride * (cell[a] + bonds.reach);
    stride *= bonds.padded[a];
  }
  return bonds.occupant[padded];
}

/// The particle p behind x_s, seen from the cell f beyond faces of surface nodes, and its ratio. x_f - x_s is
/// d half spacings, odd beyond a face and 0 along it; with g the greatest common divisor, cell centres lie at
/// x_s - k d / g for odd k: p is the first one that is occupied, and the ratio g / k.
template <int Dim>
bool look_inward(GhostRule<Dim>& rule, const std::array<Index, Dim>& f, const Grid<Dim>& grid,
                 const GridBonds<Dim>& bonds) {
  std::array<Index, Dim> d = {};
  Index g = 0;
  for (int a = 0; a < Dim; ++a) {
    if (f[a] < 0) d[a] = 2 * f[a] + 1;
    if (f[a] >= grid.cells[a]) d[a] = 2 * (f[a] - grid.cells[a]) + 1;
    g = std::gcd(g, std::abs(d[a]));
  }
  for (Index k = 1;; k += 2) {
    std::array<Index, Dim> p = f;
    for (int a = 0; a < Dim; ++a) {
      if (d[a] == 0) continue;
      const Index face = d[a] < 0 ? 0 : 2 * grid.cells[a];
      p[a] = (face - k * (d[a] / g) - 1) / 2;
      if (p[a] < 0 || p[a] >= grid.cells[a]) return false;
    }
    rule.particle = particle_at<Dim>(bonds, p);
    if (rule.particle == GridBonds<Dim>::absent) continue;
    rule.ratio = static_cast<double>(g) / static_cast<double>(k);
    return true;
  }
}

}  // namespace

template <int Dim>
std::array<int, 2 * Dim> wall_numbers(const std::vector<BoundaryCondition>& conditions) {
  std::array<int, 2 * Dim> number;
  number.fill(GhostRule<Dim>::none);
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    if (const auto* wall = std::get_if<Wall>(&conditions[c].what))
      number[2 * wall->face.axis + (wall->face.upper ? 1 : 0)] = static_cast<int>(c);
  }
  return number;
}

template <int Dim>
GhostRule<Dim> ghost_rule(const Ghost<Dim>& ghost, const Grid<Dim>& grid, const GridBonds<Dim>& bonds,
                          const std::vector<BoundaryCondition>& conditions,
                          const std::array<int, 2 * Dim>& walls) {
  GhostRule<Dim> rule;
  rule.sign.fill(1.0);
  std::array<Index, Dim> cell = {};
  for (int a = 0; a < Dim; ++a) {
    const Index n = grid.cells[a];
    Index c = static_cast<Index>(std::floor((ghost.position[a] - grid.lower[a]) / grid.spacing));
    while (c < 0 || c >= n) {
      const int side = 2 * a + (c < 0 ? 0 : 1);
      if (bonds.beyond[side] == Beyond::periodic_image) {
        c = ((c % n) + n) % n;
        continue;
      }
      const WallType type = std::get<Wall>(conditions[walls[side]].what).type;
      if (type == WallType::surface_nodes) {
        rule.wall = std::max(rule.wall, walls[side]);
        break;
      }
      for (int b = 0; b < Dim; ++b) rule.sign[b] *= reflection(type, a, b);
      c = c < 0 ? -1 - c : 2 * n - 1 - c;
    }
    cell[a] = c;
  }
  if (rule.wall == GhostRule<Dim>::none) {
    rule.particle = particle_at<Dim>(bonds, cell);
    return rule;
  }
  const Point<Dim> centre = grid.centre(cell);
  rule.surface = centre.cwiseMax(grid.lower).cwiseMin(grid.upper());
  if (!look_inward<Dim>(rule, cell, grid, bonds)) {
    invalid_input({"a particle on the inward normal of the surface nodes",
                   fmt::format("none for the fictitious particle at ({:.6g})", fmt::join(centre, ", ")),
                   "where surface nodes meet at an edge the body is at least as thick as the horizon",
                   conditions[rule.wall].where});
  }
  return rule;
}

#define PERIMODE_GHOST_RULE(D)                                                              \
  template std::array<int, 2 * D> wall_numbers<D>(const std::vector<BoundaryCondition>&);   \
  template GhostRule<D> ghost_rule<D>(const Ghost<D>&, const Grid<D>&, const GridBonds<D>&, \
                                      const std::vector<BoundaryCondition>&, const std::array<int, 2 * D>&)
PERIMODE_GHOST_RULE(1);
PERIMODE_GHOST_RULE(2);
PERIMODE_GHOST_RULE(3);
#undef PERIMODE_GHOST_RULE

}  // namespace perimode
