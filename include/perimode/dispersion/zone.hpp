// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "perimode/dispersion/waves.hpp"

namespace perimode {

/// What the whole Brillouin zone holds, from a grid of n points per axis over [0, pi/spacing] (both ends
/// included; the rest of the zone is its mirror images, and axes may be exchanged).
template <int Dim>
struct ZoneSurvey {
  int points_per_axis = 0;
  double least_squared = 0.0;  ///< smallest omega^2 away from k = 0, 1/s2: negative means unstable
  Point<Dim> least_at = Point<Dim>::Zero();
  double least_speed_squared =
      0.0;                 ///< smallest omega^2/|k|^2 (k = 0: its limits along the axes and diagonals)
  double omega_max = 0.0;  ///< largest omega, refined beyond the grid by Newton steps, rad/s
  Point<Dim> omega_max_at = Point<Dim>::Zero();
  double stable_step = 0.0;  ///< 2/omega_max, s
  /// Root mean square over the grid of (omega - c |k|)/(c |k|), of P and of S (3D: both; 1D: 0); k = 0 left
  /// out, omega 0 where omega^2 < 0.
  std::array<double, 2> phase_error = {};
  std::array<double, 2> worst_phase_error = {};  ///< largest |omega/(c |k|) - 1|
};

/// In parallel, the same for any number of threads. Throws invalid_input for n < 2.
/// Cost O(n^Dim/Dim! reach + n^(Dim-1) reach^Dim). docs/theory/16_dispersion.md eqs. (6) to (10).
template <int Dim>
[[nodiscard]] ZoneSurvey<Dim> survey_zone(const Lattice<Dim>& lattice, int points_per_axis);

/// Waves of directions spread evenly over the plane of x and y (1D: one), all at |k| (rad/m; 0: the long-wave
/// limit): polar diagrams. Throws invalid_input for fewer than one direction.
template <int Dim>
[[nodiscard]] std::vector<PlaneWaves<Dim>> waves_around(const Lattice<Dim>& lattice, double k,
                                                        int directions);

/// Where a branch leaves a classical wave, along a straight line k = s direction, 0 < s <= longest (rad/m).
struct BranchBand {
  double long_wave_ratio = 0.0;  ///< phase speed of long waves over the classical one
  std::vector<double>
      crossings;           ///< angular frequencies at which the branch meets omega = c k, ascending, rad/s
  double cut_off = 0.0;    ///< largest angular frequency on the line, rad/s
  double cut_off_k = 0.0;  ///< where, rad/m
  double band_k = 0.0;     ///< up to which |omega/(c k) - 1| <= error holds without a gap, rad/m
  double band_frequency = 0.0;   ///< omega there, rad/s; 0 where long waves miss the band already
  double worst_overshoot = 0.0;  ///< largest omega/(c k) - 1 on the line
  double worst_overshoot_k = 0.0;
};

/// To 1e-10 relative (bisection between samples fine against 1/reach). `error` e.g. 0.05. The shear branch of
/// 3D is the slower; omega^2 < 0 counts as omega = 0. Throws invalid_input: a direction of length 0, longest
/// <= 0, a shear wave in 1D.
template <int Dim>
[[nodiscard]] BranchBand branch_band(const Lattice<Dim>& lattice, Branch branch, const Point<Dim>& direction,
                                     double longest, double error);

/// What a time integrator makes of a wave of the angular frequency omega (exact): central difference
/// (2/dt) asin(omega dt/2), NaN beyond 2/dt; Newmark (1/4, 1/2) (2/dt) atan(omega dt/2).
[[nodiscard]] double central_difference_frequency(double omega, double dt);
[[nodiscard]] double newmark_frequency(double omega, double dt);

/// The 1D wave equation by second-order finite differences in space and time, courant = speed dt/dx:
/// omega = (2/dt) asin(courant sin(k dx/2)) [bouaraquia2024] eq. (51). courant 0: time exact; NaN where
/// the scheme is unstable.
[[nodiscard]] double finite_difference_frequency(double k, double speed, double dx, double courant);

}  // namespace perimode
