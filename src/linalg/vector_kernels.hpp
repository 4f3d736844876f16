// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

/// One source, compiled for several generations of x86-64; the loader picks.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define PERIMODE_EVERY_PROCESSOR __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define PERIMODE_EVERY_PROCESSOR
#endif

namespace perimode {

/// Width numbers that lie side by side: one row of an interleaved block of vectors. Aligned to its size.
template <int Width>
struct Lane {
  using Type __attribute__((vector_size(Width * sizeof(double)), may_alias)) = double;
};

}  // namespace perimode
