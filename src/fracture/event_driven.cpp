// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/stopwatch.hpp"
#include "fracture/crack_run.hpp"
#include "perimode/core/error.hpp"

namespace perimode {

namespace {

constexpr double tie = 1e-6;  ///< of the critical stretch: bonds that break together
/// Strain energy per unit load factor, of the first one: below it no bond is stretched any more.
constexpr double unstretched = 1e-14;

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
    if (run.event() > 0 && stop.separated && run.spring_share() > separating_share)
      return run.finish(QuasistaticStatus::separated, "a piece that carries load has lost its support");
    const Eigen::VectorXd none;
    const auto searching = Clock::now();
    const FirstBreak next = first_break(run.body(), problem.limits, dead ? u[1] : none, u[0], tie);
    run.result().seconds_search += seconds_since(searching);
    if (run.event() == 0) {
      run.set_unit_energy(next.energy[2]);
      if (dead) {
        const FirstBreak zero = first_break(run.body(), problem.limits, none, u[1], tie);
        if (zero.factor <= 1.0) beyond_at_zero(FirstBreak{0.0, {}, 1.0 / zero.factor, {}});
      }
      if (!std::isfinite(next.factor)) nothing_stretches();
    }
    if (!std::isfinite(next.factor) || next.energy[2] <= unstretched * run.unit_energy()) {
      return problem.motion_driven
                 ? run.finish(QuasistaticStatus::separated, "the given motion stretches no bond any more")
                 : run.finish(QuasistaticStatus::unstretched, "the loads stretch no bond that may break");
    }
    // Stretches that are round-off of the displacements: the bonds of the largest one are not found again.
    if (next.bonds.empty() || (!dead && next.worst > 1.0 + 2.0 * tie))
      return run.finish(QuasistaticStatus::unstretched, "the loads stretch no bond that may break");
    if (next.factor < 0.0 || next.worst > 1.0 + 2.0 * tie) {
      return run.finish(QuasistaticStatus::dead_loads,
                        "the dead loads (and given motion) break the body without the others");
    }
    const double factor = next.factor;
    Eigen::VectorXd at = factor * u[0];
    if (dead) at += u[1];
    run.reach(at, at_factor(problem.parts, factor),
              next.energy[0] + factor * (2.0 * next.energy[1] + factor * next.energy[2]));
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
