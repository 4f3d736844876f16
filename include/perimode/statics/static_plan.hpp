// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "perimode/linalg/factor.hpp"
#include "perimode/statics/static.hpp"

namespace perimode {

/// What a static analysis of a body would take, before it is run.
struct StaticPlan {
  StaticSolver solver = StaticSolver::automatic;  ///< never automatic when made
  std::string name;                               ///< as StaticResult::solver
  std::string reason;                             ///< why this solver
  Index particles = 0;
  Index ghosts = 0;
  Offset bonds = 0;  ///< alive, each once
  Index dofs = 0;    ///< free ones
  double asymmetry = 0.0;
  Index rigid = 0;            ///< free rigid motions
  FillEstimate fill;          ///< of the factor; zero where none is made
  double memory_bytes = 0.0;  ///< predicted peak of the run
};

/// Chooses as solve_static does and predicts the memory; solves nothing. The choice counts, it does not time
/// (docs/theory/09_static.md). Throws what solve_static throws before it solves.
/// Cost: about 10 products with K; for a factor also the assembly and an ordering.
template <int Dim>
[[nodiscard]] StaticPlan plan_static(const Body<Dim>& body, const StaticOptions& options);

}  // namespace perimode
