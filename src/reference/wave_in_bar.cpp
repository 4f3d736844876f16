// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/reference/wave_in_bar.hpp"

#include <cmath>
#include <numbers>

#include "perimode/core/error.hpp"

namespace perimode {
namespace {

/// sin(pi a / b) for whole numbers, its argument reduced exactly.
double sine_of_turns(long long a, long long b) {
  return std::sin(std::numbers::pi * static_cast<double>(a % (2 * b)) / static_cast<double>(b));
}

/// cos(pi a / b), likewise.
double cosine_of_turns(long long a, long long b) { return sine_of_turns(2 * a + b, 2 * b); }

/// Square wave of period 4: +1 on (-1, 1), -1 on (1, 3), 0 where it jumps.
double square_wave(double s) {
  const double r = std::abs(std::remainder(s, 4.0));
  return r < 1.0 ? 1.0 : (r > 1.0 ? -1.0 : 0.0);
}

}  // namespace

std::vector<StandingWave> released_lattice(Ends ends, double length, std::span<const double> u0,
                                           const DispersionRelation& omega) {
  if (ends == Ends::periodic)
    invalid_input(
        {"a bar with two ends", "a periodic one", "its waves travel; take mirror, antimirror or mixed"});
  const auto cells = static_cast<long long>(u0.size());
  std::vector<StandingWave> waves;
  for (const AxisWave& wave : axis_waves(ends, length, static_cast<int>(cells))) {
    if (!wave.normal) continue;  // a sine at k = 0, a cosine at k = pi/spacing: zero at every cell
    // k length = pi half_turns/2 and x = (2 i + 1) length/(2 cells).
    const long long half_turns = std::llround(2.0 * wave.k * length / std::numbers::pi);
    const bool cosine = ends == Ends::antimirror;
    double projection = 0.0;
    for (long long i = 0; i < cells; ++i) {
      const long long turns = half_turns * (2 * i + 1);
      projection += u0[static_cast<std::size_t>(i)] *
                    (cosine ? cosine_of_turns(turns, 4 * cells) : sine_of_turns(turns, 4 * cells));
    }
    const bool alone = half_turns == 0 || half_turns == 2 * cells;  // all cells carry it in full
    const double amplitude = projection * (alone ? 1.0 : 2.0) / static_cast<double>(cells);
    waves.push_back({wave.k, cosine ? 0.0 : amplitude, cosine ? amplitude : 0.0, omega(wave.k)});
  }
  return waves;
}

std::vector<StandingWave> released_pulse(double length, double height, double centre, double width, int terms,
                                         const DispersionRelation& omega) {
  std::vector<StandingWave> waves;
  const double whole = 2.0 * height * width * std::sqrt(std::numbers::pi) / length;
  for (int n = 1; n <= terms; ++n) {
    const double k = n * std::numbers::pi / length;
    const double decay = std::exp(-0.25 * k * k * width * width);
    waves.push_back({k, whole * decay * std::sin(k * centre), 0.0, omega(k)});
  }
  return waves;
}

double displacement(std::span<const StandingWave> waves, double x, double t) {
  double sum = 0.0;
  for (const StandingWave& w : waves)
    sum += (w.sine * std::sin(w.k * x) + w.cosine * std::cos(w.k * x)) * std::cos(w.omega * t);
  return sum;
}

double strain(std::span<const StandingWave> waves, double a, double b, double t) {
  double sum = 0.0;
  const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
  for (const StandingWave& w : waves)
    sum += (w.sine * std::cos(w.k * middle) - w.cosine * std::sin(w.k * middle)) * std::sin(w.k * half) /
           half * std::cos(w.omega * t);
  return sum;
}

double stepped_frequency(double omega, double dt) { return 2.0 / dt * std::asin(0.5 * omega * dt); }

double snapped_bar_strain(double length, double speed, double x, double t) {
  return 0.5 * (square_wave((x - speed * t) / length) + square_wave((x + speed * t) / length));
}

}  // namespace perimode
