// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fftw3.h>

#include <complex>
#include <memory>
#include <span>
#include <vector>

#include "perimode/dispersion/spectrum.hpp"

namespace perimode {

struct FourierFree {
  void operator()(void* memory) const { fftw_free(memory); }
  void operator()(fftw_plan_s* plan) const;
};
using FourierPlan = std::unique_ptr<fftw_plan_s, FourierFree>;

/// X(q) = sum_n x(n) exp(-2 pi i sum_a n_a q_a/N_a) of real values, first axis fastest. Plans are estimated,
/// not timed: the same bits in every run.
class RealTransform {
 public:
  explicit RealTransform(const std::vector<int>& sizes);
  [[nodiscard]] std::span<double> input() { return {input_.get(), points_}; }
  void run() { fftw_execute(plan_.get()); }
  /// Any whole q, one number per axis.
  [[nodiscard]] std::complex<double> at(std::span<const std::int32_t> q) const;

 private:
  std::vector<int> sizes_;
  std::size_t points_ = 1;
  std::unique_ptr<double, FourierFree> input_;
  std::unique_ptr<fftw_complex, FourierFree> output_;
  FourierPlan plan_;
};

/// Rows of a spectrum from complex amplitudes in time: Hann window, transform, both signs of omega.
class TimeTransform {
 public:
  /// Throws invalid_input for fewer than 4 instants or a step that is not positive.
  TimeTransform(Eigen::Index instants, double time_step);
  [[nodiscard]] Eigen::Index instants() const { return static_cast<Eigen::Index>(window_.size()); }
  /// To be filled with instants() values before row().
  [[nodiscard]] std::complex<double>* input() {
    return reinterpret_cast<std::complex<double>*>(values_.get());  // the layouts agree by FFTW's promise
  }
  /// Overwrites the input. The wave A exp(i(k x - omega t)) + its conjugate over 2 has U_k = A/2 exp(-i omega
  /// t) and shows as A.
  [[nodiscard]] Eigen::RowVectorXd row();
  /// A spectrum without amplitudes.
  [[nodiscard]] Spectrum frame(std::vector<double> k) const;

 private:
  std::vector<double> window_;
  double time_step_, scale_;
  std::unique_ptr<fftw_complex, FourierFree> values_;
  FourierPlan plan_;
};

}  // namespace perimode
