// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <variant>
#include <vector>

#include "perimode/bonds/family.hpp"
#include "perimode/core/types.hpp"
#include "perimode/geometry/crack.hpp"
#include "perimode/geometry/particles.hpp"

namespace perimode {

/// What lies beyond a face of a grid.
enum class Beyond { nothing, periodic_image, ghosts };

/// A fictitious particle beyond a wall: the mirror image of particle `image`, reflected
/// crossings[2 axis + (upper ? 1 : 0)] times at each face.
template <int Dim>
struct Ghost {
  Index image = 0;
  std::array<std::uint8_t, 2 * Dim> crossings = {};
  Point<Dim> position = Point<Dim>::Zero();  ///< m
};

/// Bonds of a uniform grid, implicit: the family (orbit table), a map of the grid padded by `reach`
/// cells on every side, and one alive bit per particle and family member. Both ends of a bond carry
/// its bit (bonds to ghosts: the particle's end only).
template <int Dim>
struct GridBonds {
  static constexpr Index absent = -1;

  Family<Dim> family;
  std::array<Beyond, 2 * Dim> beyond = {};  ///< what lies beyond face 2 axis + (upper ? 1 : 0)
  int reach = 0;
  std::array<Index, Dim> padded = {};  ///< cells of the padded grid per axis
  std::vector<Index> occupant;         ///< per padded cell: particle, particles + ghost, or absent
  std::vector<Index> home;             ///< padded cell of each particle
  std::vector<Index> step;             ///< padded cell difference of each family member
  std::vector<Ghost<Dim>> ghosts;
  int words = 0;                     ///< 64-bit words of alive bits per particle
  std::vector<std::uint64_t> alive;  ///< particles * words
};

/// Bonds of a cloud: both ends of every bond, sorted by particle and neighbour. Two particles have one bond
/// at most; through a periodic face it ends at the particle whose image it meets, and xi leads to the image.
template <int Dim>
struct CloudBonds {
  Point<Dim> period = Point<Dim>::Zero();  ///< m per axis; 0: not periodic
  std::vector<Offset> start;               ///< particles + 1
  std::vector<Index> neighbour;
  std::vector<Point<Dim>> xi;        ///< m
  std::vector<double> weight;        ///< beta
  std::vector<double> horizon;       ///< delta of the pair, m
  std::vector<std::uint64_t> alive;  ///< one bit per entry
};

template <int Dim>
using Bonds = std::variant<GridBonds<Dim>, CloudBonds<Dim>>;

/// One end of one bond, as seen from a particle. `slot` is the family member (grid) or the entry
/// (cloud) and addresses per-bond tables.
template <int Dim>
struct BondEnd {
  Index neighbour;  ///< >= particle count: ghost number + particle count
  Point<Dim> xi;    ///< to the neighbour, m
  double length;    ///< |xi|, m
  double weight;    ///< beta
  double horizon;   ///< m
  Offset slot;
};

/// alive: bonds that carry force. present: also bonds cut by pre-cracks and those of a particle to
/// its own periodic image, which carry none but count in a calibration.
enum class Which { alive, present };

template <int Dim>
[[nodiscard]] bool is_alive(const GridBonds<Dim>& bonds, Index i, Offset slot) {
  return (bonds.alive[static_cast<std::size_t>(i) * bonds.words + slot / 64] >> (slot % 64)) & 1U;
}
template <int Dim>
[[nodiscard]] bool is_alive(const CloudBonds<Dim>& bonds, Index, Offset slot) {
  return (bonds.alive[slot / 64] >> (slot % 64)) & 1U;
}

/// Calls visit(BondEnd) for every bond of particle i in ascending slot order. Cost O(family).
template <int Dim, class Visit>
void for_each_bond(const GridBonds<Dim>& bonds, Index i, Which which, Visit&& visit) {
  const Family<Dim>& f = bonds.family;
  for (int k = 0; k < f.size(); ++k) {
    const Index j = bonds.occupant[bonds.home[i] + bonds.step[k]];
    if (j == GridBonds<Dim>::absent || (which == Which::alive && !is_alive(bonds, i, k))) continue;
    Point<Dim> xi;
    for (int a = 0; a < Dim; ++a) xi[a] = f.spacing * f.offset[k][a];
    visit(BondEnd<Dim>{j, xi, f.length[k], f.weight[k], f.horizon, k});
  }
}
template <int Dim, class Visit>
void for_each_bond(const CloudBonds<Dim>& bonds, Index i, Which which, Visit&& visit) {
  for (Offset e = bonds.start[i]; e < bonds.start[i + 1]; ++e) {
    if (which == Which::alive && !is_alive(bonds, i, e)) continue;
    visit(BondEnd<Dim>{bonds.neighbour[e], bonds.xi[e], bonds.xi[e].norm(), bonds.weight[e], bonds.horizon[e],
                       e});
  }
}
template <int Dim, class Visit>
void for_each_bond(const Bonds<Dim>& bonds, Index i, Which which, Visit&& visit) {
  std::visit([&](const auto& b) { for_each_bond(b, i, which, visit); }, bonds);
}

/// Bonds of a grid; `beyond[2 axis + upper]` says what lies beyond each face. Every periodic image in
/// reach counts, also several of one particle. A ghost exists where its mirror image does.
/// Cost O(particles * family) bits and time. Throws invalid_input if one side of an axis only is periodic.
template <int Dim>
[[nodiscard]] GridBonds<Dim> make_grid_bonds(const Particles<Dim>& particles, Family<Dim> family,
                                             const std::array<Beyond, 2 * Dim>& beyond);

/// Distance to the n-th nearest other particle, m, for every particle of a cloud. Along axes with a `period`
/// > 0 (m) images count: exact as long as the distance is below half the period, and never below it where the
/// true one is not, so that make_cloud_bonds refuses it.
template <int Dim>
[[nodiscard]] std::vector<double> cloud_horizons(const Particles<Dim>& particles, int neighbours,
                                                 const Point<Dim>& period = Point<Dim>::Zero());

/// Bonds of a cloud: i and j are bonded if |xi| <= max(delta_i, delta_j) (1 + 1e-9); the pair's
/// horizon is the mean. `linear` extends by half the pair's mean cell size (volume/section)^(1/Dim)
/// and weights as on a grid. Along axes with a `period` > 0 (m) the cloud repeats itself; the particles lie
/// within one period. Throws invalid_input where a period is not above twice the longest reach, since a pair
/// could then have two bonds. Cost O(n log n + bonds).
template <int Dim>
[[nodiscard]] CloudBonds<Dim> make_cloud_bonds(const Particles<Dim>& particles,
                                               const std::vector<double>& horizon,
                                               VolumeCorrection correction, double section,
                                               const Point<Dim>& period = Point<Dim>::Zero());

/// Cuts every bond that crosses one of the cracks; they are repeated in a grid's walls and in periodic
/// images first. Returns the number of bonds cut (a bond counts once). `spacing` scales the
/// tolerance 1e-9.
template <int Dim>
Offset cut_bonds(Bonds<Dim>& bonds, const Particles<Dim>& particles, const std::vector<Crack<Dim>>& cracks,
                 double spacing);

/// Takes the force out of one bond: clears its bit at both ends. An absent or broken bond is left alone.
template <int Dim>
void break_bond(Bonds<Dim>& bonds, Index i, Offset slot);

/// Alive bonds, each counted once; a bond to a ghost counts as one.
template <int Dim>
[[nodiscard]] Offset count_bonds(const Bonds<Dim>& bonds, Index particles);

/// Number of ghosts (0 for clouds).
template <int Dim>
[[nodiscard]] Index ghost_count(const Bonds<Dim>& bonds) {
  const auto* grid = std::get_if<GridBonds<Dim>>(&bonds);
  return grid ? static_cast<Index>(grid->ghosts.size()) : 0;
}

/// The particle whose properties (volume, block, calibration) a bond partner has: itself, or its image.
template <int Dim>
[[nodiscard]] Index owner(const Bonds<Dim>& bonds, Index partner, Index particles) {
  return partner < particles ? partner : std::get<GridBonds<Dim>>(bonds).ghosts[partner - particles].image;
}

}  // namespace perimode
