// SPDX-License-Identifier: BSD-3-Clause
// Waves of runs by central differences, found again by Fourier transforms, against the symbol of the lattice
// stepped in time. Units of [alebrahim2021]: E = rho = spacing = 1; dt = 0.1.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "verification/recorded_waves.hpp"

namespace perimode {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the runs, in this file only

/// omega of [alebrahim2021] eq. (10), written out: omega^2 = (4/N^2) sum_i (1 - cos i k)/i.
double equation_10(double k, int reach) {
  double squared = 0.0;
  for (int i = 1; i <= reach; ++i) squared += 4.0 / (reach * reach) * (1.0 - std::cos(i * k)) / i;
  return std::sqrt(squared);
}

TEST(RunSpectrum, BarMeetsItsDispersion) {
  const int points = 512, instants = 4096, skipped = 6;
  const RecordedRun<1> run = recorded_run<1>({points}, 3.0, instants, {Point<1>(0.0), Point<1>(1.0)});
  ASSERT_EQ(run.record.waves().k.size(), 257U);
  const std::vector<Point<1>> along(257, Point<1>(1.0));
  const Spectrum spectrum = wave_spectrum(run.record, along);
  const std::vector<RidgePoint> ridge = spectrum_ridge(spectrum);
  double stepped = 0.0, exact = 0.0;
  for (std::size_t q = skipped; q < ridge.size(); ++q) {
    const double omega = equation_10(ridge[q].k, 3);
    stepped = std::max(stepped, std::abs(ridge[q].omega - stepped_frequency(omega, time_step)));
    exact = std::max(exact, std::abs(ridge[q].omega - omega));
  }
  RecordProperty("stepped_bins", std::to_string(stepped / spectrum.resolution));
  RecordProperty("exact", std::to_string(exact));
  EXPECT_LE(stepped, 0.02 * spectrum.resolution);
  EXPECT_LE(exact, 8e-4);  // omega^3 dt^2/24 of the time step at the largest omega, 1.12: 5.7e-4
  EXPECT_GE(exact, 4e-4);  // the run does show what its step does to the waves
}

// The line of particles is the whole bar: both ways to the spectrum are one.
TEST(RunSpectrum, LineOfABarIsItsRecord) {
  const int points = 64, instants = 256;
  SpaceTime line = {1.0, time_step, Eigen::MatrixXd(points, instants)};
  const RecordedRun<1> run =
      recorded_run<1>({points}, 3.0, instants, {Point<1>(0.0), Point<1>(1.0)},
                      [&](Eigen::Index n, const Eigen::VectorXd& u) { line.values.col(n) = u; });
  const Spectrum one = space_time_spectrum(line);
  const Spectrum other = wave_spectrum(run.record, std::vector<Point<1>>(33, Point<1>(1.0)));
  EXPECT_LE((one.amplitude - other.amplitude).cwiseAbs().maxCoeff(), 1e-14 * one.amplitude.maxCoeff());
  for (std::size_t q = 0; q < one.k.size(); ++q) EXPECT_NEAR(one.k[q], other.k[q], 1e-13);
}

TEST(RunSpectrum, PlateMeetsBothBranchesOnTheContour) {
  for (const double ratio : {2.0, 3.0}) {
    const Deviation worst = contour_deviation(48, 1024, ratio);
    RecordProperty(ratio < 2.5 ? "bins_2" : "bins_3", std::to_string(worst.bins));
    EXPECT_LE(worst.bins, 0.02) << "N = " << ratio;
    EXPECT_GE(worst.compared, 120) << "N = " << ratio;
  }
}

// ---- what a line of particles of a plate shows: docs/theory/18_spectra.md -----------------------------

struct Ghosts {
  Spectrum line, plane;             ///< of u_x along x
  std::vector<double> main, ghost;  ///< sqrt(D_xx) at (kx, 0) and (kx, pi), as stepped
};

/// u_x on one row of a plate so wide that nothing comes round within the run.
Ghosts row_of_plate(double ratio) {
  const int cells = 32, width = 384, instants = 1500;
  Ghosts result;
  SpaceTime row = {1.0, time_step, Eigen::MatrixXd(cells, instants)};
  const RecordedRun<2> run = recorded_run<2>({cells, width}, ratio, instants, {{0, 0}, {1, 0}},
                                             [&](Eigen::Index n, const Eigen::VectorXd& u) {
                                               for (Eigen::Index i = 0; i < cells; ++i)
                                                 row.values(i, n) = u[2 * (i + cells * (width / 2))];
                                             });
  result.line = space_time_spectrum(row);
  result.plane =
      wave_spectrum(run.record, std::vector<Point<2>>(run.record.waves().k.size(), Point<2>(1, 0)));
  for (const double k : result.line.k) {
    result.main.push_back(stepped_frequency(std::sqrt(run.symbol({k, 0.0})(0, 0)), time_step));
    result.ghost.push_back(stepped_frequency(std::sqrt(run.symbol({k, std::numbers::pi})(0, 0)), time_step));
  }
  return result;
}

/// Distance of omega from the nearest of the peaks at k, rad/s.
double nearest(const std::vector<RidgePoint>& peaks, double k, double omega) {
  double distance = 1e300;
  for (const RidgePoint& peak : peaks)
    if (std::abs(peak.k - k) < 1e-9) distance = std::min(distance, std::abs(peak.omega - omega));
  return distance;
}

// The six longest waves, N = 2: the bands of the line reach from omega(kx, 0) to omega(kx, pi), and both
// ends are ridges. Found to 0.06 bins; a smooth continuum of waves has no reason to peak to a tenth of a bin
// at a given place.
TEST(RunSpectrum, ALineOfAPlateShowsTheEdgesOfItsBands) {
  const Ghosts g = row_of_plate(2.0);
  const std::vector<RidgePoint> line = spectrum_peaks(g.line, 0.15), plane = spectrum_peaks(g.plane, 0.03);
  for (std::size_t q = 1; q <= 6; ++q) {
    const double k = g.line.k[q], bin = g.line.resolution;
    EXPECT_LE(nearest(line, k, g.main[q]), 0.1 * bin) << q;
    EXPECT_LE(nearest(line, k, g.ghost[q]), 0.1 * bin) << q;
    // The record of the plane has the one wave (k, 0). The window's side lobes fall as 1/bins^3.
    EXPECT_LE(nearest(plane, g.plane.k[q], g.main[q]), 0.01 * bin) << q;
    EXPECT_EQ(
        std::count_if(plane.begin(), plane.end(), [&](const RidgePoint& p) { return p.k == g.plane.k[q]; }),
        1)
        << q;
    if (q > 4) continue;  // nearer than 8 bins
    const auto row = static_cast<Eigen::Index>(q);
    const auto at = static_cast<Eigen::Index>(std::llround(g.ghost[q] / bin));
    EXPECT_LE(g.plane.amplitude(row, at), 3e-3 * g.plane.amplitude.row(row).maxCoeff()) << q;
    EXPECT_GE(g.line.amplitude(row, at), 0.15 * g.line.amplitude.row(row).maxCoeff()) << q;
  }
}

}  // namespace
}  // namespace perimode
