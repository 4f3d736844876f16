// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/dispersion/lattice.hpp"

#include <fmt/format.h>

#include <cmath>
#include <variant>

#include "perimode/assembly/body.hpp"
#include "perimode/geometry/grid.hpp"

namespace perimode {
namespace {

void require_positive(double value, const char* name, const Where& where) {
  if (!(value > 0.0) || !std::isfinite(value)) {
    invalid_input({fmt::format("{} > 0", name), fmt::format("{}", value), "give it in SI units", where});
  }
}

double horizon_of(const HorizonSpec& h, double spacing) {
  if (!(h.value > 0.0)) {
    invalid_input({"body.horizon > 0", fmt::format("{}", h.value), "give {ratio: 3}", h.where});
  }
  if (h.rule == HorizonSpec::Rule::neighbours) {
    invalid_input(
        {"horizon {ratio} or {length} for a grid", "{neighbours}", "neighbours belong to clouds", h.where});
  }
  return h.rule == HorizonSpec::Rule::ratio ? h.value * spacing : h.value;
}

}  // namespace

template <int Dim>
Lattice<Dim> make_lattice(const Model& model) {
  if (model.dimension != Dim) {
    invalid_input({fmt::format("a model of dimension {}", Dim), fmt::format("{}", model.dimension),
                   "make the lattice for the model's dimension", model.where});
  }
  const auto* grid = std::get_if<GridSpec>(&model.particles);
  if (grid == nullptr) {
    invalid_input({"a grid, whose lattice has plane waves", "a cloud",
                   "use a grid, or estimate the waves of a periodic cloud by Rayleigh quotients",
                   std::get<CloudSpec>(model.particles).where});
  }
  const double section = Dim == 1 ? model.area : Dim == 2 ? model.thickness : 1.0;
  require_positive(section, Dim == 1 ? "body.area" : "body.thickness", model.where);
  const double spacing = make_grid<Dim>(grid->lower, grid->upper, grid->spacing, grid->where).spacing;
  const double horizon = horizon_of(model.horizon, spacing);
  const Material& material = model.material;
  require_positive(material.youngs_modulus, "youngs_modulus", material.where);
  require_positive(material.density, "density", material.where);
  require_lattice_kernel_fits(model);

  Lattice<Dim> lattice{{material, {Dim, model.plane, section}, horizon}, {}, {}};
  try {
    lattice.family = make_family<Dim>(spacing, horizon, model.volume_correction, model.self_cell);
  } catch (const Error& error) {
    throw at(error, model.horizon.where);
  }
  try {
    lattice.rates = bond_rates<Dim>(lattice.medium, lattice.family, model.calibration);
  } catch (const Error& error) {
    throw at(error, material.where);
  }
  return lattice;
}

template Lattice<1> make_lattice<1>(const Model&);
template Lattice<2> make_lattice<2>(const Model&);
template Lattice<3> make_lattice<3>(const Model&);

}  // namespace perimode
