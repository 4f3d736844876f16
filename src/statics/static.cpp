// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/statics/static.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/stopwatch.hpp"
#include "perimode/assembly/assemble.hpp"
#include "perimode/assembly/multigrid.hpp"
#include "perimode/assembly/operators.hpp"
#include "perimode/linalg/conjugate_gradients.hpp"
#include "perimode/linalg/factor.hpp"
#include "statics/problem.hpp"
#include "statics/reactions.hpp"

namespace perimode {

namespace {

template <int Dim>
[[noreturn]] void mechanism(const Body<Dim>& body) {
  if (softening(body)) {
    invalid_input(
        {"a body that resists every motion",
         "one that some motions take energy from, or cost none: bonds of negative stiffness outweigh "
         "the others where families lack bonds",
         "take a micromodulus with smaller negative parts or none, or periodic axes or walls instead "
         "of free surfaces",
         {}});
  }
  invalid_input({"a body whose bonds hold its shape",
                 "a motion that is not rigid and stretches no bond",
                 "use a longer horizon (2 spacings or more), or fix the particles that hang by too few bonds",
                 {}});
}

/// The residual that rounding of the displacements alone brings about.
double rounding_residual(const StaticProblem& problem, const Eigen::VectorXd& u) {
  return 8.0 * std::numeric_limits<double>::epsilon() * problem.bound * u.norm() /
         std::max(problem.scale, 1e-300);
}

struct Solution {
  Eigen::VectorXd q;  ///< free dofs
  bool converged = true;
  std::string message;
};

template <int Dim>
Solution solve_cholesky(const Body<Dim>& body, const StaticProblem& problem, StaticResult& result,
                        Clock::time_point start, const Sink& sink) {
  const FactorDofs dofs = factor_dofs(body, problem.rigid);
  sink.report("assembling");
  const Csr k = scalar_csr(assemble_stiffness(body), dofs.number);
  sink.report("ordering");
  CholeskyFactor factor =
      CholeskyFactor::with_order(k, dissection_order(k, dofs.particle, particle_positions(body)));
  sink.report("factoring");
  if (factor.factorize(k, 0.0, Eigen::VectorXd::Zero(k.rows)) != FactorStatus::done) mechanism(body);
  result.factor_nonzeros = factor.fill().nonzeros;
  result.seconds_setup = seconds_since(start);
  sink.report("solving");
  const auto solving = Clock::now();
  const Eigen::VectorXd x = factor.solve(problem.rhs(dofs.free));
  Solution solution;
  solution.q = Eigen::VectorXd::Zero(problem.rhs.size());
  solution.q(dofs.free) = x;
  result.seconds_solve = seconds_since(solving);
  return solution;
}

template <int Dim>
Solution solve_lu(const Body<Dim>& body, const StaticProblem& problem, StaticResult& result,
                  Clock::time_point start, const Sink& sink) {
  sink.report("assembling");
  const Csr k = scalar_csr(assemble_stiffness(body), body.boundary.free_number);
  sink.report("factoring");
  try {
    const LuFactor factor(k, 0.0, Eigen::VectorXd::Zero(k.rows));
    result.seconds_setup = seconds_since(start);
    sink.report("solving");
    const auto solving = Clock::now();
    Solution solution{factor.solve(problem.rhs), true, {}};
    result.seconds_solve = seconds_since(solving);
    return solution;
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::solver_failure) mechanism(body);
    throw;
  }
}

template <int Dim>
Solution solve_iteratively(const Body<Dim>& body, const StaticProblem& problem, StaticSolver solver,
                           double tolerance, StaticResult& result, Clock::time_point start,
                           const Sink& sink) {
  sink.report("preconditioner");
  const LinearOperator preconditioner =
      solver == StaticSolver::multigrid ? multigrid(body, problem.stiffness).preconditioner
                                        : block_jacobi(absolute_blocks(body), Dim, body.boundary.free_number);
  result.seconds_setup = seconds_since(start);
  sink.report("iterating");
  CgOptions options;
  // Of the larger of the two parts of the right-hand side, as the residual is measured in the end.
  options.tolerance = std::min(0.5, 0.9 * tolerance * problem.scale / problem.rhs.norm());
  CgResult cg = conjugate_gradients(problem.stiffness, problem.rhs, preconditioner, options, nullptr, sink);
  // Along a motion without stiffness x grows until it ends in no number, in a product that is not positive,
  // or in numbers whose rounding outweighs the loads. A residual that is small all the same was held up by
  // round-off.
  constexpr double useless = 1e-3;
  const bool grown = !(rounding_residual(problem, cg.x) <= useless);
  if (!cg.converged && (cg.singular || grown) && !(cg.residual <= useless)) mechanism(body);
  result.iterations = cg.iterations;
  result.seconds_solve = cg.seconds;
  return {std::move(cg.x), cg.converged, std::move(cg.message)};
}

/// Status from the residual: at the tolerance, or at what rounding of the displacements alone brings about.
void judge(StaticResult& result, const StaticProblem& problem, const Solution& solution, double tolerance) {
  const double rounding = rounding_residual(problem, result.displacement);
  constexpr double useless = 1e-3;  // no excuse: a singular K lets u grow without end
  if (result.residual <= std::max(tolerance, std::min(rounding, useless))) {
    result.status = StaticStatus::converged;
    return;
  }
  result.message =
      fmt::format("the residual is {:.1e}, above the tolerance {:.1e}", result.residual, tolerance);
  if (solution.message.empty()) return;
  result.message += ": " + solution.message +
                    "; bonds that do not hold the body's shape (a horizon below 2 spacings) can be the cause";
}

}  // namespace

template <int Dim>
StaticResult solve_static(const Body<Dim>& body, const std::vector<BoundaryCondition>& conditions,
                          const StaticOptions& options, const Sink& sink) {
  const auto start = Clock::now();
  StaticResult result;
  sink.report("loads and rigid motions");
  const StaticProblem problem = pose_problem(body, options);
  StaticChoice choice = choose_solver(body, problem, options);
  result.solver = std::move(choice.name);
  result.reason = std::move(choice.reason);
  result.asymmetry = problem.asymmetry;
  result.rigid_modes = static_cast<int>(problem.rigid.cols());
  if (result.rigid_modes > 0) {
    sink.inform(fmt::format(
        "{} rigid motion{} of the body {} free; the loads are in equilibrium, so {} projected out",
        result.rigid_modes, result.rigid_modes == 1 ? "" : "s", result.rigid_modes == 1 ? "is" : "are",
        result.rigid_modes == 1 ? "it is" : "they are"));
  }

  Solution solution;
  if (problem.rhs.isZero(0.0)) {
    solution.q = Eigen::VectorXd::Zero(problem.rhs.size());
  } else if (choice.solver == StaticSolver::cholesky) {
    solution = solve_cholesky(body, problem, result, start, sink);
  } else if (choice.solver == StaticSolver::lu) {
    solution = solve_lu(body, problem, result, start, sink);
  } else {
    solution = solve_iteratively(body, problem, choice.solver, options.tolerance, result, start, sink);
  }
  if (result.rigid_modes > 0) {
    const Eigen::VectorXd share = problem.rigid.transpose() * problem.mass.cwiseProduct(solution.q);
    solution.q -= problem.rigid * share;
  }

  sink.report("reactions");
  const auto last = Clock::now();
  const std::vector<double> u = body.boundary.expand(solution.q.data());
  result.displacement = Eigen::Map<const Eigen::VectorXd>(u.data(), static_cast<Eigen::Index>(u.size()));
  const Eigen::VectorXd internal = internal_force(body, result.displacement);
  double square = 0.0;
  for (Eigen::Index d = 0; d < internal.size(); ++d) {
    const double unbalanced = problem.load[d] - internal[d];
    const bool free = body.boundary.free_number[static_cast<std::size_t>(d)] >= 0;
    if (free) square += unbalanced * unbalanced;
    result.external_work += 0.5 * (free ? problem.load[d] : internal[d]) * result.displacement[d];
  }
  result.residual = problem.scale > 0.0 ? std::sqrt(square) / problem.scale : 0.0;
  ReactionSums sums = sum_reactions(body, conditions, result.displacement, internal, problem.load);
  result.reactions = std::move(sums.reactions);
  result.balance = sums.balance;
  result.strain_energy = bond_energy(body, result.displacement)[0];
  judge(result, problem, solution, options.tolerance);
  result.seconds_reactions = seconds_since(last);
  return result;
}

#define PERIMODE_STATIC(D)                                                                     \
  template StaticResult solve_static<D>(const Body<D>&, const std::vector<BoundaryCondition>&, \
                                        const StaticOptions&, const Sink&)
PERIMODE_STATIC(1);
PERIMODE_STATIC(2);
PERIMODE_STATIC(3);
#undef PERIMODE_STATIC

}  // namespace perimode
