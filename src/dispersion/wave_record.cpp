// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/dispersion/wave_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "dispersion/fourier.hpp"
#include "perimode/core/error.hpp"

namespace perimode {
namespace {

constexpr double nearly_whole = 1e-6;  ///< of a wave: what counts as a whole number

/// Adds the waves from corner `a` to corner `b`, both in whole waves per period.
template <int Dim>
void add_side(const Grid<Dim>& grid, const Point<Dim>& a, const Point<Dim>& b, double start,
              GridWaves<Dim>& waves) {
  Point<Dim> unit;  // rad/m of one wave
  for (int c = 0; c < Dim; ++c) unit[c] = 2.0 * std::numbers::pi / (grid.cells[c] * grid.spacing);
  Eigen::Index along = 0;
  (b - a).cwiseAbs().maxCoeff(&along);
  const Point<Dim> side = (b - a).cwiseProduct(unit);
  const int sign = b[along] > a[along] ? 1 : -1;
  const auto first = std::llround(std::ceil(sign * a[along] - nearly_whole));
  const auto last = std::llround(std::floor(sign * b[along] + nearly_whole));
  for (auto n = first; n <= last; ++n) {
    const double share =
        (sign * static_cast<double>(n) - a[along]) / (b[along] - a[along]);  // of the side up to here
    const Point<Dim> exact = a + share * (b - a);
    const Point<Dim> rounded = exact.array().round().matrix();
    if ((exact - rounded).cwiseAbs().maxCoeff() > nearly_whole) continue;
    std::array<Index, Dim> number;
    for (int c = 0; c < Dim; ++c) number[static_cast<std::size_t>(c)] = static_cast<Index>(rounded[c]);
    const Point<Dim> k = rounded.cwiseProduct(unit);
    const Point<Dim> direction = k.norm() > 0.0 ? k.normalized() : side.normalized();
    const double length = start + share * side.norm();
    if (!waves.number.empty() && n == first && waves.number.back() == number) continue;  // the corner stands
    waves.number.push_back(number);
    waves.k.push_back(k);
    waves.direction.push_back(direction);
    waves.length.push_back(length);
  }
}

}  // namespace

template <int Dim>
GridWaves<Dim> waves_on_path(const Grid<Dim>& grid, const std::vector<Point<Dim>>& corners) {
  if (corners.size() < 2) {
    invalid_input({"a path of two corners or more", fmt::format("{}", corners.size()),
                   "give for example [0, 0] and [1, 0] (pi/spacing)"});
  }
  GridWaves<Dim> waves;
  double start = 0.0;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    if (corners[i] == corners[i + 1]) {
      invalid_input({"corners that differ from the one before", fmt::format("corner {} twice", i + 1),
                     "remove one of the two"});
    }
    Point<Dim> half;  // whole waves per period at pi/spacing
    for (int c = 0; c < Dim; ++c) half[c] = 0.5 * grid.cells[static_cast<std::size_t>(c)];
    add_side<Dim>(grid, corners[i].cwiseProduct(half), corners[i + 1].cwiseProduct(half), start, waves);
    start += (corners[i + 1] - corners[i]).norm() * std::numbers::pi / grid.spacing;
  }
  if (waves.k.size() < 2) {
    invalid_input({"a path with two waves or more that fit the periodic grid",
                   fmt::format("{} of them", waves.k.size()),
                   "take corners at whole multiples of 2/cells along each axis"});
  }
  return waves;
}

template <int Dim>
struct WaveRecorder<Dim>::Transform {
  explicit Transform(const std::vector<int>& sizes) : grid(sizes) {}
  RealTransform grid;
};

template <int Dim>
WaveRecorder<Dim>::WaveRecorder(const Grid<Dim>& grid, GridWaves<Dim> waves, std::size_t frames)
    : cells_(grid.cells), waves_(std::move(waves)) {
  if (waves_.number.empty()) invalid_input({"waves to record", "none", "give a path (waves_on_path)"});
  times_.reserve(frames);
  amplitude_.reserve(frames * waves_.number.size() * Dim);
  transform_ = std::make_unique<Transform>(std::vector<int>(cells_.begin(), cells_.end()));
}

template <int Dim>
WaveRecorder<Dim>::~WaveRecorder() = default;
template <int Dim>
WaveRecorder<Dim>::WaveRecorder(WaveRecorder&&) noexcept = default;
template <int Dim>
WaveRecorder<Dim>& WaveRecorder<Dim>::operator=(WaveRecorder&&) noexcept = default;

template <int Dim>
double WaveRecorder<Dim>::time_step() const {
  if (times_.size() < 2) return 0.0;
  return (times_.back() - times_.front()) / static_cast<double>(times_.size() - 1);
}

template <int Dim>
void WaveRecorder<Dim>::add(double time, std::span<const double> displacement) {
  const std::span<double> field = transform_->grid.input();
  if (displacement.size() != field.size() * Dim) {
    invalid_input({fmt::format("displacements of {} cells", field.size()),
                   fmt::format("{} numbers", displacement.size()), "record the run of the same grid"});
  }
  const double step = times_.size() < 2 ? 0.0 : times_[1] - times_[0];
  const double expected = times_.empty() ? time : times_.front() + static_cast<double>(times_.size()) * step;
  const bool even =
      times_.size() < 2 ? times_.empty() || time > times_[0] : std::abs(time - expected) <= 1e-6 * step;
  if (!std::isfinite(time) || !even) {
    invalid_input({times_.size() < 2 ? "a later frame" : fmt::format("frames every {:.6e} s", step),
                   fmt::format("{:.6e} s after {:.6e} s", time, times_.empty() ? 0.0 : times_.back()),
                   "record at equal times"});
  }
  if (!std::all_of(displacement.begin(), displacement.end(), [](double u) { return std::isfinite(u); }))
    invalid_input({"numbers", "displacements that are none", "look whether the run was stable"});

  const std::size_t waves = waves_.number.size(), first = amplitude_.size();
  amplitude_.resize(first + waves * Dim);
  const auto count = static_cast<double>(field.size());
  for (std::size_t c = 0; c < Dim; ++c) {
    for (std::size_t i = 0; i < field.size(); ++i) field[i] = displacement[i * Dim + c];
    transform_->grid.run();
    for (std::size_t w = 0; w < waves; ++w)
      amplitude_[first + w * Dim + c] = transform_->grid.at(waves_.number[w]) / count;
  }
  times_.push_back(time);
}

template <int Dim>
Eigen::Matrix<std::complex<double>, Dim, 1> WaveRecorder<Dim>::amplitude(std::size_t frame,
                                                                         std::size_t wave) const {
  const std::size_t first = (frame * waves_.number.size() + wave) * Dim;
  return Eigen::Map<const Eigen::Matrix<std::complex<double>, Dim, 1>>(amplitude_.data() + first);
}

template <int Dim>
Spectrum wave_spectrum(const WaveRecorder<Dim>& record, const std::vector<Point<Dim>>& polarisation) {
  const std::size_t waves = record.waves().k.size();
  if (polarisation.size() != waves) {
    invalid_input({fmt::format("{} polarisations, one per wave", waves),
                   fmt::format("{}", polarisation.size()), "give a unit vector for every wave"});
  }
  const auto instants = static_cast<Eigen::Index>(record.frames());
  TimeTransform time(instants, instants < 2 ? 1.0 : record.time_step());
  Spectrum spectrum = time.frame(record.waves().length);
  for (std::size_t w = 0; w < waves; ++w) {
    for (std::size_t n = 0; n < record.frames(); ++n)
      time.input()[n] = polarisation[w].template cast<std::complex<double>>().dot(record.amplitude(n, w));
    spectrum.amplitude.row(static_cast<Eigen::Index>(w)) = time.row();
  }
  return spectrum;
}

#define PERIMODE_WAVE_RECORD(D)                                                         \
  template GridWaves<D> waves_on_path<D>(const Grid<D>&, const std::vector<Point<D>>&); \
  template class WaveRecorder<D>;                                                       \
  template Spectrum wave_spectrum<D>(const WaveRecorder<D>&, const std::vector<Point<D>>&)
PERIMODE_WAVE_RECORD(1);
PERIMODE_WAVE_RECORD(2);
PERIMODE_WAVE_RECORD(3);
#undef PERIMODE_WAVE_RECORD

}  // namespace perimode
