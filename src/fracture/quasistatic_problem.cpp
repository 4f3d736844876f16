// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "fracture/crack_run.hpp"
#include "perimode/assembly/assemble.hpp"
#include "perimode/assembly/operators.hpp"
#include "perimode/core/error.hpp"
#include "perimode/modal/rigid.hpp"
#include "statics/problem.hpp"

namespace perimode {

namespace {

bool constant(const TimeFunction& time) { return time.kind == TimeFunction::Kind::constant; }

void refuse_time(const Where& where) {
  invalid_input(
      {"loads and prescribed motion without `time` in event control, where the load factor scales them",
       "a function of time", "leave `time` out, or use control: steps", where});
}

template <int Dim>
BondLimits bond_limits(const Body<Dim>& body, const QuasistaticOptions& options) {
  BondLimits limits{options.critical_stretch, {}};
  if (limits.critical_stretch.size() != body.density.size()) {
    invalid_input({fmt::format("{} critical stretches, one per block", body.density.size()),
                   fmt::format("{}", limits.critical_stretch.size()), "give one per block", options.where});
  }
  if (std::none_of(limits.critical_stretch.begin(), limits.critical_stretch.end(),
                   [](double s) { return std::isfinite(s); })) {
    invalid_input({"a material that breaks", "no fracture energy or critical stretch",
                   "give material.fracture_energy (J/m2) or material.critical_stretch", options.where});
  }
  if (options.no_fail.empty()) return limits;
  limits.no_fail.assign(static_cast<std::size_t>(body.count()), 0);
  for (const Region& region : options.no_fail) {
    const std::vector<Index> chosen = select(region, body.particles);
    if (chosen.empty()) {
      invalid_input({"a no_fail region that holds particles", "none in it", "move or enlarge the region",
                     region.where});
    }
    for (const Index i : chosen) limits.no_fail[i] = 1;
  }
  return limits;
}

template <int Dim>
Eigen::VectorXd given_of(const BoundaryMap<Dim>& map) {
  return Eigen::Map<const Eigen::VectorXd>(map.given.data(), static_cast<Eigen::Index>(map.given.size()));
}

/// Live and dead driving: the load factor scales the first.
template <int Dim>
void pose_events(const Body<Dim>& body, const QuasistaticOptions& options, QuasistaticProblem& problem) {
  for (const auto* loads : {&options.loads, &options.dead_loads}) {
    for (const Load& load : *loads)
      if (!constant(load.time)) refuse_time(load.where);
  }
  for (const TimeFunction& time : body.boundary.time)
    if (!constant(time)) refuse_time(options.where);
  const Eigen::VectorXd given = given_of(body.boundary);
  const Eigen::VectorXd still = Eigen::VectorXd::Zero(given.size());
  Driving live{load_vector(body.particles, options.loads), still};
  Driving dead{load_vector(body.particles, options.dead_loads), still};
  problem.motion_driven = live.load.isZero(0.0);
  (problem.motion_driven ? live : dead).given = given;
  problem.direction = problem.motion_driven ? live.given : live.load;
  problem.parts.push_back(std::move(live));
  if (!dead.load.isZero(0.0) || !dead.given.isZero(0.0)) problem.parts.push_back(std::move(dead));
}

/// One driving per function of time.
template <int Dim>
void pose_steps(const Body<Dim>& body, const QuasistaticOptions& options, QuasistaticProblem& problem) {
  if (!options.dead_loads.empty()) {
    invalid_input({"dead_loads in event control alone", "control: steps",
                   "list them under loads: a load without `time` acts in full from the first step",
                   options.dead_loads.front().where});
  }
  const auto part_of = [&](const TimeFunction& time) -> Driving& {
    for (std::size_t k = 0; k < problem.parts.size(); ++k)
      if (same(problem.time[k], time)) return problem.parts[k];
    problem.time.push_back(time);
    const auto dofs = static_cast<Eigen::Index>(body.boundary.given.size());
    problem.parts.push_back({Eigen::VectorXd::Zero(dofs), Eigen::VectorXd::Zero(dofs)});
    return problem.parts.back();
  };
  for (const Load& load : options.loads) part_of(load.time).load += load_vector(body.particles, {load});
  for (std::size_t k = 0; k < body.boundary.time.size(); ++k) {
    const Eigen::VectorXd given = given_of(with_only(body.boundary, static_cast<int>(k)));
    if (!given.isZero(0.0)) part_of(body.boundary.time[k]).given += given;
  }
  Driving whole = {Eigen::VectorXd::Zero(static_cast<Eigen::Index>(body.boundary.given.size())), {}};
  whole.given = whole.load;
  for (const Driving& part : problem.parts) {
    whole.load += part.load;
    whole.given += part.given;
  }
  problem.motion_driven = whole.load.isZero(0.0);
  problem.direction = problem.motion_driven ? whole.given : whole.load;
}

}  // namespace

template <int Dim>
QuasistaticProblem pose_quasistatic(const Body<Dim>& body, const QuasistaticOptions& options) {
  QuasistaticProblem problem;
  problem.limits = bond_limits(body, options);
  if (options.control == QuasistaticControl::event) {
    pose_events(body, options, problem);
  } else {
    pose_steps(body, options, problem);
  }
  problem.size = problem.direction.size() > 0 ? problem.direction.norm() : 0.0;
  if (!(problem.size > 0.0)) {
    invalid_input({"something that loads or moves the body", "none",
                   "give analysis.quasistatic.loads, or a prescribed displacement in boundary",
                   options.where});
  }
  problem.direction /= problem.size;
  if (body.boundary.free == 0) {
    invalid_input({"a body with free particles", "every component fixed or prescribed", "free some of them",
                   options.where});
  }
  const LinearOperator stiffness = stiffness_operator(body);
  if (asymmetry(stiffness) > symmetric_to_round_off) {
    invalid_input({"a symmetric boundary: fix, prescribe, mirror, antimirror or zero_layer",
                   "walls that make the equations unsymmetric",
                   "use one of these instead of surface_nodes (odd and even: in 1D alone)", options.where});
  }
  problem.mass = lumped_mass(body);
  problem.rigid = rigid_modes(body, stiffness, problem.mass);
  if (problem.rigid.cols() > 0) {
    for (const Driving& part : problem.parts)
      check_equilibrium(body, problem.rigid, free_part(body, part.load));
  }
  return problem;
}

#define PERIMODE_POSE(D) \
  template QuasistaticProblem pose_quasistatic<D>(const Body<D>&, const QuasistaticOptions&)
PERIMODE_POSE(1);
PERIMODE_POSE(2);
PERIMODE_POSE(3);
#undef PERIMODE_POSE

}  // namespace perimode
