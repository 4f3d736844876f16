// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "core/stopwatch.hpp"
#include "fracture/crack_run.hpp"

namespace perimode {

namespace {

constexpr double tie = 1e-6;  ///< of the critical stretch: bonds that break together
/// Strain energy per square of the motion, of the largest one so far: below it no bond is stretched any more.
constexpr double unstretched = 1e-14;
constexpr double at_rest = 1e-12;  ///< square of a load factor that says nothing

Driving at_instant(const QuasistaticProblem& problem, double t) {
  Driving sum{Eigen::VectorXd::Zero(problem.direction.size()),
              Eigen::VectorXd::Zero(problem.direction.size())};
  for (std::size_t k = 0; k < problem.parts.size(); ++k) {
    const double h = value_at(problem.time[k], t);
    sum.load += h * problem.parts[k].load;
    sum.given += h * problem.parts[k].given;
  }
  return sum;
}

/// The row of a step at the last state of equilibrium it reached.
template <int Dim>
QuasistaticRow row_of(const CrackRun<Dim>& run, const Driving& driving, double t, Offset before,
                      int solutions) {
  const QuasistaticProblem& problem = run.problem();
  const Eigen::VectorXd& in_full = problem.motion_driven ? driving.given : driving.load;
  QuasistaticRow row = run.row(problem.direction.dot(in_full) / problem.size);
  row.time = t;
  row.broken_bonds = before;
  row.breaking_bonds = run.broken() - before;
  row.iterations = solutions;
  return row;
}

}  // namespace

template <int Dim>
QuasistaticResult run_steps(CrackRun<Dim>& run) {
  const QuasistaticProblem& problem = run.problem();
  const QuasistaticOptions& options = run.options();
  std::vector<Eigen::VectorXd> u;
  while (run.event() < options.steps) {
    const std::int64_t step = run.event() + 1;
    const double t = static_cast<double>(step) * options.end / static_cast<double>(options.steps);
    const Driving driving = at_instant(problem, t);
    const Offset before = run.broken();
    int solutions = 0;
    QuasistaticRow row;  // of the last state of equilibrium
    run.label(step);
    for (;;) {
      if (!run.solve({driving}, u)) return run.finish(QuasistaticStatus::not_converged, {});
      if (run.broken() == 0 && run.spring_share() > separating_share) not_held();
      if (options.stop.separated && run.spring_share() > separating_share) {
        if (solutions > 0) {
          row.breaking_bonds = run.broken() - before;
          run.start_row(row);
          if (run.end_row(row)) return run.finish(QuasistaticStatus::interrupted, {});
        }
        return run.finish(
            QuasistaticStatus::separated,
            fmt::format("in step {}, at the time {:.6g}, a piece that carries load lost its support", step,
                        t));
      }
      ++solutions;
      const auto searching = Clock::now();
      const OverstretchedBonds over =
          overstretched(run.body(), problem.limits, u[0], options.break_at_once, tie);
      run.result().seconds_search += seconds_since(searching);
      run.reach(u[0], driving, over.energy, {1.0});
      row = row_of(run, driving, t, before, solutions);
      if (over.bonds.empty()) break;
      run.break_bonds(over.bonds);
    }
    run.start_row(row);
    if (run.end_row(row)) return run.finish(QuasistaticStatus::interrupted, {});
    run.sink().report(fmt::format("step {} of {}, {} bonds broken", step, options.steps, run.broken()),
                      static_cast<double>(step) / static_cast<double>(options.steps));
    // Energy per square of the motion: it vanishes where nothing is stretched, not where nothing moves.
    const double energy = row.stored_energy / std::max(row.load_factor * row.load_factor, at_rest);
    run.set_unit_energy(std::max(run.unit_energy(), energy));
    if (options.stop.separated && problem.motion_driven && run.broken() > 0 &&
        row.load_factor * row.load_factor > at_rest && energy <= unstretched * run.unit_energy())
      return run.finish(QuasistaticStatus::separated, "the given motion stretches no bond any more");
    if (options.stop.events > 0 && step >= options.stop.events)
      return run.finish(QuasistaticStatus::events, fmt::format("{} steps, as asked", step));
    if (options.stop.load_drop > 0.0 && row.force < (1.0 - options.stop.load_drop) * run.peak_force())
      return run.finish(QuasistaticStatus::load_drop, fmt::format("the load has fallen by {:.3g} of its peak",
                                                                  1.0 - row.force / run.peak_force()));
  }
  return run.finish(QuasistaticStatus::done, {});
}

#define PERIMODE_STEPS(D) template QuasistaticResult run_steps<D>(CrackRun<D>&)
PERIMODE_STEPS(1);
PERIMODE_STEPS(2);
PERIMODE_STEPS(3);
#undef PERIMODE_STEPS

}  // namespace perimode
