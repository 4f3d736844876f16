// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/assembly/bond_limits.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "bond_ends.hpp"
#include "bond_stretch.hpp"

namespace perimode {

namespace {

constexpr double round_off = 1e-12;

/// Calls visit(i, end) for every alive bond of a chunk, those between particles from one end alone.
template <int Dim, class Visit>
void for_each_of_chunk(const Body<Dim>& body, Index number, const Visit& visit) {
  const Index first = number * stretch_chunk;
  const Index last = std::min(body.count(), first + stretch_chunk);
  const auto* grid = std::get_if<GridBonds<Dim>>(&body.bonds);
  for (Index i = first; i < last; ++i) {
    for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
      const bool lower = grid ? 2 * end.slot >= grid->family.size() : end.neighbour > i;
      if (lower || end.neighbour >= body.count()) visit(i, end);
    });
  }
}

/// Sums per chunk, as grid_stretches.
template <int Dim>
std::vector<StretchSums> stretches(const Body<Dim>& body, const BondLimits& limits,
                                   const Eigen::VectorXd* u_0, const Eigen::VectorXd& u_1) {
  if (std::holds_alternative<GridBonds<Dim>>(body.bonds)) return grid_stretches(body, limits, u_0, u_1);
  const InverseLimit<Dim> inverse(body, limits);
  const Index chunks = (body.count() + stretch_chunk - 1) / stretch_chunk;
  std::vector<StretchSums> sums(static_cast<std::size_t>(chunks));
#pragma omp parallel for schedule(static) if (chunks > 4)
  for (Index c = 0; c < chunks; ++c) {
    StretchSums mine;
    for_each_of_chunk(body, c, [&](Index i, const BondEnd<Dim>& end) {
      add_stretch(body, inverse, i, end, u_0, u_1, mine);
    });
    sums[static_cast<std::size_t>(c)] = mine;
  }
  return sums;
}

StretchSums total(const std::vector<StretchSums>& chunks) {
  StretchSums sum;
  for (const StretchSums& c : chunks) sum.add(c);
  return sum;
}

struct Ratio {
  double value;
  BondRef bond;
};

/// Bonds of s/s_c >= least, found in the chunks that hold one (to round-off).
template <int Dim>
std::vector<Ratio> collect(const Body<Dim>& body, const BondLimits& limits, const Eigen::VectorXd& u,
                           const std::vector<StretchSums>& chunks, double least) {
  const InverseLimit<Dim> inverse(body, limits);
  std::vector<Ratio> bonds;
  for (std::size_t c = 0; c < chunks.size(); ++c) {
    if (chunks[c].worst < least * (1.0 - round_off)) continue;
    for_each_of_chunk(body, static_cast<Index>(c), [&](Index i, const BondEnd<Dim>& end) {
      const double ratio = elongation(body, i, end, u) * (inverse(i, end) / end.length);
      if (ratio >= least) bonds.push_back({ratio, {i, end.slot}});
    });
  }
  return bonds;
}

std::vector<BondRef> refs(const std::vector<Ratio>& ratios) {
  std::vector<BondRef> bonds;
  bonds.reserve(ratios.size());
  for (const Ratio& r : ratios) bonds.push_back(r.bond);
  return bonds;
}

/// The ratios in descending order, a bond and its image taken as one.
template <int Dim>
std::vector<double> of_pairs(const Body<Dim>& body, std::vector<Ratio> bonds) {
  for (Ratio& r : bonds) r.bond = std::min(r.bond, wall_image(body, r.bond).value_or(r.bond));
  std::sort(bonds.begin(), bonds.end(), [](const Ratio& a, const Ratio& b) {
    return a.bond < b.bond || (a.bond == b.bond && a.value > b.value);
  });
  std::vector<double> ratio;
  for (std::size_t b = 0; b < bonds.size(); ++b)
    if (b == 0 || !(bonds[b].bond == bonds[b - 1].bond)) ratio.push_back(bonds[b].value);
  std::sort(ratio.begin(), ratio.end(), std::greater<>());
  return ratio;
}

}  // namespace

template <int Dim>
FirstBreak first_break(const Body<Dim>& body, const BondLimits& limits, const Eigen::VectorXd& u_0,
                       const Eigen::VectorXd& u_1, double tie) {
  FirstBreak result;
  const double share = 1.0 - std::max(tie, round_off);
  if (u_0.size() == 0) {  // s = lambda s_1: the bond of the largest s_1/s_c is the first
    const auto chunks = stretches(body, limits, nullptr, u_1);
    const StretchSums sum = total(chunks);
    result.energy = sum.energy;
    result.factor = sum.worst > 0.0 ? 1.0 / sum.worst : infinity;
    result.worst = sum.worst > 0.0 ? 1.0 : 0.0;
    if (sum.worst > 0.0)
      result.bonds = with_images(body, refs(collect(body, limits, u_1, chunks, share * sum.worst)));
    return result;
  }
  const StretchSums sum = total(stretches(body, limits, &u_0, u_1));
  result.factor = sum.factor;
  result.energy = sum.energy;
  const bool breaks = sum.factor < infinity;
  const Eigen::VectorXd u = breaks ? Eigen::VectorXd(u_0 + sum.factor * u_1) : u_0;
  const auto chunks = stretches(body, limits, nullptr, u);
  result.worst = total(chunks).worst;
  if (breaks) result.bonds = with_images(body, refs(collect(body, limits, u, chunks, share)));
  return result;
}

template <int Dim>
OverstretchedBonds overstretched(const Body<Dim>& body, const BondLimits& limits,
                                 const Eigen::VectorXd& displacement, Index most, double tie) {
  OverstretchedBonds result;
  const auto chunks = stretches(body, limits, nullptr, displacement);
  const StretchSums sum = total(chunks);
  result.worst = sum.worst;
  result.energy = sum.energy[2];
  auto bonds = collect(body, limits, displacement, chunks, std::nextafter(1.0 + round_off, 2.0));
  if (most > 0) {
    const std::vector<double> ratio = of_pairs(body, bonds);
    if (ratio.size() > static_cast<std::size_t>(most)) {
      const double least = ratio[static_cast<std::size_t>(most) - 1] * (1.0 - std::max(tie, round_off));
      std::erase_if(bonds, [&](const Ratio& r) { return r.value < least; });
    }
  }
  result.bonds = with_images(body, refs(bonds));
  return result;
}

template <int Dim>
std::vector<BondState> bond_states(const Body<Dim>& body, std::span<const BondRef> bonds,
                                   const Eigen::VectorXd& displacement) {
  std::vector<BondState> states;
  states.reserve(bonds.size());
  for (const BondRef& bond : bonds) {
    const BondEnd<Dim> end = bond_end(body, bond);
    states.push_back({bond_stiffness(body, bond.particle, end),
                      elongation(body, bond.particle, end, displacement), share_of(body, end)});
  }
  return states;
}

#define PERIMODE_BOND_LIMITS(D)                                                                           \
  template FirstBreak first_break<D>(const Body<D>&, const BondLimits&, const Eigen::VectorXd&,           \
                                     const Eigen::VectorXd&, double);                                     \
  template OverstretchedBonds overstretched<D>(const Body<D>&, const BondLimits&, const Eigen::VectorXd&, \
                                               Index, double);                                            \
  template std::vector<BondState> bond_states<D>(const Body<D>&, std::span<const BondRef>,                \
                                                 const Eigen::VectorXd&)
PERIMODE_BOND_LIMITS(1);
PERIMODE_BOND_LIMITS(2);
PERIMODE_BOND_LIMITS(3);
#undef PERIMODE_BOND_LIMITS

}  // namespace perimode
