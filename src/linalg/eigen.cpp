// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/linalg/eigen.hpp"

#include <string>

#include "dense.hpp"
#include "perimode/core/error.hpp"
#include "slepc.hpp"
#include "sparse_engine.hpp"

namespace perimode {

void check(const EigenProblem& problem, const EigenOptions& options) {
  if (problem.stiffness == nullptr || problem.mass == nullptr)
    invalid_input({.expected = "a stiffness and a mass", .got = "none", .remedy = "set both"});
  const Csr& k = *problem.stiffness;
  const bool fits =
      k.cols == k.rows && problem.mass->size() == k.rows &&
      (problem.known == nullptr || problem.known->rows() == k.rows) &&
      (problem.node_of_dof.empty() || problem.node_of_dof.size() == static_cast<std::size_t>(k.rows));
  if (!fits)
    invalid_input(
        {.expected = "mass, known vectors and node numbers with one entry per row of a square stiffness",
         .got = std::to_string(k.rows) + " x " + std::to_string(k.cols) + " and " +
                std::to_string(problem.mass->size()) + " masses",
         .remedy = "reduce all of them to the free dofs"});
  if (k.rows > 0 && !(problem.mass->minCoeff() > 0.0))
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
  const bool dense = options.engine == EigenEngine::dense || (options.engine == EigenEngine::automatic &&
                                                              problem.stiffness->rows <= options.dense_limit);
  if (dense) return solve_dense(problem, options);
  if (options.engine == EigenEngine::slepc) return solve_slepc(problem, options, sink);
  if (options.has_range) return solve_range(problem, options, sink);
  // K >= 0: nothing lies below zero, so what is nearest to a shift there are the lowest modes.
  if (options.has_shift && options.shift > 0.0) return solve_nearest(problem, options, sink);
  return solve_lowest(problem, options, sink);
}

}  // namespace perimode
