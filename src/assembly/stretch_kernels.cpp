// SPDX-License-Identifier: BSD-3-Clause
#include "stretch_kernels.hpp"

#include <algorithm>

#include "linalg/vector_kernels.hpp"

namespace perimode {
namespace {

constexpr int width = stretch_lanes;
using Vector __attribute__((vector_size(width * sizeof(double)), aligned(8), may_alias)) = double;
using Bits __attribute__((vector_size(width * sizeof(double)), aligned(8), may_alias)) = std::int64_t;

[[gnu::always_inline]] inline Vector load(const double* from) {
  return *reinterpret_cast<const Vector*>(from);
}

/// Stiffness times share, and 1/(|xi| s_c), of eight bonds to member k.
template <bool Vary>
struct Bond;

template <>
struct Bond<false> {
  double stiffness, rate;
  [[gnu::always_inline]] inline Bond(const StretchRun& run, std::ptrdiff_t, int k)
      : stiffness(run.stiffness[k]), rate(run.rate[k]) {}
};

template <>
struct Bond<true> {
  Vector stiffness, rate;
  [[gnu::always_inline]] inline Bond(const StretchRun& run, std::ptrdiff_t t, int k) {
    const std::ptrdiff_t there = t + run.step[k];
    const Vector mine = load(run.limit + t), other = load(run.limit + there);
    const Vector least = mine < other ? mine : other, most = mine < other ? other : mine;
    rate = run.rate[k] * (least < 0.0 ? Vector{} : most);
    const Vector one = Vector{} + 1.0;
    const Vector f = run.factor ? load(run.factor + t) : one;
    const Vector g = run.factor ? load(run.factor + there) : one;
    if (run.block == nullptr) {
      stiffness = (0.5 * f + 0.5 * g) * run.stiffness[k];
    } else {
      Vector a, b;
      for (int lane = 0; lane < width; ++lane) {
        a[lane] = run.stiffness[static_cast<std::ptrdiff_t>(run.block[t + lane]) * run.members + k];
        b[lane] = run.stiffness[static_cast<std::ptrdiff_t>(run.block[there + lane]) * run.members + k];
      }
      const Vector scaled = f * a, partner = g * b;
      stiffness = load(run.block + t) == load(run.block + there)
                      ? (0.5 * f + 0.5 * g) * a
                      : (scaled * partner > 0.0 ? 2.0 * (scaled * partner) / (scaled + partner) : Vector{});
    }
    stiffness *= load(run.share + there);
  }
};

template <int Dim>
[[gnu::always_inline]] inline Vector elongation(const StretchRun& run, const double* u, std::ptrdiff_t t,
                                                int k, const Vector (&here)[Dim]) {
  const double* other = u + t + run.step[k];
  const double* n = run.direction + static_cast<std::ptrdiff_t>(k) * Dim;
  Vector e = n[0] * (load(other) - here[0]);
  for (int a = 1; a < Dim; ++a) e += n[a] * (load(other + a * run.stride) - here[a]);
  return e;
}

inline double total(const Vector& v) {
  return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}

template <int Dim, bool Both, bool Vary>
[[gnu::always_inline]] inline StretchSums search(const StretchRun& run) {
  Vector factor = Vector{} + infinity, worst = {}, energy[3] = {};
  for (std::ptrdiff_t t = 0; t < run.count; t += width) {
    const int valid = static_cast<int>(std::min<std::ptrdiff_t>(width, run.count - t));
    Vector here_0[Dim] = {}, here_1[Dim];
    for (int a = 0; a < Dim; ++a) {
      here_1[a] = load(run.u_1 + a * run.stride + t);
      if constexpr (Both) here_0[a] = load(run.u_0 + a * run.stride + t);
    }
    for (int w = run.first / 64; w < run.words; ++w) {
      Bits word = {};
      for (int lane = 0; lane < valid; ++lane)
        word[lane] = static_cast<std::int64_t>(run.alive[(t + lane) * run.words + w]);
      const int end = std::min(run.members, 64 * (w + 1));
      for (int k = std::max(run.first, 64 * w); k < end; ++k) {
        const Bits alive = word & static_cast<std::int64_t>(std::uint64_t{1} << (k - 64 * w));
        const Bond<Vary> bond(run, t, k);
        Vector e_1 = elongation<Dim>(run, run.u_1, t, k, here_1);
        e_1 = alive != 0 ? e_1 : Vector{};
        const Vector q_1 = bond.rate * e_1;
        const Vector force = bond.stiffness * e_1;
        energy[2] += force * e_1;
        if constexpr (Both) {
          Vector e_0 = elongation<Dim>(run, run.u_0, t, k, here_0);
          e_0 = alive != 0 ? e_0 : Vector{};
          energy[1] += force * e_0;
          energy[0] += bond.stiffness * e_0 * e_0;
          const Vector at = (1.0 - bond.rate * e_0) / q_1;
          const Vector reached = q_1 > 0.0 ? at : Vector{} + infinity;
          factor = reached < factor ? reached : factor;
        } else {
          worst = q_1 > worst ? q_1 : worst;
        }
      }
    }
  }
  StretchSums sums;
  for (int lane = 0; lane < width; ++lane) {
    sums.factor = std::min(sums.factor, static_cast<double>(factor[lane]));
    sums.worst = std::max(sums.worst, static_cast<double>(worst[lane]));
  }
  for (std::size_t k = 0; k < 3; ++k) sums.energy[k] = 0.5 * total(energy[k]);
  return sums;
}

template <int Dim>
[[gnu::always_inline]] inline StretchSums any(const StretchRun& run) {
  if (run.limit != nullptr) return run.u_0 ? search<Dim, true, true>(run) : search<Dim, false, true>(run);
  return run.u_0 ? search<Dim, true, false>(run) : search<Dim, false, false>(run);
}

PERIMODE_EVERY_PROCESSOR void search_1(const StretchRun& run, StretchSums& sums) { sums = any<1>(run); }
PERIMODE_EVERY_PROCESSOR void search_2(const StretchRun& run, StretchSums& sums) { sums = any<2>(run); }
PERIMODE_EVERY_PROCESSOR void search_3(const StretchRun& run, StretchSums& sums) { sums = any<3>(run); }

}  // namespace

template <>
StretchSums stretches_of<1>(const StretchRun& run) {
  StretchSums sums;
  search_1(run, sums);
  return sums;
}
template <>
StretchSums stretches_of<2>(const StretchRun& run) {
  StretchSums sums;
  search_2(run, sums);
  return sums;
}
template <>
StretchSums stretches_of<3>(const StretchRun& run) {
  StretchSums sums;
  search_3(run, sums);
  return sums;
}

}  // namespace perimode
