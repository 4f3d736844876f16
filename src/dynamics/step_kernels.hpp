// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "perimode/core/types.hpp"

namespace perimode {

/// Consecutive rows of a step of central differences:
///   v_+ = ((1 - r dt/2) v - (dt/m) (y + lag)) / (1 + r dt/2),   next = q + dt v_+.
struct StepRows {
  Index count = 0;
  Index ahead = 0;  ///< so many rows more will be wanted next: their v is fetched on the way
  double dt = 0.0;
  const double* y = nullptr;  ///< K q minus forces
  const double* q = nullptr;
  double* v = nullptr;           ///< v_{n-1/2} before, v_{n+1/2} after
  double* next = nullptr;        ///< may be q or y
  double one_mass = 0.0;         ///< of all rows, where `mass` is null
  const double* mass = nullptr;  ///< m per row
  const double* rate = nullptr;  ///< r per row; null: 0
  const double* lag = nullptr;   ///< force of stiffness damping; null: 0
};

/// Sums over the rows of a step, v_n = (v + v_+)/2.
struct StepSums {
  double momentum = 0.0;  ///< v_+ . m v_+
  double strain = 0.0;    ///< y . next
  double damping = 0.0;   ///< dt v_n . (r m v_n + lag)
};

/// Takes the step. Without `sums` only that of damping is formed. The order of summation does not depend on
/// the processor.
[[nodiscard]] StepSums step_rows(const StepRows& rows, bool sums);

}  // namespace perimode
