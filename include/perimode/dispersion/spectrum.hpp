// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "perimode/core/types.hpp"

namespace perimode {

/// One component of motion at equally spaced points of a line (or of lines summed up to one) and instants.
struct SpaceTime {
  double spacing = 0.0;    ///< m
  double time_step = 0.0;  ///< s
  Eigen::MatrixXd values;  ///< points x instants
};

/// |U(k, omega)| of a space-time field, k = 2 pi q/(points spacing), q = 0..points/2, omega = 2 pi
/// s/(instants time_step), s = 0..instants/2.
struct Spectrum {
  std::vector<double> k;      ///< rad/m
  std::vector<double> omega;  ///< rad/s
  Eigen::MatrixXd amplitude;  ///< k x omega
};

/// Discrete Fourier transform in space (periodic line) and, under a Hann window, in time (FFTW).
/// Throws invalid_input for fewer than 4 points or instants. Cost O(N log N).
[[nodiscard]] Spectrum space_time_spectrum(const SpaceTime& field);

/// The strongest angular frequency at every k: the top of a parabola through the logarithms of the three
/// amplitudes around the largest, which is exact to some 1 % of the resolution 2 pi/(instants time_step)
/// under the Hann window; NaN where the line is silent (below 1e-6 of the spectrum's largest amplitude).
struct RidgePoint {
  double k = 0.0;
  double omega = 0.0;
  double amplitude = 0.0;
};
[[nodiscard]] std::vector<RidgePoint> spectrum_ridge(const Spectrum& spectrum);

}  // namespace perimode
