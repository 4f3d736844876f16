// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cstdio>

#include "commands.hpp"
#include "interrupt.hpp"
#include "machine.hpp"
#include "perimode/assembly/critical_stretches.hpp"
#include "perimode/io/case.hpp"
#include "perimode/io/checkpoint.hpp"
#include "perimode/io/initial_state.hpp"
#include "perimode/io/result_directory.hpp"
#include "summary.hpp"
#include "transient_output.hpp"

namespace perimode::cli {

namespace {

std::string resume_command(const Arguments& arguments) {
  return arguments.command_line + (arguments.resume ? "" : " --resume");
}

/// The files of a run while it lasts, and what its checkpoints need to know of them.
template <int Dim>
class Recorder {
 public:
  Recorder(const Case& input, const Body<Dim>& body, ResultDirectory& folder, std::string digest,
           const std::optional<Checkpoint>& from)
      : input_(&input),
        body_(&body),
        folder_(&folder),
        history_bytes_(from ? from->history_bytes : 0),
        frames_(folder.temporary() / "fields.exo", input.title, input.output.fields, from ? from->frames : 0),
        digest_(std::move(digest)) {
    if (from) {
      last_energies_ = from->last_energies;
      last_checkpoint_ = from->state.step;
    }
  }

  [[nodiscard]] TransientObserver<Dim> observer(const std::string& interrupted_twice, Console& console) {
    TransientObserver<Dim> observer;
    observer.begin = [this, &console](const TransientPlan& plan) {
      history_.emplace(folder_->temporary() / "history.csv", history_bytes_,
                       probe_columns(input_->transient->probes, Dim), !plan.symmetric);
      console.clear_progress();
      fmt::print("{}", transient_start_text(*body_, plan));
      std::fflush(stdout);
    };
    observer.history = [this](const HistoryRow& row) {
      const auto start = Clock::now();
      history_->add(row);
      last_energies_ = row.energies;
      seconds_ += seconds_since(start);
    };
    observer.fields = [this](const TransientFrame<Dim>& frame) {
      const auto start = Clock::now();
      frames_.add(frame);
      seconds_ += seconds_since(start);
    };
    observer.checkpoint = [this](const IntegratorState& state) {
      const auto start = Clock::now();
      save(state);
      seconds_ += seconds_since(start);
    };
    observer.stop = [this, interrupted_twice, first = true]() mutable {
      if (first) interrupts_only_ask(interrupted_twice);
      first = false;
      history_->show_now_and_then();
      return interrupt_requested();
    };
    return observer;
  }

  void close() {
    history_->close();
    frames_.close();
  }

  /// The step of the last checkpoint; -1: none.
  [[nodiscard]] std::int64_t last_checkpoint() const { return last_checkpoint_; }
  [[nodiscard]] const Energies& last_energies() const { return last_energies_; }
  [[nodiscard]] double seconds() const { return seconds_; }

 private:
  /// A checkpoint counts on what it says of the other files, so they reach the disk before it does.
  void save(const IntegratorState& state) {
    history_->sync();
    frames_.sync();
    write_checkpoint(folder_->temporary(),
                     {digest_, state, history_->bytes(), frames_.frames(), last_energies_});
    folder_->keep();
    last_checkpoint_ = state.step;
  }

  const Case* input_;
  const Body<Dim>* body_;
  ResultDirectory* folder_;
  std::int64_t history_bytes_;          ///< of the part of the run before a resumption
  std::optional<HistoryFile> history_;  ///< from the beginning of the run on
  FramesFile<Dim> frames_;
  std::string digest_;
  Energies last_energies_;
  std::int64_t last_checkpoint_ = -1;
  double seconds_ = 0.0;
};

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
  return summary;
}

/// The run; errors of the case point at its section.
template <int Dim>
TransientResult run_steps(Body<Dim>& body, const Case& input, const TransientOptions& options,
                          const TransientObserver<Dim>& observer, const std::optional<Checkpoint>& from,
                          const Sink& sink) {
  try {
    return run_transient(body, options, initial_state(input.initial, body.particles), observer,
                         from ? &from->state : nullptr, sink);
  } catch (const Error& error) {
    throw error.kind() == ErrorKind::invalid_input ? at(error, input.transient_where) : error;
  }
}

/// What a person can do about a run that failed for want of disk or memory.
[[noreturn]] void fail_with_advice(const Error& error, std::int64_t checkpoint, const Arguments& arguments) {
  if (error.kind() != ErrorKind::environment || checkpoint < 0) throw error;
  throw Error(ErrorKind::environment, fmt::format("{}; the checkpoint of step {} is whole: go on with: {}",
                                                  error.what(), checkpoint, resume_command(arguments)));
}

/// Round-off for linear, symmetric bodies, of the order of the step squared where bonds turn or break.
void warn_of_imbalance(const TransientResult& result, Console& console) {
  const bool exact = result.plan.conserves;
  const double tolerated = exact ? 1e-6 : 0.1;
  const double share = relative_balance(result.energies);
  if (result.status != TransientStatus::done || !result.plan.symmetric || share <= tolerated) return;
  console.warning(fmt::format("the energies do not balance by {:.1e} of what went through: {}", share,
                              exact ? "rounding has outgrown the motion" : "take a smaller dt"));
}

/// Files the run reads are there, and not in the result that --force would replace.
void check_input(const std::filesystem::path& target, const std::filesystem::path& file) {
  if (std::error_code code; !std::filesystem::exists(file, code)) {
    invalid_input({fmt::format("the file {}", file.string()),
                   "none",
                   "a mode comes from `perimode modal`: run that first; paths are relative to the case file",
                   {}});
  }
  const auto inside =
      std::filesystem::weakly_canonical(file).lexically_relative(std::filesystem::weakly_canonical(target));
  if (inside.empty() || *inside.begin() == "..") return;
  invalid_input({"a result folder that holds no input of the case",
                 fmt::format("{} with {}", target.string(), inside.string()),
                 "choose another --output, or move the file",
                 {}});
}

template <int Dim>
int run(const Case& input, const Arguments& arguments, Console& console) {
  const auto start = Clock::now();
  const double least_bytes = least_body_bytes(input.model);
  refuse_if_too_large(least_bytes, "the body");
  ResultDirectory folder(arguments.output.value_or(input.output.directory), arguments.force,
                         arguments.resume ? Beginning::resumed : Beginning::new_run);
  set_unfinished_result(folder.unfinished(), arguments.resume ? "interrupted; the checkpoint is as it was"
                                                              : "interrupted; nothing was written");
  const Sink sink = console.sink();
  for (const std::filesystem::path& file : input.files) check_input(folder.target(), file);
  const std::string digest = case_digest(input.canonical, input.files);
  std::optional<Checkpoint> from;
  if (arguments.resume) from = read_checkpoint(folder.temporary(), digest, sink);

  Body<Dim> body = build_body<Dim>(input.model, sink);
  const double seconds_body = seconds_since(start);
  TransientOptions options = *input.transient;
  options.critical_stretch = critical_stretches(input.model, body);
  // The exact prediction costs the stable step; it is made where memory could be short.
  if (25.0 * least_bytes > available_memory()) {
    sink.report("predicting memory");
    refuse_if_too_large(plan_transient(body, options).memory_bytes, "this transient analysis");
  }

  Recorder<Dim> recorder(input, body, folder, digest, from);
  TransientResult result;
  try {
    result = run_steps(
        body, input, options,
        recorder.observer(fmt::format("interrupted at once; if there is a checkpoint, go on with: {}",
                                      resume_command(arguments)),
                          console),
        from, sink);
    if (result.status == TransientStatus::interrupted) {
      console.clear_progress();
      console.say(fmt::format("interrupted at step {} of {}; go on with: {}", result.step, result.plan.steps,
                              resume_command(arguments)));
      return 130;
    }
    recorder.close();

    nlohmann::ordered_json summary = transient_summary(input, body, result);
    const double stepping = result.seconds_steps - recorder.seconds();
    const auto steps = static_cast<double>(result.step - result.first_step);
    summary["resumed_from"] =
        result.first_step > 0 ? nlohmann::ordered_json(result.first_step) : nlohmann::ordered_json();
    summary["particle_steps_per_second"] = stepping > 0.0 ? body.count() * steps / stepping : 0.0;
    add_run(summary, {{"body", seconds_body},
                      {"setup", result.seconds_setup},
                      {"steps", stepping},
                      {"output", recorder.seconds()},
                      {"total", seconds_since(start)}});
    commit_summary(folder, summary);
  } catch (const Error& error) {
    fail_with_advice(error, recorder.last_checkpoint(), arguments);
  }
  remove_checkpoints(folder.target());
  console.clear_progress();

  fmt::print("{}results in {}\n", transient_text(result), folder.target().string());
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
  return with_dimension(input.model.dimension,
                        [&](auto dimension) { return run<dimension.value>(input, arguments, console); });
}

}  // namespace perimode::cli
