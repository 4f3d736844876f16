// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kernels.hpp"
#include "perimode/reference/point_force.hpp"

namespace perimode::studies {

/// A force along z on the particle at the centre of a cube, a Ricker wavelet whose shear wave is `wavelength`
/// spacings long at its peak frequency; looked at when the peak of the shear front is `travelled` spacings
/// out.
struct PointSource {
  int cells = 81;  ///< of the cube, odd
  double wavelength = 6.0;
  double travelled = 20.0;
};

/// The plane y = 0 through the source.
struct Front {
  int cells = 0;
  double time = 0.0;  ///< s
  double dt = 0.0;
  std::int64_t steps = 0;
  double seconds = 0.0;            ///< of the steps
  std::vector<Point<3>> position;  ///< of the plane's particles
  std::vector<Point<3>> displacement;
  std::vector<Point<3>> exact;  ///< Stokes' solution
  double error = 0.0;           ///< relative L2 error over distances of one wavelength to `reach`
  double reach = 0.0;           ///< beyond it are waves of the images of the source
};

/// Steps the cube by central differences of dt (s), the same for all kernels.
[[nodiscard]] Front front_of(const KernelWaves& kernel, const PointSource& source, double dt);

}  // namespace perimode::studies
