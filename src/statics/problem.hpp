// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "perimode/linalg/operator.hpp"
#include "perimode/statics/static.hpp"

namespace perimode {

/// R K T q = rhs over the free dofs, and what is known of K before it is solved.
struct StaticProblem {
  LinearOperator stiffness;  ///< R K T
  double bound = 0.0;        ///< of the magnitude of its eigenvalues, N/m
  double asymmetry = 0.0;
  Eigen::VectorXd load;   ///< f of all particle dofs, N
  Eigen::VectorXd rhs;    ///< R f - R K g, N
  double scale = 0.0;     ///< max(|R f|, |R K g|), N
  Eigen::VectorXd mass;   ///< of the free dofs, kg
  Eigen::MatrixXd rigid;  ///< rigid motions left free, M-orthonormal

  [[nodiscard]] bool symmetric() const { return asymmetry <= symmetric_to_round_off; }
};

/// The free dofs of a vector over all particle dofs.
template <int Dim>
[[nodiscard]] Eigen::VectorXd free_part(const Body<Dim>& body, const Eigen::VectorXd& all);

/// Throws invalid_input where a force on the free dofs works on a rigid motion (columns of `rigid`) that is
/// free.
template <int Dim>
void check_equilibrium(const Body<Dim>& body, const Eigen::MatrixXd& rigid, const Eigen::VectorXd& force);

/// Throws invalid_input: loads that do not fit the body, nothing that loads or moves it, loads that are not
/// in equilibrium where nothing holds it.
template <int Dim>
[[nodiscard]] StaticProblem pose_problem(const Body<Dim>& body, const StaticOptions& options);

/// Which solver, and why. `solver` is never automatic.
struct StaticChoice {
  StaticSolver solver = StaticSolver::cholesky;
  std::string name;
  std::string reason;
};

/// Throws invalid_input where the solver asked for does not fit the body.
template <int Dim>
[[nodiscard]] StaticChoice choose_solver(const Body<Dim>& body, const StaticProblem& problem,
                                         const StaticOptions& options);

/// Numbers of the dofs a factor is made of: all free ones, but as many held back as there are rigid motions,
/// so that what is left is positive definite. -1 for the others. Loads in equilibrium exert nothing on
/// the dofs held back.
struct FactorDofs {
  std::vector<Index> number;    ///< per particle dof
  std::vector<Index> free;      ///< per number: that of the free dof
  std::vector<Index> particle;  ///< per number
};
template <int Dim>
[[nodiscard]] FactorDofs factor_dofs(const Body<Dim>& body, const Eigen::MatrixXd& rigid);

}  // namespace perimode
