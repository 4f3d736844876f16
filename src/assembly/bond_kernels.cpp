// SPDX-License-Identifier: BSD-3-Clause
#include "bond_kernels.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "linalg/vector_kernels.hpp"

namespace perimode {
namespace {

constexpr int width = bond_lanes;
using Vector __attribute__((vector_size(width * sizeof(double)), aligned(8), may_alias)) = double;
using Bits __attribute__((vector_size(width * sizeof(double)), aligned(8), may_alias)) = std::int64_t;

[[gnu::always_inline]] inline Vector load(const double* from) {
  return *reinterpret_cast<const Vector*>(from);
}

[[gnu::always_inline]] inline Vector root(const Vector& of) {
  Vector result;
  for (int lane = 0; lane < width; ++lane) result[lane] = std::sqrt(of[lane]);
  return result;
}

/// A constant of eight bonds: one number, or one per lane. Numbers are left to meet vectors in the arithmetic
/// itself: that is a broadcast for the compiler, a vector made of one is more.
template <bool PerLane>
struct Constant {
  using Type = double;
};
template <>
struct Constant<true> {
  using Type = Vector;
};

/// Eight bonds, of one xi or each of its own.
template <int Dim, bool Turning, bool PerLane>
struct Stretched {
  using X = typename Constant<PerLane>::Type;
  Vector measure;
  typename Constant<Turning || PerLane>::Type along[Dim];  ///< y; linear: xi
  Vector pull;                                             ///< force = stiffness pull along
  Vector held;                                             ///< energy = stiffness pull held / 2

  [[gnu::always_inline]] inline Stretched(const X* xi, const X& length, const Vector (&eta)[Dim]) {
    if constexpr (Turning) {
      for (int a = 0; a < Dim; ++a) along[a] = xi[a] + eta[a];
      measure = eta[0] * (xi[0] + along[0]);
      Vector square = along[0] * along[0];
      for (int a = 1; a < Dim; ++a) {
        measure += eta[a] * (xi[a] + along[a]);
        square += along[a] * along[a];
      }
      const Vector now = root(square);
      pull = measure / (square + length * now);
      held = pull * square;
    } else {
      for (int a = 0; a < Dim; ++a) along[a] = xi[a];
      measure = xi[0] * eta[0];
      for (int a = 1; a < Dim; ++a) measure += xi[a] * eta[a];
      pull = measure;
      held = measure;
    }
  }
};

/// Comparisons stand only in choices: as values of their own they are taken lane by lane.
[[gnu::always_inline]] inline Vector where(const Bits& set, const Vector& value) {
  return set != 0 ? value : Vector{};
}
/// Those bits of bonds that are not beyond their limit.
template <bool PerLane>
[[gnu::always_inline]] inline Bits within(const Vector& measure,
                                          const typename Constant<PerLane>::Type& limit, const Bits& bits) {
  return measure > limit ? Bits{} : bits;
}

/// Sums of a group of bonds.
template <int Dim, bool Energy>
struct Sums {
  Vector force[Dim] = {};
  Vector energy = {};

  template <bool PerLane, class Bond>
  [[gnu::always_inline]] inline void add(const Bond& bond, const typename Constant<PerLane>::Type& stiffness,
                                         const typename Constant<PerLane>::Type& share, const Bits& carry) {
    const Vector pull = where(carry, stiffness * bond.pull);
    for (int a = 0; a < Dim; ++a) force[a] -= pull * bond.along[a];
    if constexpr (Energy) energy += share * (pull * bond.held);
  }
};

/// What a bond's stiffness, limit and share are where they vary from cell to cell.
struct Varied {
  const GridRun& run;
  std::ptrdiff_t t;

  [[gnu::always_inline]] inline Vector at(const double* values, int k) const {
    return load(values + t + run.step[k]);
  }
  [[gnu::always_inline]] inline Vector stiffness(int k) const {
    const CellValues& c = run.cells;
    const Vector one = Vector{} + 1.0;
    const Vector mine = c.factor ? load(c.factor + t) : one;
    const Vector other = c.factor ? at(c.factor, k) : one;
    if (c.block == nullptr) return (0.5 * mine + 0.5 * other) * run.stiffness[k];
    Vector here, there;
    for (int lane = 0; lane < width; ++lane) {
      here[lane] = run.stiffness[static_cast<std::ptrdiff_t>(c.block[t + lane]) * run.members + k];
      there[lane] =
          run.stiffness[static_cast<std::ptrdiff_t>(c.block[t + lane + run.step[k]]) * run.members + k];
    }
    const Vector scaled = mine * here, partner = other * there;
    const Vector product = scaled * partner;
    const Vector series = product > 0.0 ? 2.0 * product / (scaled + partner) : Vector{};
    return load(c.block + t) == at(c.block, k) ? (0.5 * mine + 0.5 * other) * here : series;
  }
  [[gnu::always_inline]] inline Vector limit(int k) const {
    const CellValues& c = run.cells;
    if (c.limit == nullptr) return run.limit[k] - Vector{};
    const Vector mine = load(c.limit + t), other = at(c.limit, k);
    const Vector smaller = mine < other ? mine : other;
    const Vector here = load(c.never + t), there = at(c.never, k);
    const Vector never = here > there ? here : there;
    return run.square[k] * (smaller > never ? smaller : never);
  }
  [[gnu::always_inline]] inline Vector share(int k) const {
    return run.cells.share ? at(run.cells.share, k) : Vector{} + 0.5;
  }
};

[[gnu::noinline]] void report(const GridRun& run, Index t, int word, const Bits& gone) {
  for (int lane = 0; lane < width; ++lane) {
    for (auto bits = static_cast<std::uint64_t>(gone[lane]); bits != 0; bits &= bits - 1)
      run.broken->push_back({t + lane, static_cast<Offset>(word) * 64 + std::countr_zero(bits)});
  }
}

[[gnu::always_inline]] inline bool any(const Bits& bits) {
  std::int64_t all = 0;
  for (int lane = 0; lane < width; ++lane) all |= bits[lane];
  return all != 0;
}

template <int Dim, bool Turning, bool Vary, bool Energy>
[[gnu::always_inline]] inline void grid_run(const GridRun& run) {
  for (Index t = 0; t < run.count; t += width) {
    const int valid = std::min<Index>(width, run.count - t);
    Vector here[Dim];
    for (int a = 0; a < Dim; ++a) here[a] = load(run.u + a * run.stride + t);
    Sums<Dim, Energy> sums;
    for (int w = 0; w < run.words; ++w) {
      Bits word = {};
      for (int lane = 0; lane < valid; ++lane)
        word[lane] =
            static_cast<std::int64_t>(run.alive[static_cast<std::ptrdiff_t>(t + lane) * run.words + w]);
      Bits gone = {};
      const int end = std::min(run.members, 64 * (w + 1));
      for (int k = 64 * w; k < end; ++k) {
        const double* other = run.u + t + run.step[k];
        Vector eta[Dim];
        for (int a = 0; a < Dim; ++a) eta[a] = load(other + a * run.stride) - here[a];
        const Stretched<Dim, Turning, false> bond(run.xi + static_cast<std::ptrdiff_t>(k) * Dim,
                                                  run.length[k], eta);
        const Bits alive = word & static_cast<std::int64_t>(std::uint64_t{1} << (k - 64 * w));
        if constexpr (Vary) {
          const Varied cell{run, t};
          const Bits kept = within<true>(bond.measure, cell.limit(k), alive);
          gone |= alive ^ kept;
          sums.template add<true>(bond, cell.stiffness(k), cell.share(k), kept);
        } else {
          const Bits kept = within<false>(bond.measure, run.limit[k], alive);
          gone |= alive ^ kept;
          sums.template add<false>(bond, run.stiffness[k], 0.5, kept);
        }
      }
      if (any(gone)) report(run, t, w, gone);
    }
    for (int a = 0; a < Dim; ++a)
      *reinterpret_cast<Vector*>(run.out + a * run.out_stride + t) = sums.force[a];
    if constexpr (Energy) *reinterpret_cast<Vector*>(run.energy + t) = 0.5 * sums.energy;
  }
}

/// Alive bits of eight ends from `e` on, those from `end` on as if broken.
inline std::uint64_t bits_from(const std::uint64_t* alive, Offset e, Offset end) {
  const Offset shift = e % 64;
  std::uint64_t bits = alive[e / 64] >> shift;
  if (shift > 64 - width && (e / 64 + 1) * 64 < end) bits |= alive[e / 64 + 1] << (64 - shift);
  const std::uint64_t valid = end - e < width ? (std::uint64_t{1} << (end - e)) - 1 : 0xffU;
  return bits & valid;
}

inline double total(const Vector& v) {
  return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}

template <int Dim, bool Turning, bool Energy>
[[gnu::always_inline]] inline void cloud_run(const CloudRun& run) {
  const Bits lane_bit = {1, 2, 4, 8, 16, 32, 64, 128};
  for (Index t = 0; t < run.count; ++t) {
    const Index i = run.first + t;
    const double* here = run.u + static_cast<std::ptrdiff_t>(i) * Dim;
    Sums<Dim, Energy> sums;
    for (Offset e = run.start[i]; e < run.start[i + 1]; e += width) {
      const std::uint64_t bits = bits_from(run.alive, e, run.start[i + 1]);
      if (bits == 0) continue;
      Vector xi[Dim], eta[Dim];
      for (int lane = 0; lane < width; ++lane) {
        const double* other = run.u + static_cast<std::ptrdiff_t>(run.neighbour[e + lane]) * Dim;
        for (int a = 0; a < Dim; ++a) eta[a][lane] = other[a] - here[a];
      }
      for (int a = 0; a < Dim; ++a) xi[a] = load(run.xi + a * run.stride + e);
      const Stretched<Dim, Turning, true> bond(xi, load(run.length + e), eta);
      const Bits alive = (static_cast<std::int64_t>(bits) + Bits{}) & lane_bit;
      const Bits kept = within<true>(bond.measure, load(run.limit + e), alive);
      sums.template add<true>(bond, load(run.stiffness + e), Vector{} + 0.5, kept);
      const Bits gone = alive ^ kept;
      if (any(gone)) {
        for (int lane = 0; lane < width; ++lane)
          if (gone[lane] != 0) run.broken->push_back({t, e + lane});
      }
    }
    for (int a = 0; a < Dim; ++a) run.out[a * run.out_stride + t] = total(sums.force[a]);
    if constexpr (Energy) run.energy[t] = 0.5 * total(sums.energy);
  }
}

template <int Dim, bool Turning>
[[gnu::always_inline]] inline void any_grid(const GridRun& run) {
  const CellValues& c = run.cells;
  const bool vary = c.factor || c.block || c.limit;
  if (run.energy == nullptr)
    vary ? grid_run<Dim, Turning, true, false>(run) : grid_run<Dim, Turning, false, false>(run);
  else
    vary || c.share ? grid_run<Dim, Turning, true, true>(run) : grid_run<Dim, Turning, false, true>(run);
}

template <int Dim, bool Turning>
[[gnu::always_inline]] inline void any_cloud(const CloudRun& run) {
  run.energy ? cloud_run<Dim, Turning, true>(run) : cloud_run<Dim, Turning, false>(run);
}

#define PERIMODE_KERNELS(D)                                                                     \
  PERIMODE_EVERY_PROCESSOR void turning_grid_##D(const GridRun& r) { any_grid<D, true>(r); }    \
  PERIMODE_EVERY_PROCESSOR void linear_grid_##D(const GridRun& r) { any_grid<D, false>(r); }    \
  PERIMODE_EVERY_PROCESSOR void turning_cloud_##D(const CloudRun& r) { any_cloud<D, true>(r); } \
  PERIMODE_EVERY_PROCESSOR void linear_cloud_##D(const CloudRun& r) { any_cloud<D, false>(r); }
PERIMODE_KERNELS(1)
PERIMODE_KERNELS(2)
PERIMODE_KERNELS(3)
#undef PERIMODE_KERNELS

}  // namespace

#define PERIMODE_BOND_KERNELS(D)                              \
  template <>                                                 \
  void bond_forces<D>(const GridRun& run, bool turning) {     \
    turning ? turning_grid_##D(run) : linear_grid_##D(run);   \
  }                                                           \
  template <>                                                 \
  void bond_forces<D>(const CloudRun& run, bool turning) {    \
    turning ? turning_cloud_##D(run) : linear_cloud_##D(run); \
  }
PERIMODE_BOND_KERNELS(1)
PERIMODE_BOND_KERNELS(2)
PERIMODE_BOND_KERNELS(3)
#undef PERIMODE_BOND_KERNELS

}  // namespace perimode
