// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "core/stopwatch.hpp"
#include "fracture/crack_run.hpp"

namespace perimode {

namespace {

constexpr double tie = 1e-6;  ///< of the critical stretch: bonds that break together
/// Strain energy, of the largest one so far: below it no bond is stretched any more.
constexpr double unstretched = 1e-14;

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
    run.label(step);
    for (;;) {
      if (!run.solve({driving}, u)) return run.finish(QuasistaticStatus::not_converged, {});
      ++solutions;
      if (options.stop.separated && run.spring_share() > separating_share)
        return run.finish(QuasistaticStatus::separated, "a piece that carries load has lost its support");
      const auto searching = Clock::now();
      const OverstretchedBonds over =
          overstretched(run.body(), problem.limits, u[0], options.break_at_once, tie);
      run.result().seconds_search += seconds_since(searching);
      run.reach(u[0], driving, over.energy);
      run.set_unit_energy(std::max(run.unit_energy(), over.energy));
      if (over.bonds.empty()) break;
      run.break_bonds(over.bonds);
    }
    QuasistaticRow row = run.row(0.0);
    row.time = t;
    const Eigen::VectorXd& in_full = problem.motion_driven ? driving.given : driving.load;
    row.load_factor = problem.size > 0.0 ? problem.direction.dot(in_full) / problem.size : 0.0;
    row.broken_bonds = before;
    row.breaking_bonds = run.broken() - before;
    row.iterations = solutions;
    run.start_row(row);
    if (run.end_row(row)) return run.finish(QuasistaticStatus::interrupted, {});
    run.sink().report(fmt::format("step {} of {}, {} bonds broken", step, options.steps, run.broken()),
                      static_cast<double>(step) / static_cast<double>(options.steps));
    if (options.stop.separated && problem.motion_driven && run.broken() > 0 &&
        row.stored_energy <= unstretched * run.unit_energy())
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
