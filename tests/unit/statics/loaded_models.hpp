// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "perimode/statics/static.hpp"
#include "support/models.hpp"

namespace perimode::test {

inline Region face(int axis, bool upper, int layers) { return {FaceRegion{{axis, upper}, layers, 0.0}, {}}; }

inline StaticOptions loaded(std::vector<Load> loads, StaticSolver solver = StaticSolver::automatic) {
  StaticOptions options;
  options.loads = std::move(loads);
  options.solver = solver;
  options.tolerance = 1e-11;
  return options;
}

inline void prescribe(Model& m, std::vector<std::pair<int, double>> components, Region at) {
  m.boundary.push_back({Prescribe{std::move(components), std::move(at)}, {}});
}

/// A plate held at x- and pulled and sheared at x+, 12 x 8 particles.
inline Model cantilever() {
  Model m = box_model({12, 8}, 0.1, 3.0);
  m.volume_correction = VolumeCorrection::linear;
  fix_face(m, 0, false, 2, {0, 1});
  return m;
}
inline std::vector<Load> end_load() { return {{Traction{{2e-3, -1e-3}}, face(0, true, 1)}}; }

/// The solution of a model; it has to converge.
template <int Dim>
StaticResult solved(const Model& model, const StaticOptions& options) {
  StaticResult result = solve_static(build_body<Dim>(model), model.boundary, options);
  EXPECT_EQ(result.status, StaticStatus::converged) << result.message;
  EXPECT_LE(result.residual, 1e-10);
  EXPECT_LE(result.balance, 1e-10);
  return result;
}

}  // namespace perimode::test
