// SPDX-License-Identifier: BSD-3-Clause
#include "dispersion/fourier.hpp"

#include <fmt/format.h>

#include <cmath>
#include <mutex>
#include <new>
#include <numbers>
#include <utility>

#include "perimode/core/error.hpp"

namespace perimode {
namespace {

/// FFTW makes and destroys plans from one thread at a time.
std::mutex& planner() {
  static std::mutex mutex;
  return mutex;
}

FourierPlan checked(fftw_plan plan) {
  if (plan == nullptr) throw std::bad_alloc();
  return FourierPlan(plan);
}

template <class T>
std::unique_ptr<T, FourierFree> memory(std::size_t count) {
  auto* block = static_cast<T*>(fftw_malloc(count * sizeof(T)));
  if (block == nullptr) throw std::bad_alloc();
  return std::unique_ptr<T, FourierFree>(block);
}

}  // namespace

void FourierFree::operator()(fftw_plan_s* plan) const {
  const std::lock_guard lock(planner());
  fftw_destroy_plan(plan);
}

RealTransform::RealTransform(const std::vector<int>& sizes) : sizes_(sizes) {
  std::size_t halved = 1;
  for (std::size_t a = 0; a < sizes.size(); ++a) {
    const auto n = static_cast<std::size_t>(sizes[a]);
    points_ *= n;
    halved *= a == 0 ? n / 2 + 1 : n;
  }
  input_ = memory<double>(points_);
  output_ = memory<fftw_complex>(halved);
  const std::vector<int> slowest_first(sizes.rbegin(), sizes.rend());
  const std::lock_guard lock(planner());
  plan_ = checked(fftw_plan_dft_r2c(static_cast<int>(sizes.size()), slowest_first.data(), input_.get(),
                                    output_.get(), FFTW_ESTIMATE));
}

std::complex<double> RealTransform::at(std::span<const std::int32_t> q) const {
  const auto into = [&](std::size_t a, std::int32_t number) {
    const std::int32_t n = sizes_[a];
    return static_cast<std::size_t>(((number % n) + n) % n);
  };
  const bool mirrored = into(0, q[0]) > static_cast<std::size_t>(sizes_[0] / 2);  // X(-q) = conj X(q)
  std::size_t place = 0;
  for (std::size_t a = sizes_.size(); a-- > 0;) {
    const auto n = static_cast<std::size_t>(a == 0 ? sizes_[a] / 2 + 1 : sizes_[a]);
    place = place * n + into(a, mirrored ? -q[a] : q[a]);
  }
  const fftw_complex& x = output_.get()[place];
  return {x[0], mirrored ? -x[1] : x[1]};
}

TimeTransform::TimeTransform(Eigen::Index instants, double time_step) : time_step_(time_step) {
  if (instants < 4) {
    invalid_input({"4 instants or more for a spectrum", fmt::format("{}", instants),
                   "run longer, or write fields more often"});
  }
  if (!(time_step > 0.0) || !std::isfinite(time_step))
    invalid_input({"a time step > 0", fmt::format("{}", time_step), "give the time between two instants"});
  const auto n = static_cast<std::size_t>(instants);
  window_.reserve(n);
  for (std::size_t j = 0; j < n; ++j) {
    const double s = std::sin(std::numbers::pi * static_cast<double>(j) / static_cast<double>(n));
    window_.push_back(s * s);
  }
  scale_ = 4.0 / static_cast<double>(n);  // 2 over the sum of the window
  values_ = memory<fftw_complex>(n);
  const std::lock_guard lock(planner());
  plan_ = checked(
      fftw_plan_dft_1d(static_cast<int>(n), values_.get(), values_.get(), FFTW_FORWARD, FFTW_ESTIMATE));
}

Eigen::RowVectorXd TimeTransform::row() {
  std::complex<double>* u = input();
  const Eigen::Index n = instants();
  Eigen::RowVectorXd amplitude(n / 2 + 1);
  for (Eigen::Index j = 0; j < n; ++j) u[j] *= window_[static_cast<std::size_t>(j)];
  fftw_execute(plan_.get());
  for (Eigen::Index s = 0; s <= n / 2; ++s) {
    const Eigen::Index other = (n - s) % n;
    amplitude[s] = scale_ * (other == s ? std::abs(u[s]) : std::hypot(std::abs(u[s]), std::abs(u[other])));
  }
  return amplitude;
}

Spectrum TimeTransform::frame(std::vector<double> k) const {
  Spectrum spectrum;
  spectrum.k = std::move(k);
  spectrum.instants = instants();
  spectrum.time_step = time_step_;
  spectrum.resolution = 2.0 * std::numbers::pi / (static_cast<double>(instants()) * time_step_);
  spectrum.nyquist = std::numbers::pi / time_step_;
  const Eigen::Index bins = instants() / 2 + 1;
  spectrum.omega.reserve(static_cast<std::size_t>(bins));
  for (Eigen::Index s = 0; s < bins; ++s)
    spectrum.omega.push_back(static_cast<double>(s) * spectrum.resolution);
  spectrum.amplitude.setZero(static_cast<Eigen::Index>(spectrum.k.size()), bins);
  return spectrum;
}

}  // namespace perimode
