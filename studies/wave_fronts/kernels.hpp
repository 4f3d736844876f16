// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

#include "perimode/assembly/model.hpp"
#include "perimode/dispersion/optimise.hpp"
#include "perimode/dispersion/zone.hpp"

namespace perimode::studies {

// A solid of unit spacing, Young's modulus and density, nu = 1/4, horizon of m spacings, no volume
// correction: its constant kernel, and the two whose waves are those of classical elasticity as nearly as its
// orbits allow, along the contour of the irreducible zone and over the whole zone.

/// A cube of `cells` per side around the origin, periodic along every axis.
[[nodiscard]] Model solid(int ratio, int cells, const Micromodulus& kernel = {});

/// A kernel and what its waves are like.
struct KernelWaves {
  std::string name;  ///< "original", "contour", "zone"
  int ratio = 0;     ///< m
  Micromodulus kernel;
  Lattice<3> lattice;
  ZoneSurvey<3> zone;
  ContourError error;
  double long_wave_error = 0.0;  ///< largest |c/c_classical - 1| of long waves over many directions
  /// |k| spacing up to which P and S stay within 5 % along [100], [110] and [111]: the least of the three.
  std::array<double, 2> band = {};
};

/// The original kernel of horizon m and its optima.
struct Kernels {
  KernelWaves original, contour, zone;
  OptimisedMicromodulus on_contour, on_zone;
};
[[nodiscard]] Kernels kernels_of(int ratio);

}  // namespace perimode::studies
