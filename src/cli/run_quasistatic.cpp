// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "commands.hpp"
#include "machine.hpp"
#include "perimode/fracture/griffith.hpp"
#include "perimode/io/case.hpp"
#include "quasistatic_case.hpp"
#include "quasistatic_output.hpp"
#include "resumable_run.hpp"
#include "summary.hpp"

namespace perimode::cli {

namespace {

/// Loose pieces told of one by one; all of them are in summary.json.
constexpr int most_pieces_told = 5;

/// What the run writes while it lasts. The Griffith load goes into `facts`.
template <int Dim>
QuasistaticObserver<Dim> observer_of(const Case& input, const Body<Dim>& body,
                                     const QuasistaticOptions& options, ResumableRun& files, Console& console,
                                     QuasistaticFacts& facts) {
  OutputFile& curve = files.text("load_curve.csv", load_curve_header(options.control));
  OutputFile& path = files.text("crack_path.csv", crack_path_header(Dim));
  QuasistaticObserver<Dim> observer;
  observer.begin = [&](const QuasistaticPlan& plan) {
    console.clear_progress();
    fmt::print("{}", quasistatic_start_text(body, plan));
    std::fflush(stdout);
    if (!options.griffith) return;
    console.stage("Griffith load", -1.0);
    facts.griffith =
        griffith_load(body, options.loads, crack_increment(input.model, body), facts.fracture_energy);
  };
  observer.row = [&files, &curve, &options](const QuasistaticRow& row) {
    files.timed([&] { add_load_curve(curve, row, options.control); });
  };
  observer.broken = [&files, &path](const std::vector<BrokenBond<Dim>>& bonds) {
    files.timed([&] { add_crack_path(path, bonds); });
  };
  observer.fields = [&files](const QuasistaticFrame<Dim>& frame) {
    files.timed([&] {
      files.fields().add(static_cast<double>(frame.event), {frame.load_factor}, *frame.body,
                         frame.displacement, nullptr);
    });
  };
  observer.loose = [&console, &options, told = 0](const LoosePiece& piece) mutable {
    if (told < most_pieces_told) console.info(loose_text(piece, options));
    if (told == most_pieces_told) console.info("more loose pieces: see summary.json");
    ++told;
  };
  observer.checkpoint = [&files](const IntegratorState& state) { files.timed([&] { files.save(state); }); };
  observer.stop = [&files] { return files.asked_to_stop(); };
  return observer;
}

/// Whether the run reached what the case asks of it.
bool reached(QuasistaticStatus status) {
  return status != QuasistaticStatus::not_converged && status != QuasistaticStatus::dead_loads;
}

template <int Dim>
nlohmann::ordered_json summary_of(const Case& input, const Body<Dim>& body, const QuasistaticResult& result,
                                  const QuasistaticFacts& facts) {
  nlohmann::ordered_json summary = begin_summary("quasistatic", input.title, body);
  summary["bonds"] = result.plan.bonds;  // at the start
  add_quasistatic(summary, result, facts);
  summary["resumed_from"] =
      facts.resumed_from > 0 ? nlohmann::ordered_json(facts.resumed_from) : nlohmann::ordered_json();
  return summary;
}

/// The balance is round-off.
void warn_of_imbalance(const QuasistaticResult& result, Console& console) {
  constexpr double tolerated = 1e-6;
  if (result.worst_balance <= tolerated) return;
  console.warning(
      fmt::format("the energies do not balance by {:.1e} of the external work at worst, with residuals of "
                  "{:.1e}: take a smaller analysis.quasistatic.tolerance, or solver: refactor",
                  result.worst_balance, result.worst_residual));
}

template <int Dim>
int run_quasistatic_in(const Case& input, const Arguments& arguments, Console& console) {
  const auto start = Clock::now();
  const double least_bytes = least_body_bytes(input.model);
  refuse_if_too_large(least_bytes, "the body");
  const char* counted = input.quasistatic->control == QuasistaticControl::event ? "event" : "step";
  const char* global = input.quasistatic->control == QuasistaticControl::event ? "load_factor" : "time";
  ResumableRun files(input, arguments, {"quasistatic", counted, {global}}, console);
  const Sink sink = console.sink();
  const std::vector<std::string>& fields = input.output.fields;
  if (std::find(fields.begin(), fields.end(), "velocity") != fields.end())
    console.warning("output.fields: a quasi-static analysis has no velocity; it is left out");

  Body<Dim> body = build_body<Dim>(input.model, sink);
  const double seconds_body = seconds_since(start);
  QuasistaticResult result;
  QuasistaticFacts facts;
  try {
    const QuasistaticOptions options = quasistatic_options(input, body);
    // The exact prediction costs an ordering; it is made where memory could be short.
    if (40.0 * least_bytes > available_memory()) {
      sink.report("predicting memory");
      refuse_if_too_large(plan_quasistatic(body, options).memory_bytes, "this quasi-static analysis");
    }
    facts.dimension = Dim;
    facts.control = options.control;
    facts.section = body.section;
    facts.area = options.area;
    facts.fracture_energy = fracture_energy_of(input.model, body);
    if (files.resumed() != nullptr) facts.resumed_from = files.resumed()->step;
    result = run_quasistatic(body, options, observer_of(input, body, options, files, console, facts),
                             files.resumed(), sink);
    if (result.status == QuasistaticStatus::interrupted)
      return files.end_interrupted(fmt::format("after {} {}", counted, result.events));
    files.close();
    nlohmann::ordered_json summary = summary_of(input, body, result, facts);
    add_run(summary, {{"body", seconds_body},
                      {"setup", result.seconds_setup},
                      {"search", result.seconds_search},
                      {"output", files.output_seconds()},
                      {"run", result.seconds_total},
                      {"total", seconds_since(start)}});
    files.finish(summary);
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::invalid_input) throw at(error, input.quasistatic_where);
    files.fail(error);
  }
  console.clear_progress();

  fmt::print("{}results in {}\n", quasistatic_text(result, facts), files.target().string());
  std::fflush(stdout);
  warn_of_imbalance(result, console);
  if (reached(result.status)) return 0;
  console.error(result.message);
  return 1;
}

}  // namespace

int run_quasistatic(const Arguments& arguments, Console& console) {
  const Case input = read_case(arguments.case_file, arguments.set);
  if (!input.quasistatic) {
    invalid_input(
        {"a section analysis.quasistatic",
         "none",
         "add `analysis: { quasistatic: { loads: [ { traction: [...], at: { face: y+, layers: 1 } } ] } }`",
         {arguments.case_file.string(), 0, 0}});
  }
  return with_dimension(input.model.dimension, [&](auto dimension) {
    return run_quasistatic_in<dimension.value>(input, arguments, console);
  });
}

}  // namespace perimode::cli
