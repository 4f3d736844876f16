// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>
#include <string>

#include "perimode/bonds/bonds.hpp"
#include "perimode/core/error.hpp"

namespace perimode {

namespace {

/// Where a cell index of one axis, in or beyond the grid, lands: on a cell of the grid after
/// reflections at the lower and upper face, or nowhere.
struct Fold {
  Index cell = GridBonds<1>::absent;
  std::uint8_t lower = 0, upper = 0;
};

Fold fold(Index c, Index n, Beyond low, Beyond high) {
  Fold f;
  while (c < 0 || c >= n) {
    const Beyond side = c < 0 ? low : high;
    if (side == Beyond::nothing) return f;
    if (side == Beyond::periodic_image) {
      c = ((c % n) + n) % n;
    } else if (c < 0) {
      c = -1 - c;
      ++f.lower;
    } else {
      c = 2 * n - 1 - c;
      ++f.upper;
    }
  }
  f.cell = c;
  return f;
}

}  // namespace

template <int Dim>
GridBonds<Dim> make_grid_bonds(const Particles<Dim>& particles, Family<Dim> family,
                               const std::array<Beyond, 2 * Dim>& beyond) {
  const Grid<Dim>& grid = *particles.grid;
  GridBonds<Dim> b;
  b.reach = family.reach();
  b.beyond = beyond;
  const Index n = particles.count();

  std::vector<Index> particle_of_cell(static_cast<std::size_t>(grid.count()), GridBonds<Dim>::absent);
  for (Index i = 0; i < n; ++i) particle_of_cell[particles.cell[i]] = i;

  std::array<std::vector<Fold>, Dim> folds;
  Offset cells = 1;
  std::array<Index, Dim> stride = {};
  for (int a = 0; a < Dim; ++a) {
    const Beyond low = beyond[2 * a];
    const Beyond high = beyond[2 * a + 1];
    if ((low == Beyond::periodic_image) != (high == Beyond::periodic_image)) {
      invalid_input(
          {"both faces of an axis periodic, or neither", "one", "list the axis in body.periodic only", {}});
    }
    b.padded[a] = grid.cells[a] + 2 * b.reach;
    stride[a] = static_cast<Index>(cells);
    cells *= b.padded[a];
    for (Index c = -b.reach; c < grid.cells[a] + b.reach; ++c)
      folds[a].push_back(fold(c, grid.cells[a], low, high));
  }
  if (cells > std::numeric_limits<Index>::max()) {
    invalid_input({"fewer than 2^31 cells, layers beyond the faces included",
                   std::to_string(cells),
                   "use a larger spacing or a smaller horizon",
                   {}});
  }

  b.occupant.assign(static_cast<std::size_t>(cells), GridBonds<Dim>::absent);
  b.home.assign(n, 0);
  for (Index cell = 0; cell < cells; ++cell) {
    Index rest = cell;
    Index number = 0;
    Index grid_stride = 1;
    Ghost<Dim> ghost;
    bool inside = true;
    bool nowhere = false;
    for (int a = 0; a < Dim; ++a) {
      const Index c = rest % b.padded[a];
      rest /= b.padded[a];
      const Fold& f = folds[a][c];
      nowhere = nowhere || f.cell == GridBonds<Dim>::absent;
      number += grid_stride * std::max<Index>(f.cell, 0);
      grid_stride *= grid.cells[a];
      ghost.crossings[2 * a] = f.lower;
      ghost.crossings[2 * a + 1] = f.upper;
      ghost.position[a] = grid.lower[a] + (c - b.reach + 0.5) * grid.spacing;
      inside = inside && c >= b.reach && c < b.reach + grid.cells[a];
    }
    if (nowhere) continue;
    const Index particle = particle_of_cell[number];
    if (particle == GridBonds<Dim>::absent) continue;
    if (inside) b.home[particle] = cell;
    const bool mirrored =
        std::any_of(ghost.crossings.begin(), ghost.crossings.end(), [](auto k) { return k > 0; });
    if (mirrored) {
      ghost.image = particle;
      b.occupant[cell] = n + static_cast<Index>(b.ghosts.size());
      b.ghosts.push_back(ghost);
    } else {
      b.occupant[cell] = particle;
    }
  }

  for (const auto& o : family.offset) {
    Index s = 0;
    for (int a = 0; a < Dim; ++a) s += o[a] * stride[a];
    b.step.push_back(s);
  }
  b.words = (family.size() + 63) / 64;
  b.alive.assign(static_cast<std::size_t>(n) * b.words, 0);
  b.family = std::move(family);
#pragma omp parallel for schedule(static)
  for (Index i = 0; i < n; ++i) {
    std::uint64_t* bits = b.alive.data() + static_cast<std::size_t>(i) * b.words;
    for (int k = 0; k < b.family.size(); ++k) {
      const Index j = b.occupant[b.home[i] + b.step[k]];
      if (j != GridBonds<Dim>::absent && j != i) bits[k / 64] |= std::uint64_t{1} << (k % 64);
    }
  }
  return b;
}

template GridBonds<1> make_grid_bonds<1>(const Particles<1>&, Family<1>, const std::array<Beyond, 2>&);
template GridBonds<2> make_grid_bonds<2>(const Particles<2>&, Family<2>, const std::array<Beyond, 4>&);
template GridBonds<3> make_grid_bonds<3>(const Particles<3>&, Family<3>, const std::array<Beyond, 6>&);

}  // namespace perimode
