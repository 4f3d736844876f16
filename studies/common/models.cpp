// SPDX-License-Identifier: BSD-3-Clause
#include "studies/common/models.hpp"

namespace perimode::studies {
namespace {

void add_wall(Model& model, int axis, bool upper, WallType type) {
  BoundaryCondition& condition = model.boundary.emplace_back();
  condition.what = Wall{{axis, upper}, type, {}};
}

}  // namespace

Model separable_bar(double horizon, int ratio, const BarEnds& ends, bool self_cell) {
  Model model;
  model.dimension = 1;
  GridSpec grid;
  grid.lower = {0.0};
  grid.upper = {1.0};
  grid.spacing = horizon / ratio;
  model.particles = grid;
  model.horizon = {HorizonSpec::Rule::ratio, static_cast<double>(ratio), {}};
  constexpr double speed = 5000.0, density = 1000.0;  // only the speed matters
  model.material.youngs_modulus = density * speed * speed;
  model.material.density = density;
  model.material.micromodulus.kernel = Kernel::inverse_distance;
  model.volume_correction = VolumeCorrection::linear;
  model.self_cell = self_cell;
  if (ends.first) add_wall(model, 0, false, *ends.first);
  if (ends.second) add_wall(model, 0, true, *ends.second);
  return model;
}

Model separable_plate(int cells, double ratio, Micromodulus kernel, WallType wall) {
  Model model;
  model.dimension = 2;
  GridSpec grid;
  grid.lower = {0.0, 0.0};
  grid.upper = {1.0, 0.5};
  grid.spacing = 1.0 / cells;
  model.particles = grid;
  model.horizon = {HorizonSpec::Rule::ratio, ratio, {}};
  model.material.youngs_modulus = 1.0;
  model.material.density = 1.0;
  model.material.micromodulus = kernel;
  model.volume_correction = VolumeCorrection::linear;
  for (const int axis : {0, 1})
    for (const bool upper : {false, true}) add_wall(model, axis, upper, wall);
  return model;
}

}  // namespace perimode::studies
