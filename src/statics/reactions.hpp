// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "perimode/statics/static.hpp"

namespace perimode {

/// Reactions of all conditions and the balance of all forces.
struct ReactionSums {
  std::vector<Reaction> reactions;
  double balance = 0.0;
};

/// Per fix and prescribe entry the sum of `internal` - `load` over its dofs; per wall the force its ghosts'
/// bonds exert. `internal` is internal_force(body, u). Cost O(bond ends).
template <int Dim>
[[nodiscard]] ReactionSums sum_reactions(const Body<Dim>& body,
                                         const std::vector<BoundaryCondition>& conditions,
                                         const Eigen::VectorXd& u, const Eigen::VectorXd& internal,
                                         const Eigen::VectorXd& load);

}  // namespace perimode
