// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "perimode/linalg/eigen.hpp"

namespace perimode {

/// Every eigenpair outside `known` by LAPACK; the options choose among them. O(n^3).
[[nodiscard]] EigenResult solve_dense(const EigenProblem& problem, const EigenOptions& options);

}  // namespace perimode
