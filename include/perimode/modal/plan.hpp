// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "perimode/assembly/body.hpp"
#include "perimode/linalg/factor.hpp"
#include "perimode/modal/options.hpp"

namespace perimode {

/// What a modal analysis of a body would take, before it is run.
struct ModalPlan {
  Index particles = 0;
  Index ghosts = 0;
  Offset bonds = 0;      ///< alive, each once
  Offset cut = 0;        ///< by pre-cracks
  Index dofs = 0;        ///< free ones
  Offset nonzeros = 0;   ///< of K over the free dofs, where it is assembled
  double asymmetry = 0;  ///< max |K - K^T| / max |K|
  Index pieces = 0;
  Index isolated = 0;  ///< particles without a bond
  Index rigid = 0;     ///< free rigid motions
  FillEstimate fill;   ///< of the factorisation; zero where none is made
  std::string solver;
  std::string reason;       ///< why this solver
  double memory_bytes = 0;  ///< predicted peak of the run
  std::vector<std::string> warnings;
};

/// Chooses the solver and predicts what it takes, but factors and solves nothing. Cost: a few products with K
/// and, for a solver that factors, the assembly and an ordering.
template <int Dim>
[[nodiscard]] ModalPlan plan_modes(const Body<Dim>& body, const ModalOptions& options);

/// The memory of plan_modes to within a factor of about 2, without assembling or ordering anything.
template <int Dim>
[[nodiscard]] double rough_memory(const Body<Dim>& body, const ModalOptions& options);

}  // namespace perimode
