// SPDX-License-Identifier: BSD-3-Clause
#include "studies/common/crack_opening.hpp"

#include <cmath>
#include <numbers>

#include "perimode/assembly/critical_stretches.hpp"

namespace perimode::studies {
namespace {

constexpr double youngs_modulus = 1e5, energy_of_fracture = 0.358, nu = 0.25;

}  // namespace

Model crack_opening_patch(int cells, double ratio, Calibration calibration) {
  Model model;
  model.dimension = 2;
  model.plane = Plane::strain;
  const double spacing = 1.0 / cells;
  GridSpec grid;
  grid.lower = {0.0, -1.0};
  grid.upper = {1.0, 1.0};
  grid.spacing = spacing;
  model.particles = grid;
  model.horizon = {HorizonSpec::Rule::ratio, ratio, {}};
  model.material.youngs_modulus = youngs_modulus;
  model.material.density = 1000.0;  // of no consequence unless the load is ramped
  model.material.micromodulus.kernel = Kernel::inverse_distance;
  model.material.fracture_energy = energy_of_fracture;
  model.calibration = calibration;
  model.precracks.push_back({{{0.0, 0.0}, {opening_crack, 0.0}}, {}});
  const double x = 1.0 - 0.5 * spacing, y = 0.5 * spacing;
  model.boundary.push_back({Fix{{0, 1}, Region{NearestRegion{{x, y}}, {}}}, {}});
  model.boundary.push_back({Fix{{0}, Region{NearestRegion{{x, -y}}, {}}}, {}});
  return model;
}

QuasistaticOptions crack_opening_run(const Model& model, const Body<2>& body) {
  QuasistaticOptions options;
  const double protected_depth = 3.0 * model.horizon.value * std::get<GridSpec>(model.particles).spacing;
  for (const bool upper : {false, true}) {
    Load load;
    load.what = Traction{{0.0, upper ? 1.0 : -1.0}};
    load.at = Region{FaceRegion{{1, upper}, 1, 0.0}, {}};
    options.loads.push_back(load);
    const double from = upper ? 1.0 - protected_depth : -1.0;
    options.no_fail.push_back(Region{BoxRegion{{0.0, from}, {1.0, from + protected_depth}}, {}});
  }
  options.critical_stretch = critical_stretches(model, body);
  options.area = crack_area_scale(model, body);
  return options;
}

double crack_opening_stress(double a) {
  const double f = 1.12 + a * (-0.231 + a * (10.55 + a * (-21.72 + a * 30.39)));
  return std::sqrt(energy_of_fracture * youngs_modulus / (1.0 - nu * nu)) /
         (std::sqrt(std::numbers::pi * a) * f);
}

GriffithLoad crack_opening_griffith(const Model& model) {
  const Body<2> body = build_body<2>(model);
  return griffith_load(body, crack_opening_run(model, body).loads, crack_increment(model, body),
                       fracture_energy_of(model, body));
}

double griffith_ratio(const GriffithLoad& load, int cells) {
  return load.load_factor / crack_opening_stress(opening_crack + 0.5 / cells);
}

}  // namespace perimode::studies
