// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "perimode/core/types.hpp"

namespace perimode {

/// Threads used by our parallel loops (OpenMP) and by the dense kernels underneath the
/// factorisations (OpenBLAS). Process-wide. Throws invalid_input if count < 1.
void set_threads(int count);

/// Threads our parallel loops take at present.
[[nodiscard]] int threads();

/// Below this many rows (particles) a parallel region costs more than it saves.
inline constexpr Index parallel_rows = 1000;

}  // namespace perimode
