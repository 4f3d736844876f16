// SPDX-License-Identifier: BSD-3-Clause
#include "fused.hpp"

#include "vector_kernels.hpp"

namespace perimode {
namespace {

constexpr Index lanes = 8;

/// Eight running sums, added in one order.
struct Sums {
  double lane[lanes] = {};
  [[nodiscard]] double total() const {
    return ((lane[0] + lane[4]) + (lane[1] + lane[5])) + ((lane[2] + lane[6]) + (lane[3] + lane[7]));
  }
};

PERIMODE_EVERY_PROCESSOR double dot_part(Index n, const double* a, const double* b) {
  Sums sums;
  const Index whole = n - n % lanes;
  for (Index i = 0; i < whole; i += lanes)
    for (Index k = 0; k < lanes; ++k) sums.lane[k] += a[i + k] * b[i + k];
  for (Index i = whole; i < n; ++i) sums.lane[i - whole] += a[i] * b[i];
  return sums.total();
}

PERIMODE_EVERY_PROCESSOR void subtract_part(Index n, const double* __restrict b, double* __restrict r) {
  for (Index i = 0; i < n; ++i) r[i] = b[i] - r[i];
}

PERIMODE_EVERY_PROCESSOR void add_part(Index n, double factor, const double* __restrict from,
                                       double* __restrict to) {
  for (Index i = 0; i < n; ++i) to[i] += factor * from[i];
}

PERIMODE_EVERY_PROCESSOR void turn_part(Index n, const double* __restrict z, double beta,
                                        double* __restrict p) {
  for (Index i = 0; i < n; ++i) p[i] = z[i] + beta * p[i];
}

}  // namespace

double dot(Index n, const double* a, const double* b) {
  return sum_over_chunks(n, [=](Index at, Index count) { return dot_part(count, a + at, b + at); });
}

double subtract_from(Index n, const double* b, double* r) {
  return sum_over_chunks(n, [=](Index at, Index count) {
    subtract_part(count, b + at, r + at);
    return dot_part(count, r + at, r + at);  // from the cache
  });
}

double advance(Index n, double alpha, const double* p, const double* q, double* x, double* r) {
  return sum_over_chunks(n, [=](Index at, Index count) {
    add_part(count, alpha, p + at, x + at);
    add_part(count, -alpha, q + at, r + at);
    return dot_part(count, r + at, r + at);
  });
}

void turn(Index n, const double* z, double beta, double* p) {
  for_each_chunk(n, [=](Index at, Index count) { turn_part(count, z + at, beta, p + at); });
}

}  // namespace perimode
