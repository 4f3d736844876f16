// SPDX-License-Identifier: BSD-3-Clause
#include "plate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "perimode/assembly/critical_stretches.hpp"
#include "perimode/statics/static.hpp"

namespace perimode::studies {
namespace {

constexpr double ratio = 3.0;
constexpr int grip_rows = 3;

double spacing_of(const Model& model) { return std::get<GridSpec>(model.particles).spacing; }

std::vector<Region> held_regions(const Model& model) {
  const double depth = 2.0 * ratio * spacing_of(model);
  return {Region{BoxRegion{{0.0, 0.0}, {plate_side, depth}}, {}},
          Region{BoxRegion{{0.0, plate_side - depth}, {plate_side, plate_side}}, {}}};
}

}  // namespace

Model plate_with_hole_and_crack(int cells) {
  Model model;
  model.dimension = 2;
  model.plane = Plane::stress;
  model.thickness = 5e-3;
  GridSpec grid;
  grid.lower = {0.0, 0.0};
  grid.upper = {plate_side, plate_side};
  grid.spacing = plate_side / cells;
  grid.remove = {Region{BallRegion{{hole_x, hole_y}, hole_r}, {}}};
  model.particles = grid;
  model.horizon = {HorizonSpec::Rule::ratio, ratio, {}};
  model.volume_correction = VolumeCorrection::linear;
  model.material.youngs_modulus = 3e9;
  model.material.density = 1200.0;
  model.material.fracture_energy = 300.0;
  model.precracks.push_back({{{0.0, crack_y}, {crack_tip_x, crack_y}}, {}});
  const auto grip = [](bool upper) { return Region{FaceRegion{{1, upper}, grip_rows, 0.0}, {}}; };
  model.boundary.push_back({Fix{{0, 1}, grip(false)}, {}});
  model.boundary.push_back({Prescribe{{{0, 0.0}, {1, 1e-4}}, grip(true)}, {}});
  return model;
}

QuasistaticOptions tear_apart(const Model& model, const Body<2>& body) {
  QuasistaticOptions options;
  options.no_fail = held_regions(model);
  options.critical_stretch = critical_stretches(model, body);
  options.area = crack_area_scale(model, body);
  options.solver.only = SolveWay::update;
  return options;
}

double first_load_by_statics(const Model& model, const Body<2>& body) {
  StaticOptions options;
  options.tolerance = 1e-12;
  const StaticResult still = solve_static(body, model.boundary, options);
  std::vector<bool> holds(static_cast<std::size_t>(body.count()), false);
  for (const Region& region : held_regions(model))
    for (const Index i : select(region, body.particles)) holds[static_cast<std::size_t>(i)] = true;
  double largest = 0.0;
  for (Index i = 0; i < body.count(); ++i) {
    for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<2>& end) {
      if (holds[static_cast<std::size_t>(i)] || holds[static_cast<std::size_t>(end.neighbour)]) return;
      const Point<2> eta =
          still.displacement.segment<2>(2 * end.neighbour) - still.displacement.segment<2>(2 * i);
      largest = std::max(largest, end.xi.dot(eta) / end.xi.squaredNorm());
    });
  }
  return critical_stretches(model, body)[0] / largest;
}

Landmarks landmarks(const std::vector<BrokenBond<2>>& broken, double spacing) {
  Landmarks found;
  found.gap = std::numeric_limits<double>::infinity();
  for (const BrokenBond<2>& bond : broken) {
    const Point<2> from_centre = bond.middle - Point<2>(hole_x, hole_y);
    if (from_centre[0] > 0.0) {
      if (found.leaves == 0) found.leaves = bond.event;
      continue;
    }
    const double gap = std::abs(from_centre.norm() - hole_r);
    if (found.meets == 0 && gap < spacing) found.meets = bond.event;
    found.gap = std::min(found.gap, gap);
  }
  return found;
}

}  // namespace perimode::studies
