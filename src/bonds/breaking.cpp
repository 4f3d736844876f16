// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "perimode/bonds/bonds.hpp"

namespace perimode {

namespace {

template <int Dim>
bool same_place(const Crack<Dim>& a, const Crack<Dim>& b, double tolerance) {
  return a.corner.size() == b.corner.size() &&
         std::all_of(a.corner.begin(), a.corner.end(), [&](const Point<Dim>& p) {
           return std::any_of(b.corner.begin(), b.corner.end(),
                              [&](const Point<Dim>& q) { return (p - q).norm() <= tolerance; });
         });
}

template <int Dim>
bool near_box(const Crack<Dim>& crack, const Point<Dim>& low, const Point<Dim>& high) {
  Point<Dim> a = crack.corner[0];
  Point<Dim> b = crack.corner[0];
  for (const auto& c : crack.corner) {
    a = a.cwiseMin(c);
    b = b.cwiseMax(c);
  }
  return ((b - low).array() >= 0.0).all() && ((high - a).array() >= 0.0).all();
}

/// The cracks with all their images in walls and periods that bonds of the grid can meet.
template <int Dim>
std::vector<Crack<Dim>> with_images(const GridBonds<Dim>& bonds, const Grid<Dim>& grid,
                                    std::vector<Crack<Dim>> cracks, double tolerance) {
  const double reach = (bonds.reach + 1) * grid.spacing;
  const Point<Dim> low = grid.lower.array() - reach;
  const Point<Dim> high = grid.upper().array() + reach;
  const auto add = [&](const Crack<Dim>& image) {
    const bool known = std::any_of(cracks.begin(), cracks.end(),
                                   [&](const Crack<Dim>& c) { return same_place(c, image, tolerance); });
    if (!known && near_box(image, low, high)) cracks.push_back(image);
  };
  for (std::size_t k = 0; k < cracks.size(); ++k) {  // grows: images of images
    for (int a = 0; a < Dim; ++a) {
      const double period = grid.cells[a] * grid.spacing;
      for (int side = 0; side < 2; ++side) {
        const Crack<Dim> original = cracks[k];
        if (bonds.beyond[2 * a + side] == Beyond::ghosts) {
          add(reflected(original, a, grid.lower[a] + side * period));
        } else if (bonds.beyond[2 * a + side] == Beyond::periodic_image) {
          Crack<Dim> image = original;
          for (auto& c : image.corner) c[a] += side == 0 ? -period : period;
          add(image);
        }
      }
    }
  }
  return cracks;
}

template <int Dim>
void clear_bit(GridBonds<Dim>& bonds, Index i, Offset slot) {
  bonds.alive[static_cast<std::size_t>(i) * bonds.words + slot / 64] &= ~(std::uint64_t{1} << (slot % 64));
}
template <int Dim>
void clear_bit(CloudBonds<Dim>& bonds, Index, Offset slot) {
  bonds.alive[slot / 64] &= ~(std::uint64_t{1} << (slot % 64));
}

/// The same bond seen from its other end; a grid bond's partner slot is the opposite offset.
template <int Dim>
Offset partner_slot(const GridBonds<Dim>& bonds, Index, Index, Offset slot) {
  return bonds.family.size() - 1 - slot;
}
template <int Dim>
Offset partner_slot(const CloudBonds<Dim>& bonds, Index i, Index j, Offset) {
  const auto first = bonds.neighbour.begin() + bonds.start[j];
  return std::lower_bound(first, bonds.neighbour.begin() + bonds.start[j + 1], i) - bonds.neighbour.begin();
}

}  // namespace

template <int Dim>
void break_bond(Bonds<Dim>& bonds, Index i, Offset slot) {
  std::visit(
      [&](auto& b) {
        if (!is_alive(b, i, slot)) return;
        Index j = 0;
        Index particles = 0;
        if constexpr (std::is_same_v<std::decay_t<decltype(b)>, GridBonds<Dim>>) {
          j = b.occupant[b.home[i] + b.step[slot]];
          particles = static_cast<Index>(b.home.size());
        } else {
          j = b.neighbour[slot];
          particles = static_cast<Index>(b.start.size()) - 1;
        }
        clear_bit(b, i, slot);
        if (j < particles) clear_bit(b, j, partner_slot(b, i, j, slot));
      },
      bonds);
}

template <int Dim>
Offset cut_bonds(Bonds<Dim>& bonds, const Particles<Dim>& particles, const std::vector<Crack<Dim>>& cracks,
                 double spacing) {
  if (cracks.empty()) return 0;
  const double tolerance = 1e-9 * spacing;
  const Offset before = count_bonds(bonds, particles.count());
  std::vector<Crack<Dim>> all = cracks;
  if (const auto* grid = std::get_if<GridBonds<Dim>>(&bonds)) {
    all = with_images(*grid, *particles.grid, std::move(all), tolerance);
  }
  join(all, tolerance);
  // Each end decides for itself; ties are decided by the tolerance, far above round-off, so both agree.
  std::visit(
      [&](auto& b) {
        for (Index i = 0; i < particles.count(); ++i) {
          const Point<Dim>& x = particles.position[i];
          for_each_bond(b, i, Which::alive, [&](const BondEnd<Dim>& end) {
            const Point<Dim> y = x + end.xi;
            for (const auto& crack : all) {
              const Point<Dim> low = x.cwiseMin(y).array() - tolerance;
              const Point<Dim> high = x.cwiseMax(y).array() + tolerance;
              if (near_box(crack, low, high) && crosses(crack, x, y, tolerance)) {
                clear_bit(b, i, end.slot);
                break;
              }
            }
          });
        }
      },
      bonds);
  return before - count_bonds(bonds, particles.count());
}

template <int Dim>
Offset count_bonds(const Bonds<Dim>& bonds, Index particles) {
  Offset between = 0;
  Offset to_ghosts = 0;
  for (Index i = 0; i < particles; ++i) {
    for_each_bond(bonds, i, Which::alive,
                  [&](const BondEnd<Dim>& end) { ++(end.neighbour < particles ? between : to_ghosts); });
  }
  return between / 2 + to_ghosts;
}

#define PERIMODE_BREAKING(D)                                                                          \
  template void break_bond<D>(Bonds<D>&, Index, Offset);                                              \
  template Offset cut_bonds<D>(Bonds<D>&, const Particles<D>&, const std::vector<Crack<D>>&, double); \
  template Offset count_bonds<D>(const Bonds<D>&, Index)
PERIMODE_BREAKING(1);
PERIMODE_BREAKING(2);
PERIMODE_BREAKING(3);
#undef PERIMODE_BREAKING

}  // namespace perimode
