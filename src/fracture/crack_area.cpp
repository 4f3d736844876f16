// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/fracture/crack_area.hpp"

#include <cmath>

#include "assembly/bond_evaluation.hpp"
#include "perimode/assembly/precracks.hpp"
#include "perimode/fracture/griffith.hpp"

namespace perimode {

namespace {

/// Sum of V V beta over the bonds across a lattice plane, per unit of it: offset o crosses it |o_x| times per
/// line of cells.
template <int Dim>
double lattice_norm(const Body<Dim>& body, const Family<Dim>& family) {
  const double volume = body.particles.volume[0];
  double sum = 0.0;
  for (std::size_t k = 0; k < family.offset.size(); ++k)
    if (family.offset[k][0] > 0) sum += family.offset[k][0] * family.weight[k];
  return sum * volume * volume / std::pow(family.spacing, Dim - 1);
}

template <int Dim>
double continuum_norm(double section, double horizon) {
  const double directions = Dim == 1 ? 2.0 : (Dim == 2 ? 4.0 : 6.283185307179586);  // S <|cos|>
  return 0.5 * section * section * directions * std::pow(horizon, Dim + 1) / (Dim + 1);
}

}  // namespace

template <int Dim>
CrackAreaScale crack_area_scale(const Model& model, const Body<Dim>& body) {
  CrackAreaScale scale;
  if (const auto* grid = std::get_if<GridBonds<Dim>>(&body.bonds)) {
    scale.horizon = grid->family.horizon;
    scale.norm = lattice_norm(body, grid->family);
  } else {
    scale.norm = continuum_norm<Dim>(body.section, scale.horizon);
  }
  for (const auto& crack : precracks<Dim>(model)) scale.initial += extent(crack);
  return scale;
}

template <int Dim>
double crack_area(const Body<Dim>& body, const CrackAreaScale& scale, std::span<const BondRef> bonds) {
  double sum = 0.0;
  for (const BondRef& bond : bonds) {
    const BondEnd<Dim> end = bond_end(body, bond);
    const Index partner = owner(body.bonds, end.neighbour, body.count());
    const double share =
        end.neighbour < body.count() ? 1.0 : ghost_share(body.boundary, end.neighbour - body.count());
    sum += share * body.particles.volume[bond.particle] * body.particles.volume[partner] * end.weight /
           (scale.norm * std::pow(end.horizon / scale.horizon, Dim + 1));
  }
  return sum;
}

#define PERIMODE_CRACK_AREA(D)                                               \
  template CrackAreaScale crack_area_scale<D>(const Model&, const Body<D>&); \
  template double crack_area<D>(const Body<D>&, const CrackAreaScale&, std::span<const BondRef>)
PERIMODE_CRACK_AREA(1);
PERIMODE_CRACK_AREA(2);
PERIMODE_CRACK_AREA(3);
#undef PERIMODE_CRACK_AREA

}  // namespace perimode
