// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/stopwatch.hpp"
#include "fracture/crack_run.hpp"
#include "perimode/assembly/assemble.hpp"
#include "perimode/core/error.hpp"

namespace perimode {

namespace {

constexpr double tie = 1e-6;  ///< of the critical stretch: bonds that break together
/// A load factor beyond so many times the largest so far: the stretches that ask for it are round-off.
constexpr double out_of_reach = 1e7;
/// Strains below so much of the displacements over the body's length are round-off.
constexpr double no_strain = 1e-10;

/// Whether u, of strain energy `energy`, is more than a rigid motion and round-off.
template <int Dim>
bool stretches(const Body<Dim>& body, const Eigen::VectorXd& u, double energy) {
  Point<Dim> low = body.particles.position[0], high = low;
  for (const Point<Dim>& x : body.particles.position) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const double size = u.template lpNorm<Eigen::Infinity>();
  if (!(size > 0.0)) return false;
  const double strain = no_strain * size / std::max((high - low).norm(), 1e-300);
  const Eigen::VectorXd uniform = [&] {
    Eigen::VectorXd x(u.size());
    for (Index i = 0; i < body.count(); ++i)
      x.segment<Dim>(static_cast<Eigen::Index>(i) * Dim) = strain * (body.particles.position[i] - low);
    return x;
  }();
  return energy > bond_energy(body, uniform)[0];
}

/// u_0 + factor u_1
Driving at_factor(const std::vector<Driving>& parts, double factor) {
  Driving sum{factor * parts[0].load, factor * parts[0].given};
  if (parts.size() > 1) {
    sum.load += parts[1].load;
    sum.given += parts[1].given;
  }
  return sum;
}

[[noreturn]] void beyond_at_zero(const FirstBreak& zero) {
  invalid_input(
      {"every bond below its critical stretch at load factor 0",
       fmt::format("one at {:.4g} times its critical stretch under dead loads and given motion alone",
                   zero.worst),
       "lower analysis.quasistatic.dead_loads, or the prescribed displacement, which stands in full "
       "where there are loads; or raise the fracture energy",
       {}});
}

[[noreturn]] void nothing_stretches() {
  invalid_input({"a load that stretches a bond that may break",
                 "none: every such bond is in compression or at rest",
                 "turn the load round, or leave fewer particles in analysis.quasistatic.no_fail",
                 {}});
}

}  // namespace

template <int Dim>
QuasistaticResult run_events(CrackRun<Dim>& run) {
  const QuasistaticProblem& problem = run.problem();
  const QuasistaticStop& stop = run.options().stop;
  const bool dead = problem.parts.size() > 1;
  std::vector<Eigen::VectorXd> u;
  for (;;) {
    if (!run.solve(problem.parts, u)) return run.finish(QuasistaticStatus::not_converged, {});
    if (run.event() == 0 && run.spring_share() > separating_share) not_held();
    if (run.event() > 0 && stop.separated && run.spring_share() > separating_share)
      return run.finish(QuasistaticStatus::separated, "a piece that carries load has lost its support");
    const Eigen::VectorXd none;
    const auto searching = Clock::now();
    const FirstBreak next = first_break(run.body(), problem.limits, dead ? u[1] : none, u[0], tie);
    run.result().seconds_search += seconds_since(searching);
    if (run.event() == 0) {
      if (dead) {
        const FirstBreak zero = first_break(run.body(), problem.limits, none, u[1], tie);
        if (zero.factor <= 1.0) beyond_at_zero(FirstBreak{0.0, {}, 1.0 / zero.factor, {}});
      }
      if (!std::isfinite(next.factor) || !stretches(run.body(), u[0], next.energy[2])) nothing_stretches();
    }
    // Stretches that are round-off of the displacements: the bonds of the largest one may not be found again.
    const bool lost = next.bonds.empty() || (!dead && next.worst > 1.0 + 2.0 * tie);
    if (!std::isfinite(next.factor) || lost ||
        (run.event() > 0 && next.factor > out_of_reach * std::abs(run.result().peak_load))) {
      return problem.motion_driven
                 ? run.finish(QuasistaticStatus::separated, "the given motion stretches no bond any more")
                 : run.finish(QuasistaticStatus::unstretched, "the loads stretch no bond that may break");
    }
    if (next.factor < 0.0 || next.worst > 1.0 + 2.0 * tie) {
      return run.finish(QuasistaticStatus::dead_loads,
                        "the dead loads (and given motion) break the body without the others");
    }
    const double factor = next.factor;
    Eigen::VectorXd at = factor * u[0];
    if (dead) at += u[1];
    run.reach(at, at_factor(problem.parts, factor),
              next.energy[0] + factor * (2.0 * next.energy[1] + factor * next.energy[2]),
              dead ? std::vector<double>{factor, 1.0} : std::vector<double>{factor});
    QuasistaticRow row = run.row(factor);
    run.start_row(row);
    if (stop.load_drop > 0.0 && row.force < (1.0 - stop.load_drop) * run.peak_force()) {
      if (run.end_row(row)) return run.finish(QuasistaticStatus::interrupted, {});
      return run.finish(QuasistaticStatus::load_drop, fmt::format("the load has fallen by {:.3g} of its peak",
                                                                  1.0 - row.force / run.peak_force()));
    }
    run.break_bonds(next.bonds);
    row.breaking_bonds = run.broken() - row.broken_bonds;
    if (run.end_row(row)) return run.finish(QuasistaticStatus::interrupted, {});
    run.sink().report(
        fmt::format("event {}, load factor {:.6g}, {} bonds broken", row.event, factor, run.broken()));
    if (stop.events > 0 && row.event >= stop.events)
      return run.finish(QuasistaticStatus::events, fmt::format("{} events, as asked", row.event));
  }
}

#define PERIMODE_EVENTS(D) template QuasistaticResult run_events<D>(CrackRun<D>&)
PERIMODE_EVENTS(1);
PERIMODE_EVENTS(2);
PERIMODE_EVENTS(3);
#undef PERIMODE_EVENTS

}  // namespace perimode
