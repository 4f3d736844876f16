// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "perimode/assembly/bond_limits.hpp"
#include "perimode/dynamics/motion.hpp"
#include "perimode/fracture/quasistatic.hpp"

namespace perimode {

/// A state of equilibrium of the body as it is.
struct EquilibriumState {
  Eigen::VectorXd displacement;  ///< of all particle dofs, m
  /// External force on every particle dof, N: loads and springs on free dofs, the reaction on given ones that
  /// move.
  Eigen::VectorXd external;
  double along = 0.0;   ///< displacement of the curve, m
  double force = 0.0;   ///< and the force that works along it, N
  double stored = 0.0;  ///< strain energy, J
};

/// Energies along the chords from each state to the next, the body without bonds that broke at the first of
/// the two. On a chord the external forces change linearly, and so do the forces that the broken bonds leave
/// behind, from those they had to none; so
///   work of external forces  (1/2)(f_n + f_n+1) . (u_n+1 - u_n),
///   released                 sum of (1/2) k e_n^2 over the bonds that broke,
///   relaxation               sum of (1/2) k e_n (e_n+1 - e_n) over them,
///   stored_n+1 - stored_n = work - released - relaxation
/// exactly, each term from other numbers. docs/theory/14_quasistatic.md.
class FractureLedger {
 public:
  /// Goes along the chord to a state; `broken` are the bonds given to `leave` last, as they are at it.
  void reach(EquilibriumState state, const std::vector<BondState>& broken);
  /// Bonds break at the state reached, as they are there.
  void leave(const std::vector<BondState>& broken);

  [[nodiscard]] const EquilibriumState& state() const { return state_; }
  /// The energies of a row.
  void put(QuasistaticRow& row) const;

  void save(IntegratorState& to) const;
  void restore(const IntegratorState& from);

 private:
  EquilibriumState state_;
  std::vector<BondState> left_;
  CompensatedSum work_, released_, relaxation_, dissipated_;
};

}  // namespace perimode
