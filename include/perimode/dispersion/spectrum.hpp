// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "perimode/core/types.hpp"

namespace perimode {

/// One component of motion at equally spaced points of a line and instants.
struct SpaceTime {
  double spacing = 0.0;    ///< m
  double time_step = 0.0;  ///< s
  Eigen::MatrixXd values;  ///< points x instants, m
};

/// Amplitudes of running waves, both directions together: sqrt(|U(k, omega)|^2 + |U(k, -omega)|^2) under a
/// Hann window in time (docs/theory/18_spectra.md eq. (3)), so that A cos(k x - omega t) shows as A where k
/// and omega lie on the grid and away from their ends, A cos(k x) cos(omega t) as A/sqrt(2).
struct Spectrum {
  std::vector<double> k;      ///< rad/m; of waves along a path (wave_record.hpp): length along the path
  std::vector<double> omega;  ///< rad/s, s resolution for s = 0..instants/2
  Eigen::MatrixXd amplitude;  ///< k x omega, m
  double resolution = 0.0;    ///< 2 pi/(instants time_step), rad/s: the width of a bin
  double nyquist = 0.0;       ///< pi/time_step, rad/s: faster motion shows at 2 nyquist - omega
  Eigen::Index instants = 0;
  double time_step = 0.0;  ///< s
};

/// Of a periodic line: k = 2 pi q/(points spacing), q = 0..points/2. Two-dimensional discrete Fourier
/// transform (FFTW). Throws invalid_input for fewer than 4 points or instants, spacing or time step <= 0,
/// values that are no numbers. Cost O(N log N), N = points instants; the same for any number of threads.
[[nodiscard]] Spectrum space_time_spectrum(const SpaceTime& field);

/// A maximum of the amplitude over omega at one k, omega between the bins.
struct RidgePoint {
  double k = 0.0;
  double omega = 0.0;  ///< rad/s; NaN where the line is silent
  double amplitude = 0.0;
};

/// The strongest angular frequency at every k, omega = (s + d) resolution with
///   d = 2 (A+ - A-)/(A- + 2 A + A+)
/// from the amplitudes A-, A, A+ at the bins s - 1, s, s + 1, s the largest: exact for a single oscillation
/// under the Hann window but for what leaks over from -omega and the finite number of instants: below 1 % of
/// a bin for omega beyond 4 bins, 1e-5 for a running wave. NaN where nothing reaches 1e-6 of the spectrum's
/// largest amplitude. Cost O(size).
[[nodiscard]] std::vector<RidgePoint> spectrum_ridge(const Spectrum& spectrum);

/// Every maximum over omega that reaches `least` times the largest amplitude at its k, by ascending k and
/// omega; silent lines have none. The window's own side lobes reach 0.027 and fall with the third power of
/// the distance in bins. Throws invalid_input for least outside [0, 1].
[[nodiscard]] std::vector<RidgePoint> spectrum_peaks(const Spectrum& spectrum, double least);

}  // namespace perimode
