// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "perimode/assembly/body.hpp"
#include "perimode/assembly/breakable_stiffness.hpp"
#include "perimode/linalg/factor.hpp"
#include "perimode/linalg/updated_solver.hpp"

namespace perimode {

/// A spring between a free dof and the ground, N/m.
struct Pin {
  Index dof = 0;
  double stiffness = 0.0;
};

/// Whether a factor is made, and why.
struct EquilibriumChoice {
  bool matrix_free = false;
  std::string reason;
  FillEstimate fill = {};  ///< of the factor; zero where none was counted
  double matrix_bytes = 0.0;
};

/// Springs for all free dofs, as stiff as the body is there: the diagonal of K, where it is zero its mean,
/// N/m.
template <int Dim>
[[nodiscard]] std::vector<double> intact_springs(const Body<Dim>& body);

/// Counts what a solution moves through memory with a factor and with conjugate gradients
/// (docs/theory/14_quasistatic.md). Cost: where a factor is not plainly too dear, an assembly and an
/// ordering.
template <int Dim>
[[nodiscard]] EquilibriumChoice choose_equilibrium(const Body<Dim>& body, const UpdatedSolverOptions& options,
                                                   bool matrix_free);

/// (K + P) q = b over the free dofs of a body whose bonds break, P the springs that hold what could move
/// without stretching a bond. All forms of K and the factor follow each break in place.
template <int Dim>
class Equilibrium {
 public:
  /// `spring` as intact_springs gave it when the body was intact; `pins`: dofs held from the start.
  Equilibrium(Body<Dim>& body, const UpdatedSolverOptions& options, bool matrix_free,
              std::vector<double> spring, const std::vector<Index>& pins);
  Equilibrium(const Equilibrium&) = delete;
  Equilibrium& operator=(const Equilibrium&) = delete;

  /// All columns; q comes in as the guess.
  [[nodiscard]] SolveOutcome solve(const Eigen::MatrixXd& b, Eigen::MatrixXd& q);
  /// Breaks bonds (as with_images returns them) in the body and everywhere else.
  void break_bonds(std::span<const BondRef> bonds);
  /// Springs as stiff as the intact body is at these dofs; those held already are left alone.
  void pin(const std::vector<Index>& dofs);
  /// A dof of a motion that stretches no bond, found by a factor that is made for it; -1: none, or the body
  /// is too large for one. For iterations, which say no more than that there is one.
  [[nodiscard]] Index mechanism_dof() const;
  /// Everything anew from the body as it is: what a run resumed here starts from.
  void rebuild();

  [[nodiscard]] const std::vector<Pin>& pins() const { return *pins_; }
  [[nodiscard]] bool pinned(Index dof) const { return pinned_[static_cast<std::size_t>(dof)]; }
  [[nodiscard]] const LinearOperator& product() const { return product_; }
  [[nodiscard]] const UpdatedSolver& solver() const { return *solver_; }
  [[nodiscard]] double spring(Index dof) const { return spring_[static_cast<std::size_t>(dof)]; }
  /// Of all solvers so far.
  [[nodiscard]] std::array<WayTotals, solve_ways> totals() const;

 private:
  [[nodiscard]] LinearOperator preconditioner() const;

  Body<Dim>* body_;
  UpdatedSolverOptions options_;
  bool matrix_free_;
  std::vector<double> spring_;  ///< per free dof
  std::shared_ptr<std::vector<Pin>> pins_;
  std::vector<bool> pinned_;
  std::unique_ptr<BreakableStiffness<Dim>> stiffness_;
  LinearOperator product_;
  std::unique_ptr<UpdatedSolver> solver_;
  std::array<WayTotals, solve_ways> earlier_ = {};
};

}  // namespace perimode
