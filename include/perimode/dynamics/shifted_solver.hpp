// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "perimode/assembly/body.hpp"
#include "perimode/dynamics/newmark.hpp"
#include "perimode/linalg/operator.hpp"
#include "perimode/linalg/updated_solver.hpp"

namespace perimode {

/// How the equations of an implicit step are solved; automatic: by counted cost.
enum class ImplicitSolver { automatic, factor, cg };

/// Solvers of (K + diag(d)) x = b for the steps of `newmark`: a Cholesky factor (LU where K is unsymmetric),
/// made once, or conjugate gradients with block Jacobi from the guess, until |b - A x| <= tolerance |b| or
/// round-off. `ratio` is dt over the stable step of central differences: conjugate gradients take a few
/// products per unit of it. automatic takes what moves fewer bytes in a step, the work of the factor shared
/// among a thousand steps, and no factor that needs more than 8 GB; `description` says which, and why. `body`
/// and what `stiffness` refers to have to outlive the solver. A solve throws Error(solver_failure) where
/// conjugate gradients give up. Throws invalid_input: cg where K is unsymmetric.
/// Cost: for automatic, where a factor is not plainly too dear, an assembly and an ordering.
template <int Dim>
[[nodiscard]] ShiftedSolver make_shifted_solver(const Body<Dim>& body, const LinearOperator& stiffness,
                                                bool symmetric, ImplicitSolver which, double ratio,
                                                double tolerance, std::string& description);

/// What is no number would be refused by a solver; the run has to end as unstable instead. true: b is none,
/// and so is x now.
[[nodiscard]] bool hopeless(const Eigen::VectorXd& b, Eigen::VectorXd& x);

/// factor or cg, as make_shifted_solver chooses.
template <int Dim>
[[nodiscard]] ImplicitSolver choose_shifted_solver(const Body<Dim>& body, bool symmetric,
                                                   ImplicitSolver which, double ratio, double tolerance,
                                                   std::string& description);

/// The solver of (K + diag(d)) x = b for a symmetric body that loses bonds: a factor that is updated at every
/// change, or conjugate gradients with block Jacobi of the bonds as they are when it is made. Ways that
/// timings would choose are left out, so that runs repeat to the last bit. `body` and `stiffness`, which
/// follows the bonds, have to outlive it.
template <int Dim>
[[nodiscard]] UpdatedSolver updated_shifted_solver(const Body<Dim>& body, const LinearOperator& stiffness,
                                                   const Eigen::VectorXd& shift, bool factor,
                                                   double tolerance);

/// What make_shifted_solver would choose.
struct ShiftedPlan {
  std::string description;    ///< and why
  double factor_bytes = 0.0;  ///< peak of making a factor, the matrix included; 0: none is made
};
template <int Dim>
[[nodiscard]] ShiftedPlan plan_shifted_solver(const Body<Dim>& body, bool symmetric, ImplicitSolver which,
                                              double ratio, double tolerance);

}  // namespace perimode
