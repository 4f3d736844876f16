// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "commands.hpp"
#include "machine.hpp"
#include "perimode/assembly/critical_stretches.hpp"
#include "perimode/io/case.hpp"
#include "perimode/io/initial_state.hpp"
#include "resumable_run.hpp"
#include "transient_output.hpp"

namespace perimode::cli {

namespace {

/// What the run writes while it lasts.
template <int Dim>
TransientObserver<Dim> observer_of(const Case& input, const Body<Dim>& body, ResumableRun& run,
                                   Console& console) {
  struct History {
    OutputFile* file = nullptr;
    bool boundary_work = false;
  };
  const auto history = std::make_shared<History>();
  TransientObserver<Dim> observer;
  observer.begin = [&input, &body, &run, &console, history](const TransientPlan& plan) {
    history->boundary_work = !plan.symmetric;
    history->file = &run.text(
        "history.csv", history_header(probe_columns(input.transient->probes, Dim), history->boundary_work));
    console.clear_progress();
    fmt::print("{}", transient_start_text(body, plan));
    std::fflush(stdout);
  };
  observer.history = [&run, history](const HistoryRow& row) {
    run.timed([&] { add_history(*history->file, row, history->boundary_work); });
  };
  observer.fields = [&run](const TransientFrame<Dim>& frame) {
    run.timed([&] { run.fields().add(frame.time, {}, *frame.body, frame.displacement, &frame.velocity); });
  };
  observer.checkpoint = [&run](const IntegratorState& state) { run.timed([&] { run.save(state); }); };
  observer.stop = [&run] { return run.asked_to_stop(); };
  return observer;
}

nlohmann::ordered_json energies_json(const Energies& e) {
  return {{"initial", e.initial},  {"external_work", e.external_work},
          {"kinetic", e.kinetic},  {"strain", e.strain},
          {"damping", e.damping},  {"broken", e.broken},
          {"balance", e.balance()}};
}

template <int Dim>
nlohmann::ordered_json transient_summary(const Case& input, const Body<Dim>& body,
                                         const TransientResult& result) {
  nlohmann::ordered_json summary = begin_summary("transient", input.title, body);
  summary["bonds"] = count_bonds(body.bonds, body.count()) + result.broken_bonds;  // at the start
  const TransientPlan& plan = result.plan;
  summary["method"] = plan.method;
  summary["operator"] = plan.form;
  summary["solver"] = plan.solver.empty() ? "none" : plan.solver;
  summary["status"] = result.status == TransientStatus::done ? "done" : "unstable";
  summary["message"] = result.message;
  summary["dt"] = plan.dt;
  summary["steps"] = result.step;
  summary["time"] = result.time;
  summary["stable_step"] = {{"limit", plan.stable.limit},
                            {"omega_max", plan.stable.omega_max},
                            {"bound", plan.stable.bound},
                            {"growth", plan.stable.growth}};
  summary["symmetric"] = plan.symmetric;
  summary["energies"] = energies_json(result.energies);
  summary["balance"] = relative_balance(result.energies);
  if (!plan.symmetric) summary["boundary_work"] = result.boundary_work;
  summary["broken_bonds"] = result.broken_bonds;
  if (input.transient->method == TimeMethod::modal) {
    summary["truncation"] = {{"initial_energy", result.truncation.initial_energy},
                             {"load", result.truncation.load}};
  }
  summary["iterations"] = result.iterations;
  if (result.repeats.all > 0)
    summary["repeated_solutions"] = {{"all", result.repeats.all}, {"most", result.repeats.most}};
  return summary;
}

/// The run; errors of the case point at its section.
template <int Dim>
TransientResult run_steps(Body<Dim>& body, const Case& input, const TransientOptions& options,
                          const TransientObserver<Dim>& observer, const IntegratorState* from,
                          const Sink& sink) {
  try {
    return run_transient(body, options, initial_state(input.initial, body.particles), observer, from, sink);
  } catch (const Error& error) {
    throw error.kind() == ErrorKind::invalid_input ? at(error, input.transient_where) : error;
  }
}

/// Round-off for linear, symmetric bodies, of the order of the step squared where bonds turn, or break in
/// explicit steps.
void warn_of_imbalance(const TransientResult& result, Console& console) {
  const bool exact = result.plan.conserves;
  const double tolerated = exact ? 1e-6 : 0.1;
  const double share = relative_balance(result.energies);
  if (result.status != TransientStatus::done || !result.plan.symmetric || share <= tolerated) return;
  console.warning(fmt::format("the energies do not balance by {:.1e} of what went through: {}", share,
                              exact ? "rounding has outgrown the motion" : "take a smaller dt"));
}

template <int Dim>
int run_transient_in(const Case& input, const Arguments& arguments, Console& console) {
  const auto start = Clock::now();
  const double least_bytes = least_body_bytes(input.model);
  refuse_if_too_large(least_bytes, "the body");
  ResumableRun files(input, arguments, {"transient", "step"}, console);
  const Sink sink = console.sink();

  Body<Dim> body = build_body<Dim>(input.model, sink);
  const double seconds_body = seconds_since(start);
  TransientOptions options = *input.transient;
  options.critical_stretch = critical_stretches(input.model, body);
  // The exact prediction costs the stable step; it is made where memory could be short.
  if (25.0 * least_bytes > available_memory()) {
    sink.report("predicting memory");
    refuse_if_too_large(plan_transient(body, options).memory_bytes, "this transient analysis");
  }

  TransientResult result;
  try {
    result = run_steps(body, input, options, observer_of(input, body, files, console), files.resumed(), sink);
    if (result.status == TransientStatus::interrupted)
      return files.end_interrupted(fmt::format("at step {} of {}", result.step, result.plan.steps));
    files.close();

    nlohmann::ordered_json summary = transient_summary(input, body, result);
    const double stepping = result.seconds_steps - files.output_seconds();
    const auto steps = static_cast<double>(result.step - result.first_step);
    summary["resumed_from"] =
        result.first_step > 0 ? nlohmann::ordered_json(result.first_step) : nlohmann::ordered_json();
    summary["particle_steps_per_second"] = stepping > 0.0 ? body.count() * steps / stepping : 0.0;
    add_run(summary, {{"body", seconds_body},
                      {"setup", result.seconds_setup},
                      {"steps", stepping},
                      {"output", files.output_seconds()},
                      {"total", seconds_since(start)}});
    files.finish(summary);
  } catch (const Error& error) {
    files.fail(error);
  }
  console.clear_progress();

  fmt::print("{}results in {}\n", transient_text(result), files.target().string());
  std::fflush(stdout);
  warn_of_imbalance(result, console);
  if (result.status == TransientStatus::done) return 0;
  console.error(result.message);
  return 1;
}

}  // namespace

int run_transient(const Arguments& arguments, Console& console) {
  const Case input = read_case(arguments.case_file, arguments.set);
  if (!input.transient) {
    invalid_input({"a section analysis.transient",
                   "none",
                   "add `analysis: { transient: { end: 1.0e-3, loads: [ { body_force: [...] } ] } }`",
                   {arguments.case_file.string(), 0, 0}});
  }
  return with_dimension(input.model.dimension, [&](auto dimension) {
    return run_transient_in<dimension.value>(input, arguments, console);
  });
}

}  // namespace perimode::cli
