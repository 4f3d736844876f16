// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>

#include "perimode/assembly/bond_limits.hpp"
#include "perimode/assembly/operators.hpp"
#include "perimode/dynamics/motion.hpp"
#include "perimode/dynamics/newmark.hpp"

namespace perimode {

/// Solutions repeated because bonds broke.
struct StepRepeats {
  Offset all = 0;
  Offset most = 0;  ///< in one step
};

/// The bonds of a body as the steps of an integrator that knows no body break them.
class StepBreaking {
 public:
  virtual ~StepBreaking() = default;
  /// Solves (K + diag(d)) x = b with K as it is at every solution. Throws Error(solver_failure).
  [[nodiscard]] virtual ShiftedSolve solver(const Eigen::VectorXd& d) = 0;
  /// Breaks all bonds beyond their critical stretch at displacements q of the free dofs (m) and values h of
  /// the force terms: K, the forces of given motion and the solver follow. false: there are none. Every call
  /// that is not the last of a step breaks a bond, so a step has at most as many as there are bonds.
  virtual bool break_beyond(const Eigen::VectorXd& q, const Eigen::VectorXd& h) = 0;
  /// Of the bonds broken in this step, in the order in which they broke: k_b, of a bond shared with a wall's
  /// image the body's part (N/m), and elongations at q, h (m; linear in both).
  [[nodiscard]] virtual const Eigen::VectorXd& stiffness() const = 0;
  [[nodiscard]] virtual Eigen::VectorXd elongation(const Eigen::VectorXd& q,
                                                   const Eigen::VectorXd& h) const = 0;
  /// The step is over.
  virtual void settle() = 0;
  [[nodiscard]] virtual Offset broken() const = 0;  ///< bonds, since the start
  [[nodiscard]] virtual StepRepeats repeats() const = 0;
  /// After it the next solution makes its factor anew, as that of a run that goes on from there does: both
  /// then give the same bits.
  virtual void save(IntegratorState& state) = 0;
  virtual void restore(const IntegratorState& state) = 0;
};

struct StepBreakingOptions {
  BondLimits limits = {};
  StiffnessForm form = StiffnessForm::automatic;
  bool factor = true;        ///< Cholesky, updated; false: conjugate gradients with block Jacobi
  double tolerance = 1e-12;  ///< of conjugate gradients
};

/// For a body with symmetric boundary and bonds of k_b >= 0. `motion` is that of the body (make_motion); its
/// stiffness becomes the one that follows, valid while the object lives. Both have to outlive it.
/// Cost: a search of all bonds per call of break_beyond; per broken bond that of BreakableStiffness and of
/// UpdatedSolver, and O(bonds) where one ends at a dof that is moved. Throws as BreakableStiffness.
template <int Dim>
[[nodiscard]] std::unique_ptr<StepBreaking> step_breaking(Body<Dim>& body, Motion& motion,
                                                          const StepBreakingOptions& options);

}  // namespace perimode
