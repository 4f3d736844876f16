// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "transient_runs.hpp"

namespace perimode::test {

/// A plate with an edge crack, held at x- and pulled at x+ and y+, E = rho = 1.
inline Model torn_plate() {
  Model m = box_model({12, 10}, 0.1, 2.01);
  fix_face(m, 0, false, 2, {0, 1});
  add_crack(m, {{0.6, -0.01}, {0.6, 0.31}});
  return m;
}

/// The same pulled by given motion of x+, which shears it too.
inline Model moved_plate() {
  Model m = torn_plate();
  m.boundary.push_back(
      {Prescribe{{{0, 0.08}, {1, 0.02}}, face(0, true, 2), {TimeFunction::Kind::ramp, 3.0, 0.0, {}, {}, {}}},
       {}});
  return m;
}

inline TransientOptions tearing(TimeMethod method, double end, double dt) {
  TransientOptions options = with_method(until(end), method);
  options.dt = dt;
  options.critical_stretch = {0.01};
  return options;
}

inline TransientOptions with_pull(TransientOptions options) {
  options.loads = {
      {Traction{{0.03, 0.01}}, face(0, true, 1), {TimeFunction::Kind::ramp, 2.0, 0.0, {}, {}, {}}, {}}};
  options.no_fail = {face(0, true, 2)};
  return options;
}

template <int Dim>
std::vector<std::uint64_t> alive_bits(const Body<Dim>& body) {
  return std::visit([](const auto& bonds) { return bonds.alive; }, body.bonds);
}

/// A run that also keeps the bonds as they are at every row.
template <int Dim>
struct Watched {
  std::vector<HistoryRow> rows;
  std::vector<Eigen::VectorXd> displacement;
  std::vector<std::vector<std::uint64_t>> alive;
  TransientResult result;
};

/// v = rate (x - centre): what shatters a body.
template <int Dim>
Eigen::VectorXd spreading(const Body<Dim>& body, double rate) {
  Point<Dim> centre = Point<Dim>::Zero();
  for (const Point<Dim>& x : body.particles.position) centre += x / static_cast<double>(body.count());
  Eigen::VectorXd v(static_cast<Eigen::Index>(body.count()) * Dim);
  for (Index i = 0; i < body.count(); ++i)
    v.template segment<Dim>(static_cast<Eigen::Index>(i) * Dim) =
        rate * (body.particles.position[static_cast<std::size_t>(i)] - centre);
  return v;
}

template <int Dim>
Watched<Dim> watch(const Model& model, TransientOptions options, double rate = 0.0) {
  Body<Dim> body = build_body<Dim>(model);
  const InitialState initial{{}, spreading(body, rate)};
  options.fields_every = 1;
  Watched<Dim> watched;
  TransientObserver<Dim> observer;
  observer.history = [&](const HistoryRow& row) { watched.rows.push_back(row); };
  observer.fields = [&](const TransientFrame<Dim>& frame) {
    watched.displacement.push_back(frame.displacement);
    watched.alive.push_back(alive_bits(*frame.body));
  };
  watched.result = run_transient(body, options, initial, observer);
  return watched;
}

}  // namespace perimode::test
