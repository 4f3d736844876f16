// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/linalg/eigen.hpp"

#include <string>

#include "dense.hpp"
#include "perimode/core/error.hpp"
#include "slepc.hpp"
#include "sparse_engine.hpp"

namespace perimode {

void check(const EigenProblem& problem, const EigenOptions& options) {
  if ((problem.stiffness == nullptr && problem.action == nullptr) || problem.mass == nullptr)
    invalid_input({.expected = "a stiffness and a mass", .got = "none", .remedy = "set both"});
  const Index rows = problem.stiffness != nullptr ? problem.stiffness->rows : problem.action->size;
  const Index cols = problem.stiffness != nullptr ? problem.stiffness->cols : rows;
  const bool fits =
      cols == rows && problem.mass->size() == rows &&
      (problem.action == nullptr || problem.action->size == rows) &&
      (problem.known == nullptr || problem.known->rows() == rows) &&
      (problem.node_of_dof.empty() || problem.node_of_dof.size() == static_cast<std::size_t>(rows));
  if (!fits)
    invalid_input(
        {.expected = "mass, known vectors and node numbers with one entry per row of a square stiffness",
         .got = std::to_string(rows) + " x " + std::to_string(cols) + " and " +
                std::to_string(problem.mass->size()) + " masses",
         .remedy = "reduce all of them to the free dofs"});
  if (rows > 0 && !(problem.mass->minCoeff() > 0.0))
    invalid_input({.expected = "a positive mass of every dof",
                   .got = std::to_string(problem.mass->minCoeff()),
                   .remedy = "give every particle a density and a volume"});
  if (options.has_range ? !(options.lower <= options.upper) : options.count < 1)
    invalid_input({.expected = options.has_range ? "lower <= upper" : "at least one mode",
                   .got = options.has_range
                              ? std::to_string(options.lower) + " and " + std::to_string(options.upper)
                              : std::to_string(options.count),
                   .remedy = "correct the request"});
}

EigenResult solve_eigen(const EigenProblem& problem, const EigenOptions& options, const Sink& sink) {
  check(problem, options);
  const bool matrix = problem.stiffness != nullptr;
  const bool dense =
      options.engine == EigenEngine::dense ||
      (options.engine == EigenEngine::automatic && matrix && problem.stiffness->rows <= options.dense_limit);
  const bool factor_free = options.engine == EigenEngine::chebyshev ||
                           options.engine == EigenEngine::inverse ||
                           (options.engine == EigenEngine::automatic && !matrix);
  const bool lowest = !options.has_range && (!options.has_shift || options.shift <= 0.0);
  if (factor_free && lowest) return solve_factor_free(problem, options, sink);
  if (!matrix || factor_free)
    invalid_input(
        {.expected = factor_free ? "the lowest modes of an engine without a factor" : "a stiffness matrix",
         .got = factor_free ? "a range or a shift" : "an operator alone",
         .remedy = "use lanczos with the assembled stiffness"});
  if (dense) return solve_dense(problem, options);
  if (options.engine == EigenEngine::slepc) return solve_slepc(problem, options, sink);
  if (options.has_range) return solve_range(problem, options, sink);
  // K >= 0: nothing lies below zero, so what is nearest to a shift there are the lowest modes.
  if (options.has_shift && options.shift > 0.0) return solve_nearest(problem, options, sink);
  return solve_lowest(problem, options, sink);
}

}  // namespace perimode
