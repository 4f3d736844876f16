// SPDX-License-Identifier: BSD-3-Clause
#include "step_kernels.hpp"

#include <algorithm>
#include <cstddef>

#include "linalg/vector_kernels.hpp"

namespace perimode {

namespace {

constexpr int width = 8;
using Vector __attribute__((vector_size(width * sizeof(double)), aligned(8), may_alias)) = double;

struct VectorSums {
  Vector momentum{}, strain{}, damping{};
};

[[gnu::always_inline]] inline const Vector& at(const double* from, std::ptrdiff_t i) {
  return *reinterpret_cast<const Vector*>(from + i);
}
[[gnu::always_inline]] inline Vector& at(double* from, std::ptrdiff_t i) {
  return *reinterpret_cast<Vector*>(from + i);
}

/// Eight rows of one mass without damping.
template <bool Sums>
[[gnu::always_inline]] inline void plain(const StepRows& r, std::ptrdiff_t i, VectorSums& sums) {
  const Vector y = at(r.y, i);
  const Vector v = at(r.v, i) - (r.dt / r.one_mass) * y;
  const Vector next = at(r.q, i) + r.dt * v;
  at(r.v, i) = v;
  at(r.next, i) = next;
  if constexpr (Sums) {
    sums.momentum += r.one_mass * v * v;
    sums.strain += y * next;
  }
}

/// Eight rows of any kind.
[[gnu::always_inline]] inline void any(const StepRows& r, std::ptrdiff_t i, VectorSums& sums) {
  const Vector y = at(r.y, i);
  Vector mass = Vector{} + r.one_mass;
  Vector rate = {}, lag = {};
  if (r.mass != nullptr) mass = at(r.mass, i);
  if (r.rate != nullptr) rate = at(r.rate, i);
  if (r.lag != nullptr) lag = at(r.lag, i);
  const Vector before = at(r.v, i);
  const Vector half = 0.5 * r.dt * rate;
  const Vector v = ((1.0 - half) * before - (r.dt / mass) * (y + lag)) / (1.0 + half);
  const Vector next = at(r.q, i) + r.dt * v;
  at(r.v, i) = v;
  at(r.next, i) = next;
  const Vector mean = 0.5 * (before + v);
  sums.momentum += mass * v * v;
  sums.strain += y * next;
  sums.damping += mean * (rate * mass * mean + lag);
}

/// Calls step(rows, i, sums) for eight rows at a time; the last ones are filled up with rows at rest.
template <class Step>
[[gnu::always_inline]] inline StepSums over(const StepRows& rows, const Step& step) {
  const StepRows r = rows;  // of its own: the stores below may change anything else
  VectorSums sums;
  const std::ptrdiff_t whole = r.count / width * width;
  for (std::ptrdiff_t i = 0; i < whole; i += width) {
    if (i < r.ahead) __builtin_prefetch(r.v + r.count + i, 1);
    step(r, i, sums);
  }
  if (const std::ptrdiff_t left = r.count - whole; left > 0) {
    double y[width] = {}, q[width] = {}, v[width] = {}, next[width], mass[width], rate[width] = {},
           lag[width] = {};
    std::fill_n(mass, width, 1.0);
    StepRows last{width, 0, r.dt, y, q, v, next, r.one_mass, nullptr, nullptr, nullptr};
    const auto take = [&](const double* from, double* to) {
      if (from == nullptr) return static_cast<double*>(nullptr);
      std::copy_n(from + whole, left, to);
      return to;
    };
    take(r.y, y);
    take(r.q, q);
    take(r.v, v);
    last.mass = take(r.mass, mass);
    last.rate = take(r.rate, rate);
    last.lag = take(r.lag, lag);
    step(last, 0, sums);
    std::copy_n(v, left, r.v + whole);
    std::copy_n(next, left, r.next + whole);
  }
  StepSums total;
  for (int lane = 0; lane < width; ++lane) {
    total.momentum += sums.momentum[lane];
    total.strain += sums.strain[lane];
    total.damping += r.dt * sums.damping[lane];
  }
  return total;
}

PERIMODE_EVERY_PROCESSOR StepSums step_plain(const StepRows& rows) {
  return over(rows, [](const StepRows& r, std::ptrdiff_t i, VectorSums& s) { plain<false>(r, i, s); });
}
PERIMODE_EVERY_PROCESSOR StepSums step_plain_sums(const StepRows& rows) {
  return over(rows, [](const StepRows& r, std::ptrdiff_t i, VectorSums& s) { plain<true>(r, i, s); });
}
PERIMODE_EVERY_PROCESSOR StepSums step_any(const StepRows& rows) {
  return over(rows, [](const StepRows& r, std::ptrdiff_t i, VectorSums& s) { any(r, i, s); });
}

}  // namespace

StepSums step_rows(const StepRows& rows, bool sums) {
  if (rows.mass != nullptr || rows.rate != nullptr || rows.lag != nullptr) return step_any(rows);
  return sums ? step_plain_sums(rows) : step_plain(rows);
}

}  // namespace perimode
