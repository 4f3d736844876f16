// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include "perimode/core/types.hpp"

namespace perimode {

/// Numbers a thread takes at a time: four vectors of them stay in the second cache.
constexpr Index chunk = 4096;

/// part(first, count) for every chunk of [0, n), in parallel.
template <class Part>
void for_each_chunk(Index n, const Part& part) {
  const Index chunks = n / chunk + (n % chunk > 0 ? 1 : 0);
#pragma omp parallel for schedule(static) if (chunks > 4)
  for (Index c = 0; c < chunks; ++c) part(c * chunk, std::min(chunk, n - c * chunk));
}

/// Sum of part(first, count) over the chunks of [0, n), added in their order: the same bits for any
/// number of threads.
template <class Part>
double sum_over_chunks(Index n, const Part& part) {
  std::vector<double> partial(static_cast<std::size_t>(n / chunk) + 1, 0.0);
  for_each_chunk(n, [&](Index first, Index count) { partial[first / chunk] = part(first, count); });
  double sum = 0.0;
  for (const double p : partial) sum += p;
  return sum;
}

/// a . b
[[nodiscard]] double dot(Index n, const double* a, const double* b);
/// r = b - r; returns r . r.
double subtract_from(Index n, const double* b, double* r);
/// x += alpha p, r -= alpha q; returns r . r.
double advance(Index n, double alpha, const double* p, const double* q, double* x, double* r);
/// p = z + beta p
void turn(Index n, const double* z, double beta, double* p);

}  // namespace perimode
