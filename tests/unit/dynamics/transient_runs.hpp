// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "perimode/dynamics/transient.hpp"
#include "support/models.hpp"

namespace perimode::test {

inline Region face(int axis, bool upper, int layers) { return {FaceRegion{{axis, upper}, layers, 0.0}, {}}; }

inline TimeFunction half_sine(double t) { return {TimeFunction::Kind::half_sine, t, 0.0, {}, {}, {}}; }

/// A bar of `n` particles and length 1, E = rho = 1: waves travel at about 1.
inline Model bar(int n) {
  Model m = box_model({n}, 1.0 / n, 3.0);
  m.volume_correction = VolumeCorrection::linear;
  return m;
}

/// A plate held at x-, 12 x 8 particles of 0.1.
inline Model plate() {
  Model m = box_model({12, 8}, 0.1, 3.0);
  m.volume_correction = VolumeCorrection::linear;
  fix_face(m, 0, false, 2, {0, 1});
  return m;
}

inline TransientOptions until(double end) {
  TransientOptions options;
  options.end = end;
  return options;
}

/// A blow on the free end of a bar.
inline Load blow(double seconds) { return {Traction{{1e-3}}, face(0, true, 1), half_sine(seconds), {}}; }
inline Load plate_blow(double seconds) {
  return {Traction{{1e-3, -5e-4}}, face(0, true, 1), half_sine(seconds), {}};
}

/// u = f(x) along x at the start.
template <int Dim, class F>
InitialState displaced(const Body<Dim>& body, const F& f) {
  InitialState state;
  state.displacement = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(body.count()) * Dim);
  for (Index i = 0; i < body.count(); ++i)
    state.displacement[static_cast<Eigen::Index>(i) * Dim] = f(body.particles.position[i][0]);
  return state;
}

struct Recorded {
  std::vector<HistoryRow> rows;
  std::vector<std::int64_t> frames;
  std::vector<IntegratorState> checkpoints;
  TransientResult result;
};

template <int Dim>
Recorded record(const Model& model, const TransientOptions& options, bool initial_bump = false,
                const IntegratorState* resume = nullptr, std::int64_t stop_at = -1) {
  Body<Dim> body = build_body<Dim>(model);
  Recorded r;
  std::int64_t step = 0;
  TransientObserver<Dim> observer;
  observer.history = [&](const HistoryRow& row) {
    r.rows.push_back(row);
    step = row.step;
  };
  observer.fields = [&](const TransientFrame<Dim>& frame) { r.frames.push_back(frame.step); };
  observer.checkpoint = [&](const IntegratorState& state) { r.checkpoints.push_back(state); };
  observer.stop = [&] { return stop_at >= 0 && step >= stop_at; };
  const InitialState initial = initial_bump ? displaced(body,
                                                        [](double x) {  // its waves are about 0.22 long
                                                          const double s = (x - 0.5) * (x - 0.5) / 0.0025;
                                                          return 1e-3 * (1.0 - 2.0 * s) * std::exp(-s);
                                                        })
                                            : InitialState{};
  r.result = run_transient(body, options, initial, observer, resume);
  return r;
}

inline double largest_imbalance(const Recorded& r) {
  double largest = 0.0;
  double scale = 0.0;
  for (const HistoryRow& row : r.rows) {
    largest = std::max(largest, std::abs(row.energies.balance()));
    scale = std::max(scale, row.energies.kinetic + row.energies.strain);
  }
  return largest / scale;
}

inline constexpr TimeMethod methods[] = {TimeMethod::central_difference, TimeMethod::newmark, TimeMethod::hht,
                                         TimeMethod::modal};

inline TransientOptions with_method(TransientOptions options, TimeMethod method) {
  options.method = method;
  if (method == TimeMethod::hht) options.newmark.alpha = -0.1;
  options.modes = 10000;
  return options;
}

}  // namespace perimode::test
