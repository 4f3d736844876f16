// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/dynamics/shifted_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "linalg/fused.hpp"
#include "perimode/assembly/assemble.hpp"
#include "perimode/assembly/operators.hpp"
#include "perimode/core/error.hpp"
#include "perimode/linalg/conjugate_gradients.hpp"
#include "perimode/linalg/factor.hpp"

namespace perimode {

namespace {

/// Iterations of block-Jacobi conjugate gradients in a step: as many as the step is long beside the stable
/// one, unless the body itself is better conditioned (as for statics: its length in horizons). Counted for
/// squares and cubes, tests/bench/bench_implicit.cpp.
template <int Dim>
double cg_iterations(const Body<Dim>& body, double ratio, double tolerance) {
  const double digits = std::log(2.0 / tolerance);
  const double by_step = 2.0 + 0.46 * ratio * digits;
  const double by_body = 0.7 * std::max(1.0, horizons_long(body)) * digits;
  return 1.0 / std::hypot(1.0 / by_step, 1.0 / by_body);
}

/// Bytes per dof that an iteration moves: vectors, block Jacobi, the operator and, where that stores next to
/// nothing, its arithmetic at half a byte a multiplication.
template <int Dim>
double bytes_per_iteration(const Body<Dim>& body) {
  const double dofs = body.boundary.free;
  const double family = 2.0 * static_cast<double>(count_bonds(body.bonds, body.count())) / body.count();
  return 8.0 * 16.0 + operator_bytes(body) / dofs + 0.5 * Dim * family;
}

struct Counted {
  FillEstimate fill;
  double matrix_bytes = 0.0;
};
struct Choice {
  ImplicitSolver solver = ImplicitSolver::factor;
  std::string reason;
  std::optional<Counted> counted = {};  ///< where the choice asked for it
};

template <int Dim>
Counted count_fill(const Body<Dim>& body) {
  const Csr k = scalar_csr(assemble_stiffness(body), body.boundary.free_number);
  return {
      predict_fill_with_order(k, dissection_order(k, particle_of_free_dof(body), particle_positions(body))),
      12.0 * static_cast<double>(k.nonzeros())};
}

/// Above so many dofs not even the ordering is tried, by dimension.
constexpr double most_dofs_to_order[] = {1e12, 4e6, 4e5};
constexpr double most_factor_bytes = 8e9;
/// Steps that share the making of a factor; its arithmetic counts a byte an operation.
constexpr double steps_of_a_run = 1000.0;

template <int Dim>
Choice automatic(const Body<Dim>& body, double ratio, double tolerance) {
  if (Dim == 1) return {ImplicitSolver::factor, "the factor of a bar is a narrow band"};
  const double dofs = body.boundary.free;
  const double iterations = cg_iterations(body, ratio, tolerance);
  const double moved = iterations * bytes_per_iteration(body);
  const std::string cg =
      fmt::format("about {:.0f} iterations move {:.1f} kB per dof and step", iterations, 1e-3 * moved);
  if (dofs > most_dofs_to_order[Dim - 1])
    return {ImplicitSolver::cg, fmt::format("{}; {:.0f} dofs are too many for a factor", cg, dofs)};
  Counted counted = count_fill(body);
  const FillEstimate& fill = counted.fill;
  const double factor = (2.0 * fill.factor_bytes + fill.flops / steps_of_a_run) / dofs;
  const std::string reason =
      fmt::format("{}, a factor of {:.2f} GB {:.1f} kB", cg, 1e-9 * fill.peak_bytes, 1e-3 * factor);
  const bool fits = fill.peak_bytes <= most_factor_bytes;
  return {fits && factor <= moved ? ImplicitSolver::factor : ImplicitSolver::cg, reason, counted};
}

template <int Dim>
Choice choose(const Body<Dim>& body, bool symmetric, ImplicitSolver which, double ratio, double tolerance) {
  if (!symmetric) {
    if (which == ImplicitSolver::cg) {
      invalid_input({"solver auto or factor where walls make the equations unsymmetric",
                     "cg",
                     "leave the solver out, or use mirror, antimirror or zero_layer walls",
                     {}});
    }
    return {ImplicitSolver::factor, "walls make the equations unsymmetric"};
  }
  if (which != ImplicitSolver::automatic) return {which, "asked for"};
  return automatic(body, ratio, tolerance);
}

std::string name(const Choice& choice, bool symmetric) {
  const char* solver = choice.solver == ImplicitSolver::cg ? "cg block jacobi"
                       : symmetric                         ? "cholesky"
                                                           : "lu";
  return fmt::format("{}: {}", solver, choice.reason);
}

template <int Dim>
ShiftedSolve by_factor(const Body<Dim>& body, bool symmetric, const Eigen::VectorXd& shift) {
  const Csr k = scalar_csr(assemble_stiffness(body), body.boundary.free_number);
  if (!symmetric) {
    const auto factor = std::make_shared<LuFactor>(k, -1.0, shift);
    return [factor](const Eigen::VectorXd& b, const Eigen::VectorXd&, Eigen::VectorXd& x) {
      if (!hopeless(b, x)) x = factor->solve(b);
      return 0;
    };
  }
  const auto factor = std::make_shared<CholeskyFactor>(CholeskyFactor::with_order(
      k, dissection_order(k, particle_of_free_dof(body), particle_positions(body))));
  if (factor->factorize(k, -1.0, shift) != FactorStatus::done) {
    invalid_input({"a stiffness that makes the implicit step solvable",
                   "one that is not positive definite beside the masses",
                   "check the material: bonds must not push when they are stretched",
                   {}});
  }
  return [factor](const Eigen::VectorXd& b, const Eigen::VectorXd&, Eigen::VectorXd& x) {
    if (!hopeless(b, x)) x = factor->solve(b);
    return 0;
  };
}

/// K + diag(d) in one product and one pass.
LinearOperator shifted(const LinearOperator& stiffness, const Eigen::VectorXd& shift) {
  return {stiffness.size, [stiffness, shift](const double* x, double* y) {
            stiffness.apply(x, y);
            for_each_chunk(stiffness.size, [&](Index first, Index count) {
              for (Index i = first; i < first + count; ++i) y[i] += shift[i] * x[i];
            });
          }};
}

template <int Dim>
LinearOperator shifted_block_jacobi(const Body<Dim>& body, const Eigen::VectorXd& shift) {
  std::vector<double> blocks = absolute_blocks(body);
  for (std::size_t d = 0; d < body.boundary.free_number.size(); ++d) {
    const Index number = body.boundary.free_number[d];
    if (number >= 0) blocks[d * Dim + d % Dim] += shift[number];
  }
  return block_jacobi(blocks, Dim, body.boundary.free_number);
}

/// `tolerance`, or where rounding of x alone leaves a larger residual, what there is to be had.
template <int Dim>
double reachable(const Body<Dim>& body, const Eigen::VectorXd& shift, double tolerance) {
  return std::max(tolerance, 8.0 * std::numeric_limits<double>::epsilon() *
                                 (1.0 + stiffness_bound(body) / shift.minCoeff()));
}

template <int Dim>
ShiftedSolve by_iterations(const Body<Dim>& body, const LinearOperator& stiffness,
                           const Eigen::VectorXd& shift, double tolerance) {
  CgOptions options;
  options.tolerance = reachable(body, shift, tolerance);
  return [a = shifted(stiffness, shift), jacobi = shifted_block_jacobi(body, shift), options](
             const Eigen::VectorXd& b, const Eigen::VectorXd& guess, Eigen::VectorXd& x) {
    if (hopeless(b, x)) return 0;
    CgResult cg = conjugate_gradients(a, b, jacobi, options, &guess);
    if (!cg.converged && !(cg.residual <= 10.0 * options.tolerance)) {
      throw Error(ErrorKind::solver_failure,
                  "conjugate gradients did not solve an implicit step: " + cg.message);
    }
    x = std::move(cg.x);
    return cg.iterations;
  };
}

/// K + diag(d) of the bonds as they are, with room for all that it will be when some are gone.
template <int Dim>
Csr shifted_matrix(const Body<Dim>& body, const Eigen::VectorXd& shift) {
  Csr k = scalar_csr(assemble_stiffness(body), body.boundary.free_number, Zeros::keep);
  for (Index i = 0; i < k.rows; ++i) {
    const auto row = k.column.begin() + k.row_start[i];
    const auto diagonal = std::lower_bound(row, k.column.begin() + k.row_start[i + 1], i);
    k.value[static_cast<std::size_t>(diagonal - k.column.begin())] += shift[i];
  }
  return k;
}

}  // namespace

bool hopeless(const Eigen::VectorXd& b, Eigen::VectorXd& x) {
  if (b.allFinite()) return false;
  x.setConstant(b.size(), std::numeric_limits<double>::quiet_NaN());
  return true;
}

template <int Dim>
ShiftedSolver make_shifted_solver(const Body<Dim>& body, const LinearOperator& stiffness, bool symmetric,
                                  ImplicitSolver which, double ratio, double tolerance,
                                  std::string& description) {
  if (choose_shifted_solver(body, symmetric, which, ratio, tolerance, description) == ImplicitSolver::cg) {
    return [&body, stiffness, tolerance](const Eigen::VectorXd& shift) {
      return by_iterations(body, stiffness, shift, tolerance);
    };
  }
  return [&body, symmetric](const Eigen::VectorXd& shift) { return by_factor(body, symmetric, shift); };
}

template <int Dim>
ImplicitSolver choose_shifted_solver(const Body<Dim>& body, bool symmetric, ImplicitSolver which,
                                     double ratio, double tolerance, std::string& description) {
  const Choice choice = choose(body, symmetric, which, ratio, tolerance);
  description = name(choice, symmetric);
  return choice.solver;
}

template <int Dim>
UpdatedSolver updated_shifted_solver(const Body<Dim>& body, const LinearOperator& stiffness,
                                     const Eigen::VectorXd& shift, bool factor, double tolerance) {
  UpdatedSolverOptions options;
  options.tolerance = reachable(body, shift, tolerance);
  options.only = factor ? SolveWay::update : SolveWay::iterate;
  if (!factor) {
    return {shifted(stiffness, shift), [&body, shift] { return shifted_block_jacobi(body, shift); }, options};
  }
  Csr matrix = shifted_matrix(body, shift);
  std::vector<Index> order = dissection_order(matrix, particle_of_free_dof(body), particle_positions(body));
  return {shifted(stiffness, shift), std::move(matrix), std::move(order), options};
}

template <int Dim>
ShiftedPlan plan_shifted_solver(const Body<Dim>& body, bool symmetric, ImplicitSolver which, double ratio,
                                double tolerance) {
  const Choice choice = choose(body, symmetric, which, ratio, tolerance);
  ShiftedPlan plan{name(choice, symmetric), 0.0};
  if (choice.solver == ImplicitSolver::cg) return plan;
  const Counted counted = choice.counted ? *choice.counted : count_fill(body);
  // UMFPACK keeps L, U and working copies; its column order fills more than a symmetric one.
  plan.factor_bytes =
      counted.matrix_bytes + (symmetric ? counted.fill.peak_bytes : 6.3 * counted.fill.factor_bytes);
  return plan;
}

#define PERIMODE_SHIFTED(D)                                                                                  \
  template ShiftedSolver make_shifted_solver<D>(const Body<D>&, const LinearOperator&, bool, ImplicitSolver, \
                                                double, double, std::string&);                               \
  template ImplicitSolver choose_shifted_solver<D>(const Body<D>&, bool, ImplicitSolver, double, double,     \
                                                   std::string&);                                            \
  template UpdatedSolver updated_shifted_solver<D>(const Body<D>&, const LinearOperator&,                    \
                                                   const Eigen::VectorXd&, bool, double);                    \
  template ShiftedPlan plan_shifted_solver<D>(const Body<D>&, bool, ImplicitSolver, double, double)
PERIMODE_SHIFTED(1);
PERIMODE_SHIFTED(2);
PERIMODE_SHIFTED(3);
#undef PERIMODE_SHIFTED

}  // namespace perimode
