// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "perimode/dispersion/zone.hpp"

namespace perimode {
namespace {

/// A branch along a line: of the shear waves of 3D the slower.
template <int Dim>
class Line {
 public:
  Line(const Lattice<Dim>& lattice, Branch branch, const Point<Dim>& direction)
      : lattice_(lattice),
        direction_(direction.normalized()),
        speed_(classical_speed(lattice.medium, branch)),
        branch_(branch == Branch::pressure ? 0 : 1) {}

  struct Sample {
    double s = 0.0;
    double omega = 0.0;      ///< 0 where omega^2 < 0
    double deviation = 0.0;  ///< omega/(c s) - 1
    double slope = 0.0;      ///< d omega/ds
    double phase = 0.0;      ///< omega/s

    [[nodiscard]] double deviation_slope() const { return slope - phase; }  // times c s
  };

  [[nodiscard]] Sample at(double s) const {
    const PlaneWaves<Dim> waves = plane_waves<Dim>(lattice_, s * direction_, direction_);
    Sample sample{s, 0.0, -1.0, 0.0, 0.0};
    if (!(waves.angular_frequency[branch_] >= 0.0)) return sample;
    sample.omega = waves.angular_frequency[branch_];
    sample.phase = waves.phase_velocity[branch_];
    sample.deviation = sample.phase / speed_ - 1.0;
    sample.slope = waves.group_velocity[branch_].dot(direction_);
    return sample;
  }

  /// Where `sign` changes from that at a; both ends are a few ulp apart at the end.
  template <class Function>
  [[nodiscard]] Sample bisect(const Sample& a, const Sample& b, Function value) const {
    const bool positive = value(a) > 0.0;
    Sample low = a, high = b;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low.s + high.s);
      if (middle <= low.s || middle >= high.s) break;
      const Sample m = at(middle);
      ((value(m) > 0.0) == positive ? low : high) = m;
    }
    return low;
  }

 private:
  const Lattice<Dim>& lattice_;
  Point<Dim> direction_;
  double speed_;
  std::size_t branch_;
};

}  // namespace

template <int Dim>
BranchBand branch_band(const Lattice<Dim>& lattice, Branch branch, const Point<Dim>& direction,
                       double longest, double error) {
  if (!(longest > 0.0) || !std::isfinite(longest)) {
    invalid_input({"a line of positive length in k", fmt::format("{}", longest), "pi/spacing is customary"});
  }
  if (!(direction.norm() > 0.0)) {
    invalid_input({"a direction", "a vector of length 0", "give for example the first axis"});
  }
  using Sample = typename Line<Dim>::Sample;
  const Line<Dim> line(lattice, branch, direction);
  const double waves = longest * lattice.family.spacing * lattice.family.reach();  // radians of the last
  const int count = 64 + static_cast<int>(16.0 * Dim * waves);
  std::vector<Sample> samples;
  samples.reserve(static_cast<std::size_t>(count) + 1);
  for (int i = 0; i <= count; ++i) samples.push_back(line.at(longest * i / count));

  const auto deviation = [](const Sample& s) { return s.deviation; };
  const auto outside = [&](const Sample& s) { return std::abs(s.deviation) - error; };
  BranchBand band;
  band.long_wave_ratio = samples.front().deviation + 1.0;
  band.worst_overshoot = samples.front().deviation;
  const auto consider = [&](const Sample& s) {
    if (s.omega > band.cut_off) {
      band.cut_off = s.omega;
      band.cut_off_k = s.s;
    }
    if (s.deviation > band.worst_overshoot) {
      band.worst_overshoot = s.deviation;
      band.worst_overshoot_k = s.s;
    }
  };
  bool within = outside(samples.front()) <= 0.0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const Sample& a = samples[i - 1];
    const Sample& b = samples[i];
    consider(b);
    if (a.slope > 0.0 && b.slope <= 0.0) consider(line.bisect(a, b, [](const Sample& s) { return s.slope; }));
    if (a.deviation_slope() > 0.0 && b.deviation_slope() <= 0.0)
      consider(line.bisect(a, b, [](const Sample& s) { return s.deviation_slope(); }));
    // Long waves that run at the classical speed to round-off are no crossing.
    if ((i > 1 || std::abs(a.deviation) > 1e-9) && (a.deviation > 0.0) != (b.deviation > 0.0))
      band.crossings.push_back(line.bisect(a, b, deviation).omega);
    if (within && outside(b) > 0.0) {
      const Sample edge = line.bisect(a, b, outside);
      band.band_k = edge.s;
      band.band_frequency = edge.omega;
      within = false;
    }
  }
  if (within) {
    band.band_k = longest;
    band.band_frequency = samples.back().omega;
  }
  std::sort(band.crossings.begin(), band.crossings.end());
  return band;
}

template BranchBand branch_band<1>(const Lattice<1>&, Branch, const Point<1>&, double, double);
template BranchBand branch_band<2>(const Lattice<2>&, Branch, const Point<2>&, double, double);
template BranchBand branch_band<3>(const Lattice<3>&, Branch, const Point<3>&, double, double);

}  // namespace perimode
