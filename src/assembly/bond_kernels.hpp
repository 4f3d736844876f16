// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "perimode/core/types.hpp"

namespace perimode {

/// Bonds that turn and break, eight at a time. Every operation is symmetric in sign and none is contracted to
/// a fused one (the file is compiled so), so both ends of a bond compute opposite values to the last bit
/// wherever they are computed, on any processor. docs/theory/13_breaking.md.

/// The kernels take whole groups: they read and write up to so many numbers past the end of a run.
constexpr Index bond_lanes = 8;

/// A bond found beyond its critical stretch: particle (of the run) and slot.
struct OverStretched {
  Index particle;
  Offset slot;
};

/// What varies from cell to cell of the padded grid; pointers stand at the cell of particle 0 of the run.
struct CellValues {
  const double* factor = nullptr;  ///< calibration; null: all 1
  const double* block = nullptr;   ///< null: one
  const double* limit = nullptr;   ///< critical measure per |xi|^2; null: that of GridRun
  const double* never = nullptr;   ///< infinite where bonds do not break, -infinite elsewhere
  const double* share = nullptr;   ///< energy: of the bond's that counts for this end; null: 1/2
};

/// Consecutive particles of one row of cells.
struct GridRun {
  const double* u = nullptr;  ///< x displacement of particle 0, in a padded grid
  std::ptrdiff_t stride = 0;  ///< from one component to the next
  const Index* step = nullptr;
  const double* xi = nullptr;         ///< Dim per family member, m
  const double* length = nullptr;     ///< |xi|
  const double* stiffness = nullptr;  ///< per block and family member: k_b (turning), k_b/|xi|^2 (linear)
  const double* limit = nullptr;      ///< critical measure per family member
  const double* square = nullptr;     ///< |xi|^2, with CellValues::limit
  int members = 0;
  const std::uint64_t* alive = nullptr;  ///< of particle 0
  int words = 0;                         ///< per particle
  Index count = 0;
  CellValues cells;
  double* out = nullptr;  ///< forces: component a at a * out_stride
  std::ptrdiff_t out_stride = 0;
  double* energy = nullptr;  ///< of the bonds left alive, their share per particle, J; null: not asked
  std::vector<OverStretched>* broken = nullptr;
};

/// Consecutive particles of a cloud.
struct CloudRun {
  const double* u = nullptr;  ///< of all particles, point-major
  const Offset* start = nullptr;
  const Index* neighbour = nullptr;
  const double* xi = nullptr;  ///< component a of end e at a * stride + e
  std::ptrdiff_t stride = 0;
  const double* length = nullptr;
  const double* stiffness = nullptr;
  const double* limit = nullptr;
  const std::uint64_t* alive = nullptr;
  Index first = 0;
  Index count = 0;
  double* out = nullptr;
  std::ptrdiff_t out_stride = 0;
  double* energy = nullptr;
  std::vector<OverStretched>* broken = nullptr;
};

/// Internal forces (minus the forces of the bonds on the particles), N. A bond is measured by
///   turning: (xi + y) . eta = |y|^2 - |xi|^2,   linear: xi . eta,
/// which is compared with the same measure of the critical stretch.
template <int Dim>
void bond_forces(const GridRun& run, bool turning);
template <int Dim>
void bond_forces(const CloudRun& run, bool turning);

}  // namespace perimode
