// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include "bond_evaluation.hpp"
#include "perimode/assembly/bond_limits.hpp"
#include "stretch_kernels.hpp"

namespace perimode {

/// Particles whose sums are one number, so that threads do not matter.
constexpr Index stretch_chunk = 256;

/// 1/s_c of bonds; 0: unbreakable.
template <int Dim>
class InverseLimit {
 public:
  InverseLimit(const Body<Dim>& body, const BondLimits& limits) : body_(body), limits_(limits) {}

  [[nodiscard]] double operator()(Index i, const BondEnd<Dim>& end) const {
    const Index j = owner(body_.bonds, end.neighbour, body_.count());
    if (protects(i) || protects(j)) return 0.0;
    return std::max(of(i), of(j));
  }
  [[nodiscard]] double of(Index i) const {
    return 1.0 / limits_.critical_stretch[static_cast<std::size_t>(body_.particles.block[i])];
  }
  [[nodiscard]] bool protects(Index i) const { return !limits_.no_fail.empty() && limits_.no_fail[i] != 0; }

 private:
  const Body<Dim>& body_;
  const BondLimits& limits_;
};

/// Elongation n . (u_j - u_i).
template <int Dim>
[[nodiscard]] double elongation(const Body<Dim>& body, Index i, const BondEnd<Dim>& end,
                                const Eigen::VectorXd& u) {
  const Point<Dim> other = partner_displacement(body.boundary, u.data(), end.neighbour, body.count(), false);
  return (end.xi / end.length).dot(other - u.segment<Dim>(static_cast<Eigen::Index>(i) * Dim));
}

/// Share of the bond's energy that is the body's.
template <int Dim>
[[nodiscard]] double share_of(const Body<Dim>& body, const BondEnd<Dim>& end) {
  return end.neighbour < body.count() ? 1.0 : ghost_share(body.boundary, end.neighbour - body.count());
}

/// One bond, as the kernels count it.
template <int Dim>
void add_stretch(const Body<Dim>& body, const InverseLimit<Dim>& inverse, Index i, const BondEnd<Dim>& end,
                 const Eigen::VectorXd* u_0, const Eigen::VectorXd& u_1, StretchSums& sums) {
  const double e_1 = elongation(body, i, end, u_1);
  const double rate = inverse(i, end) / end.length;
  const double stiffness = share_of(body, end) * bond_stiffness(body, i, end);
  const double force = stiffness * e_1;
  sums.energy[2] += 0.5 * force * e_1;
  if (u_0 == nullptr) {
    sums.worst = std::max(sums.worst, rate * e_1);
    return;
  }
  const double e_0 = elongation(body, i, end, *u_0);
  if (rate * e_1 > 0.0) sums.factor = std::min(sums.factor, (1.0 - rate * e_0) / (rate * e_1));
  sums.energy[1] += 0.5 * force * e_0;
  sums.energy[0] += 0.5 * stiffness * (e_0 * e_0);
}

/// Sums per chunk of particles over the bonds of a grid, those between particles from their lower end. With
/// u_0 the factor and all energies, without it the worst and energy[2]. Cost O(bonds).
template <int Dim>
[[nodiscard]] std::vector<StretchSums> grid_stretches(const Body<Dim>& body, const BondLimits& limits,
                                                      const Eigen::VectorXd* u_0, const Eigen::VectorXd& u_1);

}  // namespace perimode
