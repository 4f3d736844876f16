// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "perimode/assembly/critical_stretches.hpp"
#include "perimode/fracture/crack_area.hpp"
#include "perimode/fracture/quasistatic.hpp"
#include "support/models.hpp"

namespace perimode::test {

/// A square plate of n x n cells, held below, with an edge crack from the left to `crack` of its width.
inline Model cracked_plate(int n, double crack) {
  Model m = box_model({n, n}, 1.0 / n, 3.0);
  fix_face(m, 1, false, 1, {0, 1});
  m.material.fracture_energy = 1e-4;
  if (crack > 0.0) add_crack(m, {{0.0, 0.5}, {crack, 0.5}});
  return m;
}

inline Region face(int axis, bool upper, int layers = 1) {
  return {FaceRegion{{axis, upper}, layers, 0.0}, {}};
}

inline Load pull(Coordinates traction, Region at) { return {Traction{std::move(traction)}, std::move(at)}; }

inline void prescribe(Model& m, int component, double value, Region at, TimeFunction time = {}) {
  m.boundary.push_back({Prescribe{{{component, value}}, std::move(at), std::move(time)}, {}});
}

template <int Dim>
QuasistaticOptions options_of(const Model& m, const Body<Dim>& body) {
  QuasistaticOptions o;
  o.critical_stretch = critical_stretches(m, body);
  o.area = crack_area_scale(m, body);
  return o;
}

/// Everything a run told.
template <int Dim>
struct Told {
  std::vector<QuasistaticRow> rows;
  std::vector<BrokenBond<Dim>> broken;
  std::vector<IntegratorState> checkpoints;
  std::vector<std::int64_t> frames;

  QuasistaticObserver<Dim> observer() {
    QuasistaticObserver<Dim> o;
    o.row = [this](const QuasistaticRow& row) { rows.push_back(row); };
    o.broken = [this](const std::vector<BrokenBond<Dim>>& b) {
      broken.insert(broken.end(), b.begin(), b.end());
    };
    o.checkpoint = [this](const IntegratorState& state) { checkpoints.push_back(state); };
    o.fields = [this](const QuasistaticFrame<Dim>& frame) { frames.push_back(frame.event); };
    return o;
  }
};

}  // namespace perimode::test
