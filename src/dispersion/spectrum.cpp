// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/dispersion/spectrum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "dispersion/fourier.hpp"
#include "perimode/core/error.hpp"

namespace perimode {
namespace {

constexpr double silence = 1e-6;  ///< of the largest amplitude

/// The maximum whose largest bin is s.
RidgePoint refined(const Spectrum& spectrum, Eigen::Index row, Eigen::Index s) {
  const auto& a = spectrum.amplitude;
  RidgePoint point;
  point.k = spectrum.k[static_cast<std::size_t>(row)];
  point.omega = spectrum.omega[static_cast<std::size_t>(s)];
  point.amplitude = a(row, s);
  if (s == 0 || s + 1 == a.cols()) return point;
  const double below = a(row, s - 1), above = a(row, s + 1);
  point.omega += 2.0 * (above - below) / (below + 2.0 * a(row, s) + above) * spectrum.resolution;
  return point;
}

double loudest(const Spectrum& spectrum) {
  return spectrum.amplitude.size() == 0 ? 0.0 : spectrum.amplitude.maxCoeff();
}

bool is_silent(double amplitude, double loudest) { return amplitude <= 0.0 || amplitude < silence * loudest; }

}  // namespace

Spectrum space_time_spectrum(const SpaceTime& field) {
  const Eigen::Index points = field.values.rows(), instants = field.values.cols();
  if (points < 4)
    invalid_input({"4 points or more for a spectrum", fmt::format("{}", points), "take a longer line"});
  if (!(field.spacing > 0.0) || !std::isfinite(field.spacing)) {
    invalid_input(
        {"a spacing > 0", fmt::format("{}", field.spacing), "give the distance between two points"});
  }
  TimeTransform time(instants, field.time_step);
  if (!field.values.allFinite())
    invalid_input({"numbers", "values that are none", "look whether the run was stable"});

  const Eigen::Index waves = points / 2 + 1;
  const auto count = static_cast<double>(points);
  Eigen::MatrixXcd u(instants, waves);
  RealTransform space({static_cast<int>(points)});
  for (Eigen::Index n = 0; n < instants; ++n) {
    std::copy_n(field.values.col(n).data(), points, space.input().begin());
    space.run();
    for (Eigen::Index q = 0; q < waves; ++q) {
      const std::array<std::int32_t, 1> number = {static_cast<std::int32_t>(q)};
      u(n, q) = space.at(number) / count;
    }
  }
  std::vector<double> k;
  k.reserve(static_cast<std::size_t>(waves));
  for (Eigen::Index q = 0; q < waves; ++q)
    k.push_back(2.0 * std::numbers::pi * static_cast<double>(q) / (count * field.spacing));
  Spectrum spectrum = time.frame(std::move(k));
  for (Eigen::Index q = 0; q < waves; ++q) {
    std::copy_n(u.col(q).data(), instants, time.input());
    spectrum.amplitude.row(q) = time.row();
  }
  return spectrum;
}

std::vector<RidgePoint> spectrum_ridge(const Spectrum& spectrum) {
  const double largest = loudest(spectrum);
  std::vector<RidgePoint> ridge;
  ridge.reserve(spectrum.k.size());
  for (Eigen::Index row = 0; row < spectrum.amplitude.rows(); ++row) {
    Eigen::Index s = 0;
    const double top = spectrum.amplitude.row(row).maxCoeff(&s);
    ridge.push_back(refined(spectrum, row, s));
    if (is_silent(top, largest)) ridge.back().omega = std::numeric_limits<double>::quiet_NaN();
  }
  return ridge;
}

std::vector<RidgePoint> spectrum_peaks(const Spectrum& spectrum, double least) {
  if (!(least >= 0.0 && least <= 1.0)) {
    invalid_input(
        {"a share of the largest amplitude, 0 to 1", fmt::format("{}", least), "give for example 0.1"});
  }
  const double largest = loudest(spectrum);
  const auto& a = spectrum.amplitude;
  std::vector<RidgePoint> peaks;
  peaks.reserve(spectrum.k.size());
  for (Eigen::Index row = 0; row < a.rows(); ++row) {
    const double top = a.row(row).maxCoeff();
    if (is_silent(top, largest)) continue;
    for (Eigen::Index s = 0; s < a.cols(); ++s) {
      if (a(row, s) < least * top || (s > 0 && a(row, s - 1) >= a(row, s))) continue;
      if (s + 1 < a.cols() && a(row, s + 1) > a(row, s)) continue;
      peaks.push_back(refined(spectrum, row, s));  // of equal neighbours the first
    }
  }
  return peaks;
}

}  // namespace perimode
