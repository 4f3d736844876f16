// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "perimode/assembly/model.hpp"

namespace perimode::test {

/// Box [0, cells * spacing] with E = rho = 1 and a constant kernel; tests change what they need.
inline Model box_model(const std::vector<int>& cells, double spacing, double ratio) {
  Model m;
  m.dimension = static_cast<int>(cells.size());
  GridSpec grid;
  grid.spacing = spacing;
  for (int n : cells) {
    grid.lower.push_back(0.0);
    grid.upper.push_back(n * spacing);
  }
  m.particles = grid;
  m.horizon = {HorizonSpec::Rule::ratio, ratio, {}};
  m.material.youngs_modulus = 1.0;
  m.material.density = 1.0;
  return m;
}

inline void add_wall(Model& m, int axis, bool upper, WallType type) {
  m.boundary.push_back({Wall{{axis, upper}, type}, {}});
}

/// The same wall on both faces of an axis.
inline void add_walls(Model& m, int axis, WallType type) {
  add_wall(m, axis, false, type);
  add_wall(m, axis, true, type);
}

/// Surface nodes with formulas of their displacement, one per component (none: zero).
inline void add_surface_nodes(Model& m, int axis, bool upper,
                              const std::vector<std::string>& displacement = {},
                              const TimeFunction& time = {}) {
  Wall wall{{axis, upper}, WallType::surface_nodes};
  for (const auto& formula : displacement) wall.displacement.emplace_back(formula);
  wall.time = time;
  m.boundary.push_back({std::move(wall), {}});
}

/// Surface nodes of a bar with a given traction.
inline void add_surface_traction(Model& m, bool upper, double traction, const TimeFunction& time = {}) {
  Wall wall{{0, upper}, WallType::surface_nodes};
  wall.traction = traction;
  wall.time = time;
  m.boundary.push_back({std::move(wall), {}});
}

/// The formulas of u = h x, one per component.
template <int Dim>
std::vector<std::string> linear_field(const Eigen::Matrix<double, Dim, Dim>& h) {
  std::vector<std::string> formulas;
  for (int a = 0; a < Dim; ++a) {
    std::string text = "0";
    for (int b = 0; b < Dim; ++b) text += fmt::format(" + ({:.17g}) * {}", h(a, b), "xyz"[b]);
    formulas.push_back(text);
  }
  return formulas;
}

inline void fix_face(Model& m, int axis, bool upper, int layers, std::vector<int> components) {
  m.boundary.push_back({Fix{std::move(components), Region{FaceRegion{{axis, upper}, layers, 0.0}, {}}}, {}});
}

inline void add_crack(Model& m, std::vector<Coordinates> points) {
  m.precracks.push_back({std::move(points), {}});
}

}  // namespace perimode::test
