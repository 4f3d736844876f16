// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
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

/// Share of a bond's energy that belongs to the body where its partner is a ghost: half where the ghost
/// follows particles, all where it stands still.
template <int Dim>
[[nodiscard]] double ghost_share(const BoundaryMap<Dim>& map, Index ghost) {
  double share = 1.0;
  for_each_image(map, static_cast<std::size_t>(ghost), [&](Index, const double*) { share = 0.5; });
  return share;
}

/// What an evaluation is asked for.
struct BondRequest {
  const std::function<void(const RowPiece&)>* take = nullptr;  ///< the internal force
  double* moving_force = nullptr;                              ///< on GivenMotion::moving
  bool energy = false;
};

/// Forces and energies of all bonds of a body: a grid's or a cloud's.
template <int Dim>
class BondEvaluation {
 public:
  virtual ~BondEvaluation() = default;
  [[nodiscard]] virtual Index pieces() const = 0;
  /// Does what is asked and returns the bonds beyond their critical stretch, from one end or both, in an
  /// order that does not depend on the number of threads.
  virtual const std::vector<OverStretched>& forces(const GivenMotion<Dim>& given, const double* q,
                                                   const BondRequest& request) = 0;
  /// Energy of the bonds that were not returned, if it was asked for, J: every end counts its share.
  [[nodiscard]] virtual double energy() const = 0;
  /// eta of a bond at the last displacements.
  [[nodiscard]] virtual Point<Dim> relative(Index i, const BondEnd<Dim>& end) const = 0;
};

/// `measure`: critical measure over |xi|^2 per block. Cost O(bond ends).
template <int Dim>
[[nodiscard]] std::unique_ptr<BondEvaluation<Dim>> make_grid_evaluation(const Body<Dim>& body, bool turning,
                                                                        const std::vector<double>& measure,
                                                                        const std::vector<Index>& no_fail);
template <int Dim>
[[nodiscard]] std::unique_ptr<BondEvaluation<Dim>> make_cloud_evaluation(const Body<Dim>& body, bool turning,
                                                                         const std::vector<double>& measure,
                                                                         const std::vector<Index>& no_fail);

}  // namespace perimode
