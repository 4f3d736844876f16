// SPDX-License-Identifier: BSD-3-Clause
#include "partner_slot.hpp"
#include "perimode/bonds/bonds.hpp"
#include "perimode/bonds/crossing.hpp"

namespace perimode {

namespace {

template <int Dim>
void clear_bit(GridBonds<Dim>& bonds, Index i, Offset slot) {
  bonds.alive[static_cast<std::size_t>(i) * bonds.words + slot / 64] &= ~(std::uint64_t{1} << (slot % 64));
}
template <int Dim>
void clear_bit(CloudBonds<Dim>& bonds, Index, Offset slot) {
  bonds.alive[slot / 64] &= ~(std::uint64_t{1} << (slot % 64));
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
  const Offset before = count_bonds(bonds, particles.count());
  const auto ends = crossing_ends(bonds, particles, cracks, spacing);
  std::visit(
      [&](auto& b) {
        for (const CrossingEnd& end : ends) clear_bit(b, end.particle, end.slot);
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
