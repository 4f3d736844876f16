// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "block_inverse.hpp"
#include "perimode/linalg/factor.hpp"
#include "perimode/linalg/operator.hpp"

namespace perimode {

/// One level of a V-cycle. `restrict_difference` writes P^T (b - q), `add_prolonged` x += P e, of the next
/// one; the coarsest level has neither.
struct VCycleLevel {
  LinearOperator a;
  BlockInverse inverse;  ///< D^-1 of the diagonal blocks of a
  double largest = 2.0;  ///< no eigenvalue of D^-1 A lies above: 2 where A sums bonds of two nodes
  std::function<void(const double* b, const double* q, double* coarse)> restrict_difference;
  std::function<void(const double* coarse, double* x)> add_prolonged;
};

struct VCycle {
  std::vector<VCycleLevel> levels;       ///< finest first
  std::optional<CholeskyFactor> factor;  ///< of the coarsest level's matrix; without one it is only smoothed
  int smoothing = 2;                     ///< degree of the Chebyshev smoother, before and after
};

/// Bytes of the vectors of a cycle.
[[nodiscard]] double v_cycle_bytes(const VCycle& cycle);

/// M^-1 b by one V-cycle from zero: the same Chebyshev smoother before and after the correction, so it is
/// symmetric, and positive definite as long as `largest` bounds the eigenvalues.
[[nodiscard]] LinearOperator v_cycle(VCycle cycle);

}  // namespace perimode
