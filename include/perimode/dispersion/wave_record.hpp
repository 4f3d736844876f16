// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>
#include <memory>
#include <span>
#include <vector>

#include "perimode/dispersion/spectrum.hpp"
#include "perimode/geometry/grid.hpp"

namespace perimode {

/// The plane waves that fit a periodic grid and lie on a path.
template <int Dim>
struct GridWaves {
  std::vector<std::array<Index, Dim>> number;  ///< whole waves per period q; k_a = 2 pi q_a/(cells_a spacing)
  std::vector<Point<Dim>> k;                   ///< rad/m
  /// Along k, a unit vector; at k = 0 along the side of the path that begins there (or ends, for the last).
  std::vector<Point<Dim>> direction;
  std::vector<double> length;  ///< along the path, rad/m, ascending; a corner of two sides stands once
};

/// The waves of `grid` on the polygon through `corners` (pi/spacing, as zone_path): all k with whole numbers
/// q on a side, to 1e-6 of one. Corners that fit no whole number are left out, so a path may begin with a
/// wave beyond its first corner. Throws invalid_input: fewer than two corners, two equal ones in a row, fewer
/// than two waves. Cost O(waves).
template <int Dim>
[[nodiscard]] GridWaves<Dim> waves_on_path(const Grid<Dim>& grid, const std::vector<Point<Dim>>& corners);

/// Amplitudes of plane waves in the motion of a full periodic grid, taken frame by frame:
///   U_k(t) = (1/particles) sum_i u_i(t) exp(-i k . (x_i - x_0)),
/// from one fast Fourier transform of the whole grid per component. No other wave of the grid contributes, so
/// P and S and every k stand alone, which a line of particles cannot do (docs/theory/18_spectra.md). Memory
/// 16 Dim waves bytes per frame and two copies of the grid; cost O(particles log particles) per frame.
template <int Dim>
class WaveRecorder {
 public:
  /// `frames`: how many to make room for. Throws invalid_input for no waves.
  WaveRecorder(const Grid<Dim>& grid, GridWaves<Dim> waves, std::size_t frames = 0);
  ~WaveRecorder();
  WaveRecorder(WaveRecorder&&) noexcept;
  WaveRecorder& operator=(WaveRecorder&&) noexcept;
  WaveRecorder(const WaveRecorder&) = delete;
  WaveRecorder& operator=(const WaveRecorder&) = delete;

  /// Displacements of all cells in cell order, point-major, at `time` (s). Throws invalid_input: another
  /// size, values that are no numbers, a time that is not one step (that of the first two frames, to 1e-6 of
  /// it) after the last.
  void add(double time, std::span<const double> displacement);

  [[nodiscard]] const GridWaves<Dim>& waves() const { return waves_; }
  [[nodiscard]] std::size_t frames() const { return times_.size(); }
  [[nodiscard]] double time_step() const;  ///< s; 0 before the second frame
  /// U of one wave at one frame, m.
  [[nodiscard]] Eigen::Matrix<std::complex<double>, Dim, 1> amplitude(std::size_t frame,
                                                                      std::size_t wave) const;

 private:
  struct Transform;
  std::array<Index, Dim> cells_ = {};
  GridWaves<Dim> waves_;
  std::vector<double> times_;
  std::vector<std::complex<double>> amplitude_;  ///< frame-major, then wave, then component
  std::unique_ptr<Transform> transform_;
};

/// Spectrum of the motion along one unit vector per wave (the polarisation of a branch, from plane_waves):
/// rows are the waves, k their length along the path. Throws invalid_input: fewer than 4 frames, another
/// number of vectors. Cost O(waves frames log frames).
template <int Dim>
[[nodiscard]] Spectrum wave_spectrum(const WaveRecorder<Dim>& record,
                                     const std::vector<Point<Dim>>& polarisation);

}  // namespace perimode
