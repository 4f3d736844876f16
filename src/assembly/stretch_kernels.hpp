// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "perimode/core/types.hpp"

namespace perimode {

/// The kernels take whole groups of particles: they read up to so many numbers past the end of a run.
constexpr Index stretch_lanes = 8;

/// What bonds of some particles came to.
struct StretchSums {
  double factor =
      std::numeric_limits<double>::infinity();  ///< smallest (1 - q_0)/q_1 with q = s/s_c, q_1 > 0
  double worst = 0.0;                           ///< largest q_1; 0: none is stretched
  std::array<double, 3> energy = {};            ///< 1/2 sum k e e: e_0 e_0, e_0 e_1, e_1 e_1

  void add(const StretchSums& more) {
    factor = more.factor < factor ? more.factor : factor;
    worst = more.worst > worst ? more.worst : worst;
    for (std::size_t k = 0; k < energy.size(); ++k) energy[k] += more.energy[k];
  }
};

/// Consecutive particles of one row of cells and the members of their families from `first` on. Pointers to
/// values of cells stand at the cell of particle 0.
struct StretchRun {
  const double* u_0 = nullptr;  ///< x displacement, component a at a * stride; null: none
  const double* u_1 = nullptr;
  std::ptrdiff_t stride = 0;
  const Index* step = nullptr;
  const double* direction = nullptr;  ///< n, Dim per member
  const double* rate = nullptr;       ///< per member: 1/(|xi| s_c); with `limit` 1/|xi|
  const double* stiffness = nullptr;  ///< k_b per block and member
  int first = 0, members = 0;
  const std::uint64_t* alive = nullptr;
  int words = 0;
  Index count = 0;
  // By cell where bonds vary; all null, or limit and share at least are there.
  const double* limit = nullptr;   ///< 1/s_c; below 0: none of its bonds breaks
  const double* share = nullptr;   ///< of the energy of bonds to here
  const double* factor = nullptr;  ///< calibration; null: all 1
  const double* block = nullptr;   ///< null: one
};

/// With u_0: factor and all energies. Without: worst and energy[2].
template <int Dim>
[[nodiscard]] StretchSums stretches_of(const StretchRun& run);

}  // namespace perimode
