// SPDX-License-Identifier: BSD-3-Clause
#include "bond_ends.hpp"

#include <algorithm>

#include "bond_evaluation.hpp"
#include "bonds/partner_slot.hpp"

namespace perimode {

namespace {

template <int Dim>
BondEnd<Dim> end_of(const GridBonds<Dim>& bonds, const BondRef& bond) {
  const Family<Dim>& f = bonds.family;
  const auto k = static_cast<std::size_t>(bond.slot);
  Point<Dim> xi;
  for (int a = 0; a < Dim; ++a) xi[a] = f.spacing * f.offset[k][a];
  return {bonds.occupant[bonds.home[bond.particle] + bonds.step[k]],
          xi,
          f.length[k],
          f.weight[k],
          f.horizon,
          bond.slot};
}
template <int Dim>
BondEnd<Dim> end_of(const CloudBonds<Dim>& bonds, const BondRef& bond) {
  const auto e = static_cast<std::size_t>(bond.slot);
  return {bonds.neighbour[e], bonds.xi[e], bonds.xi[e].norm(), bonds.weight[e], bonds.horizon[e], bond.slot};
}

}  // namespace

template <int Dim>
BondEnd<Dim> bond_end(const Body<Dim>& body, const BondRef& bond) {
  return std::visit([&](const auto& bonds) { return end_of(bonds, bond); }, body.bonds);
}

template <int Dim>
bool alive(const Body<Dim>& body, const BondRef& bond) {
  return std::visit([&](const auto& bonds) { return is_alive(bonds, bond.particle, bond.slot); }, body.bonds);
}

template <int Dim>
std::optional<BondRef> other_end(const Body<Dim>& body, const BondRef& bond) {
  const Index j = bond_end(body, bond).neighbour;
  if (j >= body.count()) return std::nullopt;
  return BondRef{
      j, std::visit([&](const auto& bonds) { return partner_slot(bonds, bond.particle, j, bond.slot); },
                    body.bonds)};
}

template <int Dim>
std::optional<BondRef> wall_image(const Body<Dim>& body, const BondRef& bond) {
  const Index ghost = bond_end(body, bond).neighbour - body.count();
  if (ghost < 0 || ghost_share(body.boundary, ghost) == 1.0) return std::nullopt;
  const auto& bonds = std::get<GridBonds<Dim>>(body.bonds);
  const Ghost<Dim>& g = bonds.ghosts[static_cast<std::size_t>(ghost)];
  const auto& offset = bonds.family.offset[static_cast<std::size_t>(bond.slot)];
  Index step = 0;
  Index stride = 1;
  for (int a = 0; a < Dim; ++a) {
    const bool flipped = (g.crossings[2 * a] + g.crossings[2 * a + 1]) % 2 == 1;
    step += (flipped ? offset[a] : -offset[a]) * stride;
    stride *= bonds.padded[a];
  }
  // Steps ascend with the family, which holds every reflected offset.
  return BondRef{g.image, std::lower_bound(bonds.step.begin(), bonds.step.end(), step) - bonds.step.begin()};
}

#define PERIMODE_BOND_ENDS(D)                                                   \
  template BondEnd<D> bond_end<D>(const Body<D>&, const BondRef&);              \
  template bool alive<D>(const Body<D>&, const BondRef&);                       \
  template std::optional<BondRef> other_end<D>(const Body<D>&, const BondRef&); \
  template std::optional<BondRef> wall_image<D>(const Body<D>&, const BondRef&)
PERIMODE_BOND_ENDS(1);
PERIMODE_BOND_ENDS(2);
PERIMODE_BOND_ENDS(3);
#undef PERIMODE_BOND_ENDS

}  // namespace perimode
