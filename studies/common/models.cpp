// SPDX-License-Identifier: BSD-3-Clause
#include "studies/common/models.hpp"

#include <cmath>

namespace perimode::studies {
namespace {

void add_wall(Model& model, int axis, bool upper, WallType type) {
  BoundaryCondition& condition = model.boundary.emplace_back();
  condition.what = Wall{{axis, upper}, type, {}};
}

/// Bulk modulus and density 1, bonds of energy density c s^2/2.
Model pmb_solid(int dimension, Calibration calibration) {
  Model model;
  model.dimension = dimension;
  model.plane = Plane::strain;
  model.material.youngs_modulus = 1.5;
  model.material.density = 1.0;
  model.material.micromodulus.kernel = Kernel::inverse_distance;
  model.calibration = calibration;
  return model;
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

double scabbia_pulse(double x) { return 0.02 * std::exp(-100.0 * (x - 0.5) * (x - 0.5)); }

std::vector<StandingWave> scabbia_series(const DispersionRelation& omega) {
  return released_pulse(1.0, 0.02, 0.5, 0.1, 79, omega);
}

Model separable_plate(int cells, double ratio, const Micromodulus& kernel, WallType wall) {
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

Model steel_bar(int cells, int ratio, const Micromodulus& kernel, VolumeCorrection correction,
                Calibration calibration, const BarEnds& ends) {
  Model model = separable_bar(static_cast<double>(ratio) / cells, ratio, ends);
  std::get<GridSpec>(model.particles).spacing = 1.0 / cells;
  model.area = 1e-6;
  model.material.youngs_modulus = 200e9;
  model.material.density = 7850.0;
  model.material.micromodulus = kernel;
  model.volume_correction = correction;
  model.calibration = calibration;
  return model;
}

Model pmb_lattice(const std::vector<int>& cells, double spacing, int squared_ratio, Calibration calibration) {
  Model model = pmb_solid(static_cast<int>(cells.size()), calibration);
  GridSpec grid;
  grid.spacing = spacing;
  for (const int n : cells) {
    grid.lower.push_back(0.0);
    grid.upper.push_back(n * spacing);
  }
  model.particles = grid;
  model.horizon = {HorizonSpec::Rule::ratio, std::sqrt(squared_ratio), {}};
  return model;
}

Model pmb_row(int cells, int squared_ratio, Calibration calibration, bool periodic) {
  Model model = pmb_lattice({cells, 1, 1}, 1.0 / cells, squared_ratio, calibration);
  model.periodic = {periodic, true, true};
  if (!periodic)
    for (const bool upper : {false, true}) add_wall(model, 0, upper, WallType::antimirror);
  return model;
}

Model pmb_cloud(const std::filesystem::path& file, int neighbours) {
  Model model = pmb_solid(3, Calibration::discrete);
  model.particles = CloudSpec{file, {}};
  model.horizon = {HorizonSpec::Rule::neighbours, static_cast<double>(neighbours), {}};
  constexpr double beyond = 10.0;
  const Region everywhere = {BoxRegion{{-beyond, -beyond, -beyond}, {beyond, beyond, beyond}}, {}};
  model.boundary.push_back({Fix{{1, 2}, everywhere}, {}});
  return model;
}

double pmb_speed() { return std::sqrt(1.8); }

}  // namespace perimode::studies
