// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>

#include "perimode/core/error.hpp"
#include "perimode/fracture/griffith.hpp"
#include "perimode/statics/static.hpp"

namespace perimode {

namespace {

/// U - f . u in equilibrium.
template <int Dim>
double potential(const Body<Dim>& body, const StaticOptions& options) {
  const StaticResult result = solve_static(body, {}, options);
  if (result.status != StaticStatus::converged)
    throw Error(ErrorKind::solver_failure, "the Griffith load: " + result.message);
  return result.strain_energy - load_vector(body.particles, options.loads).dot(result.displacement);
}

}  // namespace

template <int Dim>
GriffithLoad griffith_load(const Body<Dim>& body, const std::vector<Load>& loads, const Crack<Dim>& increment,
                           double fracture_energy) {
  StaticOptions options;
  options.loads = loads;
  options.tolerance = 1e-10;  // the two energies differ by about a spacing over the crack's length
  const std::vector<BondRef> bonds = crossing_bonds(body, increment);
  if (bonds.empty()) {
    invalid_input({"a crack whose continuation cuts bonds",
                   "none",
                   "end the first pre-crack inside the body, or leave analysis.quasistatic.griffith out",
                   {}});
  }
  GriffithLoad load;
  load.fracture_energy = fracture_energy;
  load.increment = extent(increment) * (Dim == 2 ? body.section : 1.0);
  load.cut = static_cast<Offset>(bonds.size());
  const double before = potential(body, options);
  Body<Dim> longer = body;
  for (const BondRef& bond : bonds) break_bond(longer.bonds, bond.particle, bond.slot);
  load.energy_release_rate = (before - potential(longer, options)) / load.increment;
  // Bonds of negative stiffness may make a crack release nothing: then no load lets it grow.
  load.load_factor = load.energy_release_rate > 0.0 ? std::sqrt(fracture_energy / load.energy_release_rate)
                                                    : std::numeric_limits<double>::infinity();
  return load;
}

#define PERIMODE_GRIFFITH_LOAD(D) \
  template GriffithLoad griffith_load<D>(const Body<D>&, const std::vector<Load>&, const Crack<D>&, double)
PERIMODE_GRIFFITH_LOAD(1);
PERIMODE_GRIFFITH_LOAD(2);
PERIMODE_GRIFFITH_LOAD(3);
#undef PERIMODE_GRIFFITH_LOAD

}  // namespace perimode
