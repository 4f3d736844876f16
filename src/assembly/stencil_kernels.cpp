// SPDX-License-Identifier: BSD-3-Clause
#include "stencil_kernels.hpp"

#include <algorithm>

#include "linalg/vector_kernels.hpp"

namespace perimode {
namespace {

constexpr int width = 8;
using Vector __attribute__((vector_size(width * sizeof(double)), aligned(8), may_alias)) = double;
using Bits __attribute__((vector_size(width * sizeof(double)), aligned(8), may_alias)) = std::int64_t;
static_assert(stencil_slack == width);

/// Adds the pairs whose offsets have the components of Pattern to y, for Groups * width particles.
template <int Dim, int Pattern, int Groups, bool Negative>
[[gnu::always_inline]] inline void add_whole_pairs(const StencilPairs& pairs, int begin, int end,
                                                   const StencilRun& run, std::ptrdiff_t t,
                                                   const Vector (&here)[Dim][Groups],
                                                   Vector (&y)[Dim][Groups]) {
  for (int p = begin; p < end; ++p) {
    const double* up = run.at[pairs.member[p]] + run.cell + t;
    const double* um = run.at[pairs.last - pairs.member[p]] + run.cell + t;
    const double* b = run.b + p * Dim;
    Vector s[Groups] = {};
    for (int a = 0; a < Dim; ++a) {
      if ((Pattern >> a & 1) == 0) continue;
      for (int g = 0; g < Groups; ++g) {
        const Vector plus = *reinterpret_cast<const Vector*>(up + a * run.stride + g * width);
        const Vector minus = *reinterpret_cast<const Vector*>(um + a * run.stride + g * width);
        s[g] += b[a] * ((here[a][g] - plus) + (here[a][g] - minus));
      }
    }
    for (int a = 0; a < Dim; ++a) {
      if ((Pattern >> a & 1) == 0) continue;
      for (int g = 0; g < Groups; ++g) {
        if constexpr (Negative)
          y[a][g] -= b[a] * s[g];
        else
          y[a][g] += b[a] * s[g];
      }
    }
  }
}

/// The pairs of a pattern, those of negative k_b after the others.
template <int Dim, int Pattern, int Groups, bool Signed>
[[gnu::always_inline]] inline void add_whole_pattern(const StencilPairs& pairs, const StencilRun& run,
                                                     std::ptrdiff_t t, const Vector (&here)[Dim][Groups],
                                                     Vector (&y)[Dim][Groups]) {
  const int first = pairs.start[Pattern], last = pairs.start[Pattern + 1];
  const int negative = Signed ? pairs.negative[Pattern] : last;
  add_whole_pairs<Dim, Pattern, Groups, false>(pairs, first, negative, run, t, here, y);
  if constexpr (Signed) add_whole_pairs<Dim, Pattern, Groups, true>(pairs, negative, last, run, t, here, y);
}

template <int Dim, int Groups, bool Signed>
[[gnu::always_inline]] inline void whole_group(const StencilPairs& pairs, const StencilRun& run,
                                               std::ptrdiff_t t) {
  Vector here[Dim][Groups];
  Vector y[Dim][Groups] = {};
  for (int a = 0; a < Dim; ++a) {
    for (int g = 0; g < Groups; ++g)
      here[a][g] = *reinterpret_cast<const Vector*>(run.here + run.cell + a * run.stride + t + g * width);
  }
  add_whole_pattern<Dim, 1, Groups, Signed>(pairs, run, t, here, y);
  if constexpr (Dim > 1) {
    add_whole_pattern<Dim, 2, Groups, Signed>(pairs, run, t, here, y);
    add_whole_pattern<Dim, 3, Groups, Signed>(pairs, run, t, here, y);
  }
  if constexpr (Dim > 2) {
    add_whole_pattern<Dim, 4, Groups, Signed>(pairs, run, t, here, y);
    add_whole_pattern<Dim, 5, Groups, Signed>(pairs, run, t, here, y);
    add_whole_pattern<Dim, 6, Groups, Signed>(pairs, run, t, here, y);
    add_whole_pattern<Dim, 7, Groups, Signed>(pairs, run, t, here, y);
  }
  for (int a = 0; a < Dim; ++a) {
    for (int g = 0; g < Groups; ++g)
      *reinterpret_cast<Vector*>(run.out + a * run.out_stride + t + g * width) = y[a][g];
  }
}

template <int Dim, bool Signed>
[[gnu::always_inline]] inline void whole(const StencilPairs& pairs, const StencilRun& run) {
  Index t = 0;
  for (; t + width < run.count; t += 2 * width) whole_group<Dim, 2, Signed>(pairs, run, t);
  if (t < run.count) whole_group<Dim, 1, Signed>(pairs, run, t);
}

/// Weight per lane of the bond to a family member: 0 where it is not alive, (f_i + f_j) / 2 where it is.
template <bool Factors>
[[gnu::always_inline]] inline void bond_weights(const StencilBits& bits, int member, std::ptrdiff_t t,
                                                const Vector& half, Vector& weight) {
  const Bits word = *reinterpret_cast<const Bits*>(bits.lanes + (member / 64) * width);
  const Bits alive = (word & static_cast<std::int64_t>(std::uint64_t{1} << (member % 64))) != 0;
  if constexpr (Factors) {
    const Vector value = half + 0.5 * *reinterpret_cast<const Vector*>(bits.factor + t + bits.step[member]);
    weight = (Vector)((Bits)value & alive);
  } else {
    const Vector value = half;
    weight = (Vector)((Bits)value & alive);
  }
}

template <int Dim, int Pattern, bool Factors, bool Negative>
[[gnu::always_inline]] inline void add_partial_pairs(const StencilPairs& pairs, int begin, int end,
                                                     const StencilRun& run, const StencilBits& bits,
                                                     std::ptrdiff_t t, const Vector (&here)[Dim],
                                                     const Vector& half, Vector (&y)[Dim]) {
  for (int p = begin; p < end; ++p) {
    const int k = pairs.member[p];
    const double* up = run.at[k] + run.cell + t;
    const double* um = run.at[pairs.last - k] + run.cell + t;
    const double* b = run.b + p * Dim;
    Vector plus, minus;
    bond_weights<Factors>(bits, k, t, half, plus);
    bond_weights<Factors>(bits, pairs.last - k, t, half, minus);
    Vector s = {};
    for (int a = 0; a < Dim; ++a) {
      if ((Pattern >> a & 1) == 0) continue;
      s += b[a] * (plus * (here[a] - *reinterpret_cast<const Vector*>(up + a * run.stride)) +
                   minus * (here[a] - *reinterpret_cast<const Vector*>(um + a * run.stride)));
    }
    for (int a = 0; a < Dim; ++a) {
      if ((Pattern >> a & 1) == 0) continue;
      if constexpr (Negative)
        y[a] -= b[a] * s;
      else
        y[a] += b[a] * s;
    }
  }
}

template <int Dim, int Pattern, bool Factors, bool Signed>
[[gnu::always_inline]] inline void add_partial_pattern(const StencilPairs& pairs, const StencilRun& run,
                                                       const StencilBits& bits, std::ptrdiff_t t,
                                                       const Vector (&here)[Dim], const Vector& half,
                                                       Vector (&y)[Dim]) {
  const int first = pairs.start[Pattern], last = pairs.start[Pattern + 1];
  const int negative = Signed ? pairs.negative[Pattern] : last;
  add_partial_pairs<Dim, Pattern, Factors, false>(pairs, first, negative, run, bits, t, here, half, y);
  if constexpr (Signed)
    add_partial_pairs<Dim, Pattern, Factors, true>(pairs, negative, last, run, bits, t, here, half, y);
}

template <int Dim, bool Factors, bool Signed>
[[gnu::always_inline]] inline void partial(const StencilPairs& pairs, const StencilRun& run,
                                           const StencilBits& bits) {
  for (Index t = 0; t < run.count; t += width) {
    const int valid = std::min<Index>(width, run.count - t);
    for (int w = 0; w < bits.words; ++w) {
      for (int lane = 0; lane < width; ++lane) {
        bits.lanes[w * width + lane] =
            lane < valid ? bits.alive[static_cast<std::ptrdiff_t>(t + lane) * bits.words + w] : 0;
      }
    }
    Vector here[Dim];
    Vector y[Dim] = {};
    for (int a = 0; a < Dim; ++a)
      here[a] = *reinterpret_cast<const Vector*>(run.here + run.cell + a * run.stride + t);
    Vector half = Vector{} + 1.0;
    if constexpr (Factors) half = 0.5 * *reinterpret_cast<const Vector*>(bits.factor + t);
    add_partial_pattern<Dim, 1, Factors, Signed>(pairs, run, bits, t, here, half, y);
    if constexpr (Dim > 1) {
      add_partial_pattern<Dim, 2, Factors, Signed>(pairs, run, bits, t, here, half, y);
      add_partial_pattern<Dim, 3, Factors, Signed>(pairs, run, bits, t, here, half, y);
    }
    if constexpr (Dim > 2) {
      add_partial_pattern<Dim, 4, Factors, Signed>(pairs, run, bits, t, here, half, y);
      add_partial_pattern<Dim, 5, Factors, Signed>(pairs, run, bits, t, here, half, y);
      add_partial_pattern<Dim, 6, Factors, Signed>(pairs, run, bits, t, here, half, y);
      add_partial_pattern<Dim, 7, Factors, Signed>(pairs, run, bits, t, here, half, y);
    }
    for (int a = 0; a < Dim; ++a) *reinterpret_cast<Vector*>(run.out + a * run.out_stride + t) = y[a];
  }
}

template <int Dim, bool Signed>
[[gnu::always_inline]] inline void partial_any(const StencilPairs& pairs, const StencilRun& run,
                                               const StencilBits& bits) {
  if (bits.factor != nullptr)
    partial<Dim, true, Signed>(pairs, run, bits);
  else
    partial<Dim, false, Signed>(pairs, run, bits);
}

template <int Dim>
[[gnu::always_inline]] inline void apart(const double* __restrict from, Index count, std::ptrdiff_t stride,
                                         double* __restrict to) {
  for (std::ptrdiff_t t = 0; t < count; ++t) {
    for (int a = 0; a < Dim; ++a) to[a * stride + t] = from[Dim * t + a];
  }
}

template <int Dim>
[[gnu::always_inline]] inline void together(const double* __restrict from, Index count, std::ptrdiff_t stride,
                                            double* __restrict to) {
  for (std::ptrdiff_t t = 0; t < count; ++t) {
    for (int a = 0; a < Dim; ++a) to[Dim * t + a] = from[a * stride + t];
  }
}

#define PERIMODE_STENCIL(D)                                                                    \
  PERIMODE_EVERY_PROCESSOR void whole_##D(const StencilPairs& p, const StencilRun& r) {        \
    whole<D, false>(p, r);                                                                     \
  }                                                                                            \
  PERIMODE_EVERY_PROCESSOR void partial_##D(const StencilPairs& p, const StencilRun& r,        \
                                            const StencilBits& b) {                            \
    partial_any<D, false>(p, r, b);                                                            \
  }                                                                                            \
  PERIMODE_EVERY_PROCESSOR void signed_whole_##D(const StencilPairs& p, const StencilRun& r) { \
    whole<D, true>(p, r);                                                                      \
  }                                                                                            \
  PERIMODE_EVERY_PROCESSOR void signed_partial_##D(const StencilPairs& p, const StencilRun& r, \
                                                   const StencilBits& b) {                     \
    partial_any<D, true>(p, r, b);                                                             \
  }
PERIMODE_STENCIL(1)
PERIMODE_STENCIL(2)
PERIMODE_STENCIL(3)
#undef PERIMODE_STENCIL

PERIMODE_EVERY_PROCESSOR void apart_2(const double* from, Index n, std::ptrdiff_t stride, double* to) {
  apart<2>(from, n, stride, to);
}
PERIMODE_EVERY_PROCESSOR void apart_3(const double* from, Index n, std::ptrdiff_t stride, double* to) {
  apart<3>(from, n, stride, to);
}
PERIMODE_EVERY_PROCESSOR void together_2(const double* from, Index n, std::ptrdiff_t stride, double* to) {
  together<2>(from, n, stride, to);
}
PERIMODE_EVERY_PROCESSOR void together_3(const double* from, Index n, std::ptrdiff_t stride, double* to) {
  together<3>(from, n, stride, to);
}

}  // namespace

#define PERIMODE_FAMILIES(D)                                                                            \
  template <>                                                                                           \
  void whole_families<D>(const StencilPairs& pairs, const StencilRun& run) {                            \
    pairs.some_negative ? signed_whole_##D(pairs, run) : whole_##D(pairs, run);                         \
  }                                                                                                     \
  template <>                                                                                           \
  void partial_families<D>(const StencilPairs& pairs, const StencilRun& run, const StencilBits& bits) { \
    pairs.some_negative ? signed_partial_##D(pairs, run, bits) : partial_##D(pairs, run, bits);         \
  }
PERIMODE_FAMILIES(1)
PERIMODE_FAMILIES(2)
PERIMODE_FAMILIES(3)
#undef PERIMODE_FAMILIES

template <>
void deinterleave<1>(const double* from, Index count, std::ptrdiff_t, double* to) {
  std::copy_n(from, count, to);
}
template <>
void deinterleave<2>(const double* from, Index count, std::ptrdiff_t stride, double* to) {
  apart_2(from, count, stride, to);
}
template <>
void deinterleave<3>(const double* from, Index count, std::ptrdiff_t stride, double* to) {
  apart_3(from, count, stride, to);
}
template <>
void interleave<1>(const double* from, Index count, std::ptrdiff_t, double* to) {
  std::copy_n(from, count, to);
}
template <>
void interleave<2>(const double* from, Index count, std::ptrdiff_t stride, double* to) {
  together_2(from, count, stride, to);
}
template <>
void interleave<3>(const double* from, Index count, std::ptrdiff_t stride, double* to) {
  together_3(from, count, stride, to);
}

}  // namespace perimode
