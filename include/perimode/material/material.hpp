// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "perimode/core/error.hpp"

namespace perimode {

enum class Plane { stress, strain };

/// Shape g(r) of the micromodulus c(r) = c0 g(r), r = |xi|:
/// constant 1, conical 1 - r/delta, gaussian exp(-(p r/delta)^2), inverse_distance delta/r.
enum class Kernel { constant, conical, gaussian, inverse_distance };

/// continuum: c0 from the moment integral over the full continuum family.
/// discrete / discrete_cut: per particle, so that its family (before / after pre-cracks are cut)
/// stores the continuum energy of pure dilation.
enum class Calibration { continuum, discrete, discrete_cut };

struct Micromodulus {
  Kernel kernel = Kernel::constant;
  double p = 2.0;  ///< gaussian only
};

struct Material {
  double youngs_modulus = 0.0;  ///< Pa
  double density = 0.0;         ///< kg/m3
  Micromodulus micromodulus = {};
  std::optional<double> fracture_energy = {};   ///< J/m2
  std::optional<double> critical_stretch = {};  ///< -
  Where where = {};
};

}  // namespace perimode
