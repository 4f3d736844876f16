// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "perimode/assembly/assemble.hpp"
#include "perimode/linalg/factor.hpp"

namespace perimode::test {

using Pair = std::array<Index, 2>;  ///< a bond by its particles, the lower one first

/// What breaks at one event, at which load factor, and the strain energy (J) just before.
struct PathEvent {
  double factor = 0.0;
  double energy = 0.0;
  std::vector<Pair> bonds;  ///< ascending
};

/// Displacements of all particle dofs at load factor 1, or nothing where no equilibrium exists. Everything is
/// made anew: matrix, order, factor. The factor is that of K + e I, e so small that solutions with the
/// residual as right-hand side converge to that of K at once; motions that cost no energy (of a particle
/// that hangs by one bond, of a free body) stay zero, and loads that work along them show as a residual that
/// does not fall.
template <int Dim>
std::vector<double> solve_afresh(const Body<Dim>& body, const Eigen::VectorXd& load) {
  const BlockCsr blocks = assemble_stiffness(body);
  const BoundaryMap<Dim>& map = body.boundary;
  const Csr k = scalar_csr(blocks, map.free_number);
  std::vector<double> force(map.given.size());
  multiply(blocks, map.given, force);  // K g, given values in full
  Eigen::VectorXd b(map.free);
  for (std::size_t d = 0; d < force.size(); ++d)
    if (map.free_number[d] >= 0) b[map.free_number[d]] = load[static_cast<Eigen::Index>(d)] - force[d];
  CholeskyFactor factor = CholeskyFactor::with_order(k, fill_reducing_order(k, particle_of_free_dof(body)));
  const double shift = 1e-10 * norm_inf(k);
  if (factor.factorize(k, -shift, Eigen::VectorXd::Ones(map.free)) != FactorStatus::done) return {};
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(map.free, 1);
  double residual = 1.0;
  for (int round = 0; round < 12; ++round) {
    const Eigen::MatrixXd r = b - multiply(k, x);
    residual = r.norm() / b.norm();
    x += factor.solve(r);
  }
  if (!(residual < 1e-9)) return {};
  return map.expand(x.data());
}

/// The event-driven path by brute force, from nothing but the assembled matrix: solve afresh, find the bond
/// of the largest stretch, break it and all within 1e-6 of it. Ends where no equilibrium is left, where the
/// energy at load factor 1 has fallen to round-off (given motion), or after `most` events. Bodies without
/// ghosts, bonds with an end in `no_fail` do not break.
template <int Dim>
std::vector<PathEvent> brute_force_path(Body<Dim> body, const Eigen::VectorXd& load, double critical_stretch,
                                        const std::vector<Index>& no_fail = {},
                                        std::size_t most = std::numeric_limits<std::size_t>::max()) {
  struct Candidate {
    double stretch;
    Index i;
    Offset slot;
    Pair pair;
  };
  std::vector<PathEvent> path;
  double first_energy = 0.0;
  while (path.size() < most) {
    const std::vector<double> u = solve_afresh(body, load);
    if (u.empty()) break;
    const Eigen::Map<const Eigen::VectorXd> field(u.data(), static_cast<Eigen::Index>(u.size()));
    const double energy = bond_energy(body, Eigen::MatrixXd(field))[0];
    if (path.empty()) first_energy = energy;
    if (energy < 1e-20 * first_energy) break;
    std::vector<Candidate> stretched;
    double largest = 0.0;
    for (Index i = 0; i < body.count(); ++i) {
      if (std::binary_search(no_fail.begin(), no_fail.end(), i)) continue;
      for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
        if (end.neighbour < i || std::binary_search(no_fail.begin(), no_fail.end(), end.neighbour)) return;
        const Point<Dim> eta =
            field.template segment<Dim>(Dim * end.neighbour) - field.template segment<Dim>(Dim * i);
        const double stretch = end.xi.dot(eta) / end.xi.squaredNorm();
        if (stretch < largest * (1.0 - 1e-6)) return;
        largest = std::max(largest, stretch);
        stretched.push_back({stretch, i, end.slot, {i, end.neighbour}});
      });
    }
    if (largest <= 0.0) break;
    PathEvent event;
    event.factor = critical_stretch / largest;
    event.energy = event.factor * event.factor * energy;
    for (const Candidate& bond : stretched) {
      if (bond.stretch < largest * (1.0 - 1e-6)) continue;
      event.bonds.push_back(bond.pair);
      break_bond(body.bonds, bond.i, bond.slot);
    }
    std::sort(event.bonds.begin(), event.bonds.end());
    path.push_back(std::move(event));
  }
  return path;
}

}  // namespace perimode::test
