// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "perimode/assembly/body.hpp"
#include "perimode/boundary/loads.hpp"
#include "perimode/core/sink.hpp"

namespace perimode {

/// How K u = f is solved. cholesky: a factor. multigrid, jacobi: conjugate gradients on the operator with a
/// V-cycle (grids) or block Jacobi. lu: UMFPACK, for unsymmetric boundaries. automatic: by the cost model of
/// plan_static.
enum class StaticSolver { automatic, cholesky, multigrid, jacobi, lu };

/// The case file's `analysis.static`.
struct StaticOptions {
  std::vector<Load> loads = {};
  StaticSolver solver = StaticSolver::automatic;
  double tolerance = 1e-8;  ///< of the residual
};

/// What a boundary condition or wall exerts on the body.
struct Reaction {
  std::string region;                ///< "fix x-", "prescribe y+", "wall z-", ...
  std::array<double, 3> force = {};  ///< N
};

enum class StaticStatus { converged, not_converged };

struct StaticResult {
  StaticStatus status = StaticStatus::not_converged;
  std::string message;           ///< why not
  std::string solver;            ///< "cholesky", "cg multigrid", "cg block jacobi", "lu"
  std::string reason;            ///< why this solver
  Eigen::VectorXd displacement;  ///< all particle dofs, point-major, m
  /// One per condition, in their order. A dof in two regions counts for the first that names it, a ghost
  /// beyond two walls for the first of them. Given dofs that no condition names stand last as "other".
  std::vector<Reaction> reactions;
  /// |sum of loads and reactions| / (sum of the magnitudes of the forces on single particles)
  double balance = 0.0;
  double strain_energy = 0.0;  ///< J, bond by bond
  /// J: (1/2) f . u over loads plus (1/2) reaction . prescribed displacement; that of walls left out
  double external_work = 0.0;
  double residual = 0.0;  ///< |R (f - K u)| / max(|R f|, |R K g|), bond by bond
  int iterations = 0;     ///< of conjugate gradients; 0 for a factor
  int rigid_modes = 0;    ///< free rigid motions, projected out (loads in equilibrium with themselves)
  double asymmetry = 0.0;
  Offset factor_nonzeros = 0;
  double seconds_setup = 0.0;      ///< loads, symmetry, rigid motions, assembly and factor or grids
  double seconds_solve = 0.0;      ///< solutions or iterations
  double seconds_reactions = 0.0;  ///< residual, reactions, energies
};

/// Displacements u = T q + g with R K u = R f: fixed and prescribed dofs at their values, loads in full (time
/// functions do not act). A body that is free to move rigidly under loads in equilibrium with themselves gets
/// the solution without mean translation and rotation (M-orthogonal to the rigid motions). Throws
/// invalid_input: nothing loads or moves the body, a body free to move rigidly under loads that are not in
/// equilibrium, mechanisms, a solver that does not fit the boundary. docs/theory/09_static.md.
template <int Dim>
[[nodiscard]] StaticResult solve_static(const Body<Dim>& body,
                                        const std::vector<BoundaryCondition>& conditions,
                                        const StaticOptions& options, const Sink& sink = {});

}  // namespace perimode
