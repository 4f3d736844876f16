// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/statics/static_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "perimode/assembly/assemble.hpp"
#include "perimode/assembly/fields.hpp"
#include "perimode/assembly/operators.hpp"
#include "statics/problem.hpp"

namespace perimode {

namespace {

/// At or below so many dofs a factor is made without asking further, by dimension.
constexpr double few_dofs[] = {1e9, 20000.0, 3000.0};
/// Up to here a factor of a plane cloud fills modestly.
constexpr double plane_cloud_dofs = 200000.0;
/// Products with K that a solution with V-cycles takes, all levels together.
constexpr double multigrid_products = 100.0;

/// Iterations of block-Jacobi conjugate gradients, as counted for squares and cubes held at one face:
/// 0.7 ln(2 / tolerance) times the length in horizons, the square root of the condition number.
double jacobi_iterations(double horizons, double tolerance) {
  return 0.7 * std::max(1.0, horizons) * std::log(2.0 / tolerance);
}

const char* name_of(StaticSolver solver) {
  switch (solver) {
    case StaticSolver::multigrid:
      return "cg multigrid";
    case StaticSolver::jacobi:
      return "cg block jacobi";
    case StaticSolver::lu:
      return "lu";
    case StaticSolver::automatic:
    case StaticSolver::cholesky:
      break;
  }
  return "cholesky";
}

template <int Dim>
std::pair<StaticSolver, std::string> automatic(const Body<Dim>& body, double tolerance) {
  const double dofs = body.boundary.free;
  const bool grid = body.particles.grid.has_value();
  if (Dim == 1) return {StaticSolver::cholesky, "the factor of a bar is a narrow band"};
  if (dofs <= few_dofs[Dim - 1])
    return {StaticSolver::cholesky, fmt::format("{} dofs are few: a factor", body.boundary.free)};
  if (!grid && Dim == 2 && dofs <= plane_cloud_dofs)
    return {StaticSolver::cholesky, "the factor of a plane cloud of this size fills modestly"};
  const double products = jacobi_iterations(horizons_long(body), tolerance);
  const std::string counted = fmt::format("block Jacobi would take about {:.0f} products with K", products);
  if (!grid) return {StaticSolver::jacobi, "a cloud has no coarser grids; " + counted};
  if (products > multigrid_products) {
    return {StaticSolver::multigrid, fmt::format("{}, V-cycles about {:.0f}", counted, multigrid_products)};
  }
  return {StaticSolver::jacobi, counted};
}

}  // namespace

template <int Dim>
StaticChoice choose_solver(const Body<Dim>& body, const StaticProblem& problem,
                           const StaticOptions& options) {
  if (body.boundary.free == 0) return {StaticSolver::cholesky, "none", "every component is given"};
  const bool asked = options.solver != StaticSolver::automatic;
  if (!problem.symmetric()) {
    if (asked && options.solver != StaticSolver::lu) {
      invalid_input({"solver auto or lu where walls make the equations unsymmetric",
                     name_of(options.solver),
                     "leave analysis.static.solver out, or use mirror, antimirror or zero_layer walls",
                     {}});
    }
    return {StaticSolver::lu, name_of(StaticSolver::lu),
            fmt::format("walls make the equations unsymmetric, by {:.1e}", problem.asymmetry)};
  }
  if (!asked) {
    auto [solver, reason] = automatic(body, options.tolerance);
    return {solver, name_of(solver), std::move(reason)};
  }
  if (problem.rigid.cols() > 0 && options.solver == StaticSolver::lu) {
    invalid_input({"solver auto, cholesky, multigrid or jacobi for a body that is free to move",
                   "lu",
                   "leave analysis.static.solver out, or fix the body",
                   {}});
  }
  if (options.solver == StaticSolver::multigrid && !body.particles.grid) {
    invalid_input(
        {"solver auto, cholesky, jacobi or lu for a cloud", "multigrid", "multigrid needs a grid", {}});
  }
  return {options.solver, name_of(options.solver), "asked for"};
}

template <int Dim>
StaticPlan plan_static(const Body<Dim>& body, const StaticOptions& options) {
  StaticPlan plan;
  const StaticProblem problem = pose_problem(body, options);
  StaticChoice choice = choose_solver(body, problem, options);
  plan.solver = choice.solver;
  plan.name = std::move(choice.name);
  plan.reason = std::move(choice.reason);
  plan.particles = body.count();
  plan.ghosts = ghost_count(body.bonds);
  plan.bonds = count_bonds(body.bonds, body.count());
  plan.dofs = body.boundary.free;
  plan.asymmetry = problem.asymmetry;
  plan.rigid = static_cast<Index>(problem.rigid.cols());

  const double vector = 8.0 * Dim * plan.particles;
  constexpr double rigid_motions = tensor_components<Dim>;
  double held = 3.0 + 2.0 * rigid_motions;  // vectors while rigid motions are looked for
  double solving = 0.0;
  if (plan.dofs > 0 && (plan.solver == StaticSolver::cholesky || plan.solver == StaticSolver::lu)) {
    const FactorDofs factor = factor_dofs(body, problem.rigid);
    BlockCsr blocks = assemble_stiffness(body);
    const double block_bytes = static_cast<double>(blocks.blocks()) * (4.0 + 8.0 * Dim * Dim);
    const Csr k = scalar_csr(blocks, factor.number);
    blocks = {};
    plan.fill = predict_fill_with_order(k, dissection_order(k, factor.particle, particle_positions(body)));
    // UMFPACK keeps L, U and working copies; its column order fills more than a symmetric one.
    const double factored =
        plan.solver == StaticSolver::lu ? 6.3 * plan.fill.factor_bytes : plan.fill.peak_bytes;
    // What the blocks of K leave is rarely of use to the factor.
    solving = block_bytes + 12.0 * static_cast<double>(k.nonzeros()) + 8.0 * plan.dofs + factored;
  } else if (plan.dofs > 0) {
    held = std::max(held, 8.0 + Dim);  // loads, masses, conjugate gradients, block Jacobi
    solving = operator_bytes(body);
    if (plan.solver == StaticSolver::multigrid) {
      // Three vectors more on the finest grid, and coarser ones that hold 1 / (2^Dim - 1) of it together.
      held += 3.0;
      const double coarser = 1.0 / ((1 << Dim) - 1);
      solving += coarser * (body_bytes(body) + operator_bytes(body) + (7.0 + Dim) * vector);
    }
  }
  constexpr double program_bytes = 36e6;  // code, libraries and their work space
  plan.memory_bytes = body_bytes(body) + solving + held * vector + program_bytes;
  return plan;
}

#define PERIMODE_STATIC_PLAN(D)                                                                       \
  template StaticChoice choose_solver<D>(const Body<D>&, const StaticProblem&, const StaticOptions&); \
  template StaticPlan plan_static<D>(const Body<D>&, const StaticOptions&)
PERIMODE_STATIC_PLAN(1);
PERIMODE_STATIC_PLAN(2);
PERIMODE_STATIC_PLAN(3);
#undef PERIMODE_STATIC_PLAN

}  // namespace perimode
