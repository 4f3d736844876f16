// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/fracture/griffith_load.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "fracture/crack_run.hpp"
#include "perimode/core/error.hpp"

namespace perimode {

namespace {

/// Strain energy at load factor 1, J.
template <int Dim>
double unit_energy(CrackRun<Dim>& run, const Where& where) {
  std::vector<Eigen::VectorXd> u;
  if (!run.solve(run.problem().parts, u)) {
    invalid_input({"a body that its pre-crack and an increment of it leave whole", run.result().message,
                   "set analysis.quasistatic.griffith to false", where});
  }
  return first_break(run.body(), run.problem().limits, Eigen::VectorXd(), u[0], 0.0).energy[2];
}

}  // namespace

template <int Dim>
GriffithLoad griffith_load(const Body<Dim>& body, const QuasistaticOptions& options,
                           const Crack<Dim>& increment, double fracture_energy) {
  Body<Dim> copy = body;
  QuasistaticProblem problem = pose_quasistatic(copy, options);
  if (problem.parts.size() > 1) {
    invalid_input({"loads or prescribed motion alone for the Griffith load",
                   "dead loads, or prescribed motion beside loads",
                   "set analysis.quasistatic.griffith to false, or leave only one of them", options.where});
  }
  const std::vector<BondRef> bonds = crossing_bonds(copy, increment);
  if (bonds.empty()) {
    invalid_input({"a pre-crack that can grow by one spacing",
                   "one that ends where no bond crosses its continuation",
                   "set analysis.quasistatic.griffith to false", options.where});
  }
  const bool motion_driven = problem.motion_driven;
  const bool matrix_free = choose_equilibrium(copy, options.solver, options.matrix_free).matrix_free;
  const QuasistaticObserver<Dim> nobody;
  const Sink nowhere;
  CrackRun<Dim> run(copy, options, nobody, nowhere, std::move(problem), matrix_free, nullptr);
  GriffithLoad griffith;
  griffith.cut = static_cast<Offset>(bonds.size());
  griffith.increment = extent(increment) * (Dim == 2 ? body.section : 1.0);
  griffith.fracture_energy = fracture_energy;
  const double before = unit_energy(run, options.where);
  run.break_bonds(bonds);
  const double after = unit_energy(run, options.where);
  griffith.energy_release_rate = (motion_driven ? before - after : after - before) / griffith.increment;
  if (!(griffith.energy_release_rate > 0.0)) {
    invalid_input({"a pre-crack whose growth releases energy",
                   fmt::format("{:.3g} J/m2 at load factor 1", griffith.energy_release_rate),
                   "set analysis.quasistatic.griffith to false, or load the crack", options.where});
  }
  griffith.load_factor = std::sqrt(fracture_energy / griffith.energy_release_rate);
  return griffith;
}

#define PERIMODE_GRIFFITH_LOAD(D) \
  template GriffithLoad griffith_load<D>(const Body<D>&, const QuasistaticOptions&, const Crack<D>&, double)
PERIMODE_GRIFFITH_LOAD(1);
PERIMODE_GRIFFITH_LOAD(2);
PERIMODE_GRIFFITH_LOAD(3);
#undef PERIMODE_GRIFFITH_LOAD

}  // namespace perimode
