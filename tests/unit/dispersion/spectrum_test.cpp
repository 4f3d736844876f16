// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/dispersion/spectrum.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "perimode/core/error.hpp"
#include "perimode/core/version.hpp"

namespace perimode {
namespace {

using std::numbers::pi;
using testing::HasSubstr;

constexpr double spacing = 0.25, step = 0.02;

/// A running wave A cos(k x - omega t + phase), q waves in the line, omega in bins.
struct Tone {
  double amplitude = 1.0;
  int q = 1;
  double bins = 10.0;
  double phase = 0.0;
};

SpaceTime sum_of(const std::vector<Tone>& tones, int points, int instants) {
  SpaceTime field = {spacing, step, Eigen::MatrixXd::Zero(points, instants)};
  for (const Tone& tone : tones) {
    for (int n = 0; n < instants; ++n) {
      for (int i = 0; i < points; ++i) {
        field.values(i, n) += tone.amplitude * std::cos(2.0 * pi * tone.q * i / points -
                                                        2.0 * pi * tone.bins * n / instants + tone.phase);
      }
    }
  }
  return field;
}

std::string complaint(const SpaceTime& field) {
  try {
    (void)space_time_spectrum(field);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
    return error.what();
  }
  return "no error";
}

TEST(Spectrum, IsTheSumOfItsDefinition) {
  std::mt19937 gen(3);
  for (const auto& [points, instants] : {std::pair{7, 9}, std::pair{8, 6}, std::pair{4, 4}}) {
    SpaceTime field = {spacing, step, Eigen::MatrixXd::Zero(points, instants)};
    for (double& value : field.values.reshaped()) value = static_cast<double>(gen()) / 4294967296.0 - 0.5;
    const Spectrum spectrum = space_time_spectrum(field);
    ASSERT_EQ(spectrum.amplitude.rows(), points / 2 + 1);
    ASSERT_EQ(spectrum.amplitude.cols(), instants / 2 + 1);
    for (int q = 0; q <= points / 2; ++q) {
      EXPECT_NEAR(spectrum.k[q], 2.0 * pi * q / (points * spacing), 1e-13);
      for (int s = 0; s <= instants / 2; ++s) {
        std::complex<double> forward = 0.0, backward = 0.0;
        double window = 0.0;
        for (int n = 0; n < instants; ++n) {
          const double hann = 0.5 * (1.0 - std::cos(2.0 * pi * n / instants));
          window += hann;
          for (int i = 0; i < points; ++i) {
            const double kx = 2.0 * pi * q * i / points, wt = 2.0 * pi * s * n / instants;
            forward += hann * field.values(i, n) * std::polar(1.0, -kx - wt);
            backward += hann * field.values(i, n) * std::polar(1.0, -kx + wt);
          }
        }
        const bool edge = s == 0 || 2 * s == instants;  // omega and -omega are one bin
        const double squares = std::norm(forward) + (edge ? 0.0 : std::norm(backward));
        EXPECT_NEAR(spectrum.amplitude(q, s), 2.0 * std::sqrt(squares) / (points * window), 1e-14);
      }
    }
  }
}

TEST(Spectrum, KnowsItsResolutionAndNyquist) {
  const Spectrum spectrum = space_time_spectrum(sum_of({{}}, 16, 50));
  EXPECT_DOUBLE_EQ(spectrum.resolution, 2.0 * pi / (50 * step));
  EXPECT_DOUBLE_EQ(spectrum.nyquist, pi / step);
  EXPECT_NEAR(spectrum.omega.back(), spectrum.nyquist, 1e-12 * spectrum.nyquist);
  EXPECT_EQ(spectrum.instants, 50);
  EXPECT_DOUBLE_EQ(spectrum.time_step, step);
}

TEST(Spectrum, AToneOnTheGridShowsItsAmplitude) {
  for (const int q : {3, -3}) {  // to the right, to the left
    const Spectrum spectrum = space_time_spectrum(sum_of({{2.5, q, 20.0, 0.3}}, 32, 128));
    EXPECT_NEAR(spectrum.amplitude(3, 20), 2.5, 1e-12);
    const std::vector<RidgePoint> ridge = spectrum_ridge(spectrum);
    EXPECT_NEAR(ridge[3].omega, 20.0 * spectrum.resolution, 1e-12 * spectrum.nyquist);
    EXPECT_NEAR(ridge[3].amplitude, 2.5, 1e-12);
    EXPECT_DOUBLE_EQ(ridge[3].k, spectrum.k[3]);
  }
  const Spectrum standing = space_time_spectrum(sum_of({{0.5, 3, 20.0}, {0.5, -3, 20.0}}, 32, 128));
  EXPECT_NEAR(standing.amplitude(3, 20), std::sqrt(0.5), 1e-12);
}

TEST(Spectrum, MotionBeyondNyquistShowsMirrored) {
  const Spectrum spectrum = space_time_spectrum(sum_of({{1.0, 3, 128.0 - 20.0}}, 32, 128));
  EXPECT_NEAR(spectrum_ridge(spectrum)[3].omega, 2.0 * spectrum.nyquist - 108.0 * spectrum.resolution,
              1e-12 * spectrum.nyquist);
}

// One running tone has no partner at -omega, but its own leak there counts as a square: below 1e-5 of a bin.
// A standing one leaks over from -omega; the leak falls with the third power of the distance, 2 omega, and is
// below 1 % of a bin from 4 bins.
TEST(SpectrumRidge, TonesOffTheGrid) {
  std::mt19937 gen(5);
  const auto real = [&] { return static_cast<double>(gen()) / 4294967296.0; };
  double worst_near = 0.0, worst_far = 0.0;
  for (int trial = 0; trial < 300; ++trial) {
    const double bins = 4.0 + 56.0 * real(), phase = 2.0 * pi * real();
    const Spectrum running = space_time_spectrum(sum_of({{1.0, 2, bins, phase}}, 8, 128));
    EXPECT_NEAR(spectrum_ridge(running)[2].omega / running.resolution, bins, 1e-5);
    const Spectrum standing =
        space_time_spectrum(sum_of({{1.0, 2, bins, phase}, {1.0, -2, bins, -phase + real()}}, 8, 128));
    const double error = std::abs(spectrum_ridge(standing)[2].omega / standing.resolution - bins);
    worst_near = std::max(worst_near, error);
    if (bins > 12.0 && bins < 52.0) worst_far = std::max(worst_far, error);
  }
  EXPECT_LE(worst_near, 0.01);
  EXPECT_LE(worst_far, 3e-4);
}

TEST(SpectrumRidge, TakesTheStrongerOfTwoBranches) {
  const Spectrum spectrum = space_time_spectrum(sum_of({{1.0, 5, 17.3}, {0.4, 5, 40.6}}, 32, 128));
  EXPECT_NEAR(spectrum_ridge(spectrum)[5].omega / spectrum.resolution, 17.3, 0.02);
  const std::vector<RidgePoint> peaks = spectrum_peaks(spectrum, 0.1);
  ASSERT_EQ(peaks.size(), 2U);
  EXPECT_NEAR(peaks[0].omega / spectrum.resolution, 17.3, 0.02);
  EXPECT_NEAR(peaks[1].omega / spectrum.resolution, 40.6, 0.02);
  EXPECT_LT(peaks[1].amplitude, 0.5 * peaks[0].amplitude);
  EXPECT_DOUBLE_EQ(peaks[1].k, spectrum.k[5]);
  EXPECT_EQ(spectrum_peaks(spectrum, 0.6).size(), 1U);
}

TEST(SpectrumRidge, SilentLinesHaveNoFrequency) {
  Spectrum spectrum = space_time_spectrum(sum_of({{1.0, 5, 17.0}, {1e-3, 7, 30.0}}, 32, 128));
  const std::vector<RidgePoint> ridge = spectrum_ridge(spectrum);
  ASSERT_EQ(ridge.size(), 17U);
  for (std::size_t q = 0; q < ridge.size(); ++q) EXPECT_EQ(std::isnan(ridge[q].omega), q != 5 && q != 7) << q;
  for (const RidgePoint& peak : spectrum_peaks(spectrum, 0.5)) EXPECT_FALSE(std::isnan(peak.omega));
  EXPECT_EQ(spectrum_peaks(spectrum, 0.5).size(), 2U);
  spectrum.amplitude.setZero();
  for (const RidgePoint& point : spectrum_ridge(spectrum)) EXPECT_TRUE(std::isnan(point.omega));
  EXPECT_TRUE(spectrum_peaks(spectrum, 0.5).empty());
}

TEST(Spectrum, RefusesWhatHasNone) {
  const SpaceTime good = sum_of({{}}, 8, 8);
  EXPECT_EQ(complaint(good), "no error");
  SpaceTime bad = good;
  bad.values = good.values.topRows(3);
  EXPECT_THAT(complaint(bad), HasSubstr("expected 4 points or more for a spectrum, got 3"));
  bad.values = good.values.leftCols(3);
  EXPECT_THAT(complaint(bad), HasSubstr("expected 4 instants or more for a spectrum, got 3"));
  bad = good;
  bad.spacing = 0.0;
  EXPECT_THAT(complaint(bad), HasSubstr("spacing > 0"));
  bad = good;
  bad.time_step = -1.0;
  EXPECT_THAT(complaint(bad), HasSubstr("time step > 0"));
  bad = good;
  bad.values(2, 2) = std::numeric_limits<double>::infinity();
  EXPECT_THAT(complaint(bad), HasSubstr("values that are none"));
  EXPECT_THROW((void)spectrum_peaks(space_time_spectrum(good), 1.5), Error);
}

TEST(Spectrum, TheProgramNamesItsFourierTransform) {
  bool named = false;
  for (const Component& component : components())
    named = named || (component.name == "FFTW" && component.version.starts_with("3."));
  EXPECT_TRUE(named);
}

}  // namespace
}  // namespace perimode
