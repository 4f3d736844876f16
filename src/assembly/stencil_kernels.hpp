// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "perimode/core/types.hpp"

namespace perimode {

/// The kernels take whole groups of particles: they read and write up to so many numbers past the end of a
/// run.
constexpr Index stencil_slack = 8;
/// Particles of the groups that hold `count` of them.
constexpr Index in_groups(Index count) { return (count + stencil_slack - 1) / stencil_slack * stencil_slack; }

/// Half of a family, one of each pair of opposite members, sorted by the components that are not zero.
struct StencilPairs {
  static constexpr int patterns = 8;  ///< bit a set: component a of the offset is not zero
  const int* member;                  ///< the pair is member[p] and last - member[p]
  int start[patterns + 1];            ///< pairs of each pattern
  bool some_negative;                 ///< some k_b are negative: within each pattern their pairs come last,
  int negative[patterns];             ///< from here on
  int last;                           ///< members - 1
};

/// What a run of consecutive particles along x needs: displacements around it by family member, its own, and
/// the family's b = sqrt|k_b| n, Dim per pair. Component a lies a * stride further on.
struct StencilRun {
  const double* const* at;  ///< per family member: x component at the member of the layer's cell 0
  const double* here;       ///< x component at the layer's cell 0
  std::ptrdiff_t stride;
  const double* b;
  Index cell;   ///< of particle 0 of the run in its layer
  Index count;  ///< particles
  double* out;  ///< K u; component a at a * out_stride
  std::ptrdiff_t out_stride;
};

/// What partial families need besides: alive bits (words per particle), and calibration factors in the
/// places of the padded grid.
struct StencilBits {
  const std::uint64_t* alive;  ///< of particle 0 of the run
  int words;
  std::uint64_t* lanes;  ///< work: stencil_slack * words
  const double* factor;  ///< at particle 0; null: all 1
  const Index* step;     ///< cells to each family member
};

/// K u of particles with whole families: sum over pairs of +-b (b . ((u_i - u_+) + (u_i - u_-))).
/// Differences first: they are exact where the displacement is large and smooth, as in slender bodies.
template <int Dim>
void whole_families(const StencilPairs& pairs, const StencilRun& run);

/// K u of particles some of whose bonds are missing or scaled: every alive bond times (f_i + f_j) / 2.
template <int Dim>
void partial_families(const StencilPairs& pairs, const StencilRun& run, const StencilBits& bits);

/// Components of `count` points from one after the other to side by side: to[a * stride + t] = from[Dim t +
/// a].
template <int Dim>
void deinterleave(const double* from, Index count, std::ptrdiff_t stride, double* to);

/// And back: to[Dim t + a] = from[a * stride + t].
template <int Dim>
void interleave(const double* from, Index count, std::ptrdiff_t stride, double* to);

}  // namespace perimode
