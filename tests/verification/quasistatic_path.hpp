// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "perimode/assembly/critical_stretches.hpp"
#include "perimode/fracture/quasistatic.hpp"
#include "support/models.hpp"
#include "verification/brute_force_path.hpp"

namespace perimode::test {

/// What an observer saw of a quasi-static run.
struct ObservedPath {
  QuasistaticResult result;
  std::vector<QuasistaticRow> rows;
  std::vector<PathEvent> events;
  std::vector<LoosePiece> loose;
};

template <int Dim>
QuasistaticOptions path_options(const Model& model, const Body<Dim>& body, std::vector<Load> loads) {
  QuasistaticOptions options;
  options.loads = std::move(loads);
  options.critical_stretch = critical_stretches(model, body);
  options.area = crack_area_scale(model, body);
  options.solver.tolerance = 1e-12;  // energies balance to the residual of the solutions
  return options;
}

template <int Dim>
ObservedPath observe_path(Body<Dim>& body, const QuasistaticOptions& options) {
  ObservedPath path;
  QuasistaticObserver<Dim> observer;
  observer.row = [&](const QuasistaticRow& row) { path.rows.push_back(row); };
  observer.broken = [&](const std::vector<BrokenBond<Dim>>& bonds) {
    PathEvent event;
    if (!path.rows.empty()) {
      event.factor = path.rows.back().load_factor;
      event.energy = path.rows.back().stored_energy;
    }
    for (const BrokenBond<Dim>& bond : bonds)
      event.bonds.push_back({std::min(bond.first, bond.second), std::max(bond.first, bond.second)});
    std::sort(event.bonds.begin(), event.bonds.end());
    path.events.push_back(std::move(event));
  };
  observer.loose = [&](const LoosePiece& piece) { path.loose.push_back(piece); };
  path.result = run_quasistatic<Dim>(body, options, observer);
  return path;
}

/// The same bonds at every event, factors and energies within `relative`. `found` may go on where brute force
/// finds no equilibrium any more.
inline void expect_path(const std::vector<PathEvent>& found, const std::vector<PathEvent>& wanted,
                        double relative) {
  ASSERT_GE(found.size(), wanted.size());
  for (std::size_t n = 0; n < wanted.size(); ++n) {
    ASSERT_EQ(found[n].bonds, wanted[n].bonds) << "event " << n + 1 << " of " << wanted.size();
    ASSERT_NEAR(found[n].factor, wanted[n].factor, relative * wanted[n].factor) << "event " << n + 1;
    ASSERT_NEAR(found[n].energy, wanted[n].energy, relative * wanted[n].energy) << "event " << n + 1;
  }
}

/// What holds on every path: finite numbers, an energy balance of round-off, and an energy that falls at
/// every break, potential energy under loads (the compliance grows), stored energy under given motion (the
/// stiffness falls); until springs hold a piece that carries load.
inline void expect_sound(const ObservedPath& path, bool loads) {
  const auto held =
      std::find_if(path.loose.begin(), path.loose.end(), [](const auto& p) { return p.loaded; });
  const auto last_unheld = held == path.loose.end() ? path.result.events : held->event;
  ASSERT_FALSE(path.rows.empty());
  double last = loads ? 0.0 : HUGE_VAL;
  for (const QuasistaticRow& row : path.rows) {
    ASSERT_TRUE(std::isfinite(row.load_factor) && std::isfinite(row.displacement) &&
                std::isfinite(row.force) && std::isfinite(row.stored_energy))
        << "event " << row.event;
    EXPECT_LE(std::abs(row.balance()), 1e-10 * row.external_work) << "event " << row.event;
    if (row.event > last_unheld) continue;
    const double unit = row.stored_energy / (row.load_factor * row.load_factor);
    if (loads)
      EXPECT_GE(unit, last * (1.0 - 1e-9)) << "event " << row.event;
    else
      EXPECT_LE(unit, last * (1.0 + 1e-9)) << "event " << row.event;
    last = unit;
  }
  EXPECT_TRUE(path.result.displacement.allFinite());
  EXPECT_LE(path.result.worst_balance, 1e-10);
}

inline Load traction(int axis, bool upper, Coordinates value) {
  Load load;
  load.what = Traction{std::move(value)};
  load.at = Region{FaceRegion{{axis, upper}, 1, 0.0}, {}};
  return load;
}

inline void prescribe_face(Model& m, int axis, bool upper, int layers,
                           std::vector<std::pair<int, double>> components) {
  m.boundary.push_back(
      {Prescribe{std::move(components), Region{FaceRegion{{axis, upper}, layers, 0.0}, {}}}, {}});
}

/// Particles of regions, ascending.
template <int Dim>
std::vector<Index> particles_in(const std::vector<Region>& regions, const Particles<Dim>& particles) {
  std::vector<Index> all;
  for (const Region& region : regions)
    for (const Index i : select(region, particles)) all.push_back(i);
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace perimode::test
