// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "bond_kernels.hpp"
#include "perimode/assembly/body.hpp"
#include "perimode/linalg/row_product.hpp"

namespace perimode {

/// Displacements that are given, at an instant.
template <int Dim>
struct GivenMotion {
  std::vector<double> dof;          ///< per dof of a particle, m
  std::vector<double> ghost;        ///< per component of a ghost, m
  std::vector<std::size_t> moving;  ///< dofs that vary in time, ascending
};

/// Share of a bond's energy that belongs to the body where its partner is a ghost.
template <int Dim>
[[nodiscard]] double ghost_share(const BoundaryMap<Dim>& map, Index ghost) {
  const auto first = map.coefficient.begin() + static_cast<std::ptrdiff_t>(ghost) * Dim;
  return std::all_of(first, first + Dim, [](double c) { return c == 0.0; }) ? 1.0 : 0.5;
}

/// Forces and energies of all bonds of a body: a grid's or a cloud's.
template <int Dim>
class BondEvaluation {
 public:
  virtual ~BondEvaluation() = default;
  [[nodiscard]] virtual Index pieces() const = 0;
  /// Hands out the internal force, writes that on moving dofs, and returns the bonds beyond their critical
  /// stretch, from one end or both, in an order that does not depend on the number of threads.
  virtual const std::vector<OverStretched>& forces(const GivenMotion<Dim>& given, const double* q,
                                                   const std::function<void(const RowPiece&)>& take,
                                                   double* moving_force) = 0;
  virtual double energy(const GivenMotion<Dim>& given, const double* q) = 0;
  /// eta of a bond at the last displacements.
  [[nodiscard]] virtual Point<Dim> relative(Index i, const BondEnd<Dim>& end) const = 0;
};

/// `measure`: critical measure over |xi|^2 per block. Cost O(bond ends).
template <int Dim>
[[nodiscard]] std::unique_ptr<BondEvaluation<Dim>> make_bond_evaluation(const Body<Dim>& body, bool turning,
                                                                        const std::vector<double>& measure,
                                                                        const std::vector<Index>& no_fail);

}  // namespace perimode
