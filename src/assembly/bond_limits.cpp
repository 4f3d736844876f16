// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/assembly/bond_limits.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "bond_ends.hpp"
#include "bond_evaluation.hpp"

namespace perimode {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double round_off = 1e-12;
constexpr Index chunk = 256;  ///< particles whose sums are one number, so that threads do not matter

/// 1/s_c of bonds; 0: unbreakable.
template <int Dim>
class Inverse {
 public:
  Inverse(const Body<Dim>& body, const BondLimits& limits) : body_(body), limits_(limits) {}

  [[nodiscard]] double operator()(Index i, const BondEnd<Dim>& end) const {
    const Index j = owner(body_.bonds, end.neighbour, body_.count());
    if (!limits_.no_fail.empty() && (limits_.no_fail[i] != 0 || limits_.no_fail[j] != 0)) return 0.0;
    const auto& block = body_.particles.block;
    return 1.0 / std::min(limits_.critical_stretch[block[i]], limits_.critical_stretch[block[j]]);
  }

 private:
  const Body<Dim>& body_;
  const BondLimits& limits_;
};

template <int Dim>
bool lower_end(const GridBonds<Dim>& bonds, Index, const BondEnd<Dim>& end) {
  return 2 * end.slot > bonds.family.size() - 1;
}
template <int Dim>
bool lower_end(const CloudBonds<Dim>&, Index i, const BondEnd<Dim>& end) {
  return end.neighbour > i;
}

/// Elongation n . (u_j - u_i).
template <int Dim>
double elongation(const Body<Dim>& body, Index i, const BondEnd<Dim>& end, const Eigen::VectorXd& u) {
  const Point<Dim> other = partner_displacement(body.boundary, u.data(), end.neighbour, body.count(), false);
  return (end.xi / end.length).dot(other - u.segment<Dim>(static_cast<Eigen::Index>(i) * Dim));
}

template <int Dim>
double share_of(const Body<Dim>& body, const BondEnd<Dim>& end) {
  return end.neighbour < body.count() ? 1.0 : ghost_share(body.boundary, end.neighbour - body.count());
}

/// Calls visit(i, end) for every alive bond of a chunk, those between particles from one end alone.
template <int Dim, class Visit>
void for_each_of_chunk(const Body<Dim>& body, Index number, const Visit& visit) {
  std::visit(
      [&](const auto& bonds) {
        const Index last = std::min(body.count(), (number + 1) * chunk);
        for (Index i = number * chunk; i < last; ++i) {
          for_each_bond(bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
            if (end.neighbour >= body.count() || lower_end(bonds, i, end)) visit(i, end);
          });
        }
      },
      body.bonds);
}

/// What a chunk of particles came to.
struct Found {
  double factor = infinity;
  double worst = -infinity;
  std::array<double, 3> energy = {};
};

template <int Dim, class Visit>
std::vector<Found> over_chunks(const Body<Dim>& body, const Visit& visit) {
  const Index chunks = (body.count() + chunk - 1) / chunk;
  std::vector<Found> found(static_cast<std::size_t>(chunks));
#pragma omp parallel for schedule(static)
  for (Index c = 0; c < chunks; ++c) {
    Found mine;
    for_each_of_chunk(body, c, [&](Index i, const BondEnd<Dim>& end) { visit(i, end, mine); });
    found[static_cast<std::size_t>(c)] = mine;
  }
  return found;
}

struct Ratio {
  double value;
  BondRef bond;
};

/// Bonds of s/s_c >= least, found in the chunks that hold one.
template <int Dim>
std::vector<Ratio> collect(const Body<Dim>& body, const Inverse<Dim>& inverse, const Eigen::VectorXd& u,
                           const std::vector<Found>& found, double least) {
  std::vector<Ratio> bonds;
  for (std::size_t c = 0; c < found.size(); ++c) {
    if (found[c].worst < least) continue;
    for_each_of_chunk(body, static_cast<Index>(c), [&](Index i, const BondEnd<Dim>& end) {
      const double ratio = elongation(body, i, end, u) / end.length * inverse(i, end);
      if (ratio >= least) bonds.push_back({ratio, {i, end.slot}});
    });
  }
  return bonds;
}

/// Largest s/s_c and energy per chunk.
template <int Dim>
std::vector<Found> stretches(const Body<Dim>& body, const Inverse<Dim>& inverse, const Eigen::VectorXd& u) {
  return over_chunks(body, [&](Index i, const BondEnd<Dim>& end, Found& mine) {
    const double e = elongation(body, i, end, u);
    const double v = inverse(i, end);
    if (v > 0.0) mine.worst = std::max(mine.worst, e / end.length * v);
    mine.energy[2] += 0.5 * share_of(body, end) * bond_stiffness(body, i, end) * (e * e);
  });
}

double worst_of(const std::vector<Found>& found) {
  double worst = -infinity;
  for (const Found& f : found) worst = std::max(worst, f.worst);
  return worst;
}

template <class Bonds>
std::vector<BondRef> refs(const Bonds& ratios) {
  std::vector<BondRef> bonds;
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
  const Inverse<Dim> inverse(body, limits);
  const bool both = u_0.size() > 0;
  FirstBreak result;
  result.factor = infinity;
  const auto found = over_chunks(body, [&](Index i, const BondEnd<Dim>& end, Found& mine) {
    const double e_0 = both ? elongation(body, i, end, u_0) : 0.0;
    const double e_1 = elongation(body, i, end, u_1);
    const double q = inverse(i, end) / end.length;
    if (q * e_1 > 0.0) mine.factor = std::min(mine.factor, (1.0 - q * e_0) / (q * e_1));
    const double half = 0.5 * share_of(body, end) * bond_stiffness(body, i, end);
    mine.energy[0] += half * (e_0 * e_0);
    mine.energy[1] += half * (e_0 * e_1);
    mine.energy[2] += half * (e_1 * e_1);
  });
  for (const Found& f : found) {
    result.factor = std::min(result.factor, f.factor);
    for (std::size_t e = 0; e < 3; ++e) result.energy[e] += f.energy[e];
  }
  const bool breaks = result.factor < infinity;
  Eigen::VectorXd u = breaks ? Eigen::VectorXd(result.factor * u_1) : Eigen::VectorXd::Zero(u_1.size());
  if (both) u += u_0;
  const auto at = stretches(body, inverse, u);
  result.worst = worst_of(at);
  if (breaks)
    result.bonds = with_images(body, refs(collect(body, inverse, u, at, 1.0 - std::max(tie, round_off))));
  return result;
}

template <int Dim>
OverstretchedBonds overstretched(const Body<Dim>& body, const BondLimits& limits,
                                 const Eigen::VectorXd& displacement, Index most, double tie) {
  const Inverse<Dim> inverse(body, limits);
  OverstretchedBonds result;
  const auto found = stretches(body, inverse, displacement);
  result.worst = std::max(0.0, worst_of(found));
  for (const Found& f : found) result.energy += f.energy[2];
  auto bonds = collect(body, inverse, displacement, found, std::nextafter(1.0 + round_off, 2.0));
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
