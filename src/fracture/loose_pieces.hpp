// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "fracture/equilibrium.hpp"
#include "perimode/assembly/body.hpp"
#include "perimode/assembly/breakable_stiffness.hpp"

namespace perimode {

/// Finds what breaks leave behind without shape or support.
template <int Dim>
class LooseSearch {
 public:
  explicit LooseSearch(const Body<Dim>& body) : seen_(static_cast<std::size_t>(body.count()), 0) {}

  /// Free dofs of particle i that its alive bonds and its pins do not hold: as many as its own Dim x Dim
  /// block has vanishing eigenvalues. Empty for most. Cost O(family).
  [[nodiscard]] static std::vector<Index> unheld_dofs(const Body<Dim>& body,
                                                      const Equilibrium<Dim>& equilibrium, Index i);

  /// The particles that no alive bond ties to the others any more since the bond of i and j broke: the first
  /// of the two sides that a search from both ends, in turn, finds the end of; ascending. Empty: still tied.
  /// Cost: that side, or the way round.
  [[nodiscard]] std::vector<Index> cut_off(const Body<Dim>& body, Index i, Index j);

 private:
  std::vector<int> seen_;  ///< the search that last came by, and from which end
  int search_ = 0;
};

/// A piece that may move without stretching a bond, and a dof for each of its motions.
struct LooseMotion {
  std::vector<Index> particles;  ///< ascending
  std::vector<Index> dofs;       ///< free dofs that hold it: those in which its motions differ most
};

/// The pieces that supports and pins leave a rigid motion. Cost: as rigid_modes.
template <int Dim>
[[nodiscard]] std::vector<LooseMotion> loose_motions(const Body<Dim>& body,
                                                     const Equilibrium<Dim>& equilibrium,
                                                     const Eigen::VectorXd& mass);

/// One row per column in which the columns differ most.
[[nodiscard]] std::vector<Index> pivot_dofs(const Eigen::MatrixXd& motions);

}  // namespace perimode
