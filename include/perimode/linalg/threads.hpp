// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace perimode {

/// Threads used by our parallel loops (OpenMP) and by the dense kernels underneath the
/// factorisations (OpenBLAS). Process-wide. Throws invalid_input if count < 1.
void set_threads(int count);

/// Threads our parallel loops take at present.
[[nodiscard]] int threads();

}  // namespace perimode
