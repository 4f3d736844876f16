// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "perimode/core/error.hpp"

namespace perimode {

enum class Plane { stress, strain };

/// Shape g(r) of the micromodulus c(r) = c0 g(r), r = |xi|:
/// constant 1, conical 1 - r/delta, gaussian exp(-(p r/delta)^2), inverse_distance delta/r;
/// fourier a0 + sum_j a_j cos(j w r/spacing) [alebrahim2021] eq. (50), shells a number per orbit of a
/// lattice: these two multiply the constant kernel's c0 as they are and belong to grids.
enum class Kernel { constant, conical, gaussian, inverse_distance, fourier, shells };

/// Multiplier of the bonds whose sorted absolute offset, in spacings, is `offset` (x >= y >= z >= 0; what a
/// lattice of lower dimension lacks is 0).
struct Shell {
  std::array<int, 3> offset = {};
  double alpha = 0.0;
};

/// continuum: c0 from the moment integral over the full continuum family.
/// discrete / discrete_cut: per particle, so that its family (before / after pre-cracks are cut)
/// stores the continuum energy of pure dilation.
enum class Calibration { continuum, discrete, discrete_cut };

struct Micromodulus {
  Kernel kernel = Kernel::constant;
  double p = 2.0;                  ///< gaussian only
  double a0 = 0.0;                 ///< fourier
  std::vector<double> a = {};      ///< fourier: a_1, a_2, ...
  double w = 0.0;                  ///< fourier
  double spacing = 0.0;            ///< fourier: of the grid, m
  std::vector<Shell> shells = {};  ///< shells: one for every orbit of the family
};

struct Material {
  double youngs_modulus = 0.0;  ///< Pa
  double density = 0.0;         ///< kg/m3
  Micromodulus micromodulus = {};
  std::optional<double> fracture_energy = {};   ///< J/m2
  std::optional<double> critical_stretch = {};  ///< -
  bool break_negative = false;  ///< bonds may break although some have a negative micromodulus
  Where where = {};
};

}  // namespace perimode
