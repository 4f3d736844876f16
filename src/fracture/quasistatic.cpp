// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/fracture/quasistatic.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/stopwatch.hpp"
#include "fracture/crack_run.hpp"
#include "perimode/assembly/critical_stretches.hpp"

namespace perimode {

namespace {

template <int Dim>
QuasistaticPlan plan_of(const Body<Dim>& body, const QuasistaticProblem& problem,
                        const QuasistaticOptions& options, const EquilibriumChoice& choice) {
  QuasistaticPlan plan;
  plan.dofs = body.boundary.free;
  plan.bonds = count_bonds(body.bonds, body.count());
  plan.rigid_modes = static_cast<int>(problem.rigid.cols());
  plan.solver =
      fmt::format("{}: {}", choice.matrix_free ? "conjugate gradients" : "cholesky, updated", choice.reason);
  if (negative_bonds_may_break(body, options.critical_stretch))
    plan.warnings.push_back(warning_of_negative_breaks());
  return plan;
}

}  // namespace

template <int Dim>
QuasistaticResult run_quasistatic(Body<Dim>& body, const QuasistaticOptions& options,
                                  const QuasistaticObserver<Dim>& observer, const IntegratorState* resume,
                                  const Sink& sink) {
  const auto start = Clock::now();
  sink.report("loads and rigid motions");
  QuasistaticProblem problem = pose_quasistatic(body, options);
  sink.report("ordering");
  const EquilibriumChoice choice = choose_equilibrium(body, options.solver, options.matrix_free);
  QuasistaticPlan plan = plan_of(body, problem, options, choice);
  for (const std::string& warning : plan.warnings) sink.warn(warning);
  if (observer.begin) observer.begin(plan);
  if (plan.rigid_modes > 0) {
    sink.inform(fmt::format(
        "{} rigid motion{} of the body left free; the loads are in equilibrium, so "
        "displacements are given without {}",
        plan.rigid_modes, plan.rigid_modes == 1 ? " is" : "s are", plan.rigid_modes == 1 ? "it" : "them"));
  }
  sink.report("factoring");
  CrackRun<Dim> run(body, options, observer, sink, std::move(problem), choice.matrix_free, resume);
  run.result().plan = std::move(plan);
  run.result().seconds_setup = seconds_since(start);
  QuasistaticResult result = options.control == QuasistaticControl::event ? run_events(run) : run_steps(run);
  result.seconds_total = seconds_since(start);
  return result;
}

template <int Dim>
QuasistaticPlan plan_quasistatic(const Body<Dim>& body, const QuasistaticOptions& options) {
  const QuasistaticProblem problem = pose_quasistatic(body, options);
  const EquilibriumChoice choice = choose_equilibrium(body, options.solver, options.matrix_free);
  QuasistaticPlan plan = plan_of(body, problem, options, choice);
  const double vector = 8.0 * Dim * body.count();
  // Rigid motions and loads; drivings, solutions, states of the ledger and what the solver works in.
  double vectors = 10.0 + 4.0 * static_cast<double>(problem.parts.size()) + plan.rigid_modes;
  if (choice.matrix_free) vectors += 8.0;
  plan.memory_bytes = body_bytes(body) + operator_bytes(body) + vectors * vector + choice.fill.peak_bytes +
                      choice.matrix_bytes;
  return plan;
}

#define PERIMODE_QUASISTATIC(D)                                                                        \
  template QuasistaticResult run_quasistatic<D>(Body<D>&, const QuasistaticOptions&,                   \
                                                const QuasistaticObserver<D>&, const IntegratorState*, \
                                                const Sink&);                                          \
  template QuasistaticPlan plan_quasistatic<D>(const Body<D>&, const QuasistaticOptions&)
PERIMODE_QUASISTATIC(1);
PERIMODE_QUASISTATIC(2);
PERIMODE_QUASISTATIC(3);
#undef PERIMODE_QUASISTATIC

}  // namespace perimode
