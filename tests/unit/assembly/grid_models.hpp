// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "support/models.hpp"

namespace perimode::test {

inline Eigen::VectorXd random_vector(Eigen::Index n, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  return Eigen::VectorXd::NullaryExpr(n, [&] { return normal(random); });
}

inline Model box(const std::vector<int>& cells, double ratio = 3.0) {
  return box_model(cells, 1.0 / cells[0], ratio);
}

/// Three layers on the left held, as wide as the horizon.
inline Model clamped(const std::vector<int>& cells, double ratio = 3.0) {
  Model m = box(cells, ratio);
  std::vector<int> all;
  for (int a = 0; a < m.dimension; ++a) all.push_back(a);
  fix_face(m, 0, false, 3, all);
  return m;
}

/// Models of every kind the hierarchy treats in its own way, odd and even.
inline std::vector<std::pair<std::string, Model>> plane_models(int nx, int ny) {
  std::vector<std::pair<std::string, Model>> out;
  const auto add = [&](const std::string& name, const Model& m) { out.emplace_back(name, m); };
  add("clamped", clamped({nx, ny}));
  add("free", box({nx, ny}));
  const std::pair<std::string, WallType> walls[] = {{"mirror", WallType::mirror},
                                                    {"antimirror", WallType::antimirror},
                                                    {"zero layer", WallType::zero_layer}};
  for (const auto& [name, type] : walls) {
    Model m = box({nx, ny});
    add_walls(m, 0, type);
    add_walls(m, 1, type);
    add(name, m);
  }
  Model m = box({nx, ny});
  m.periodic = {true, true, false};
  add("periodic", m);
  m = clamped({nx, ny});
  add_wall(m, 1, true, WallType::mirror);
  add_crack(m, {{0.45, 0.3}, {0.45, 1.5}});  // into the wall and its image
  add("crack into a wall", m);
  m = clamped({nx, ny});
  m.periodic = {false, true, false};
  add_crack(m, {{0.45, 0.3}, {0.7, 1.2}});
  add("crack in a periodic strip", m);
  m = clamped({nx, ny});
  std::get<GridSpec>(m.particles).remove.push_back(Region{BallRegion{{0.5, 0.4}, 0.15}, {}});
  add("hole", m);
  m = clamped({nx, ny});
  m.blocks.push_back({"stiff", Region{BallRegion{{0.6, 0.4}, 0.25}, {}}});
  m.block_materials["stiff"] = m.material;
  m.block_materials["stiff"].youngs_modulus = 100.0;
  add("two materials", m);
  m = clamped({nx, ny});
  m.calibration = Calibration::discrete;
  add("calibrated", m);
  m = box({nx, ny});
  fix_face(m, 0, false, 3, {0});  // rollers: nodes with one free dof
  fix_face(m, 1, false, 2, {1});
  add("rollers", m);
  return out;
}

}  // namespace perimode::test
