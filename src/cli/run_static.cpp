// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cstdio>

#include "commands.hpp"
#include "interrupt.hpp"
#include "machine.hpp"
#include "perimode/io/case.hpp"
#include "perimode/io/result_directory.hpp"
#include "static_output.hpp"
#include "summary.hpp"

namespace perimode::cli {

namespace {

/// The solution, unless it would not fit in memory; errors point at the section that asks for it.
template <int Dim>
StaticResult solve_checked(const Body<Dim>& body, const Case& input, double least_bytes, const Sink& sink) {
  try {
    // The exact prediction may cost an ordering; it is made where memory could be short.
    if (25.0 * least_bytes > available_memory()) {
      sink.report("predicting memory");
      refuse_if_too_large(plan_static(body, *input.statics).memory_bytes, "this static analysis");
    }
    return solve_static(body, input.model.boundary, *input.statics, sink);
  } catch (const Error& error) {
    throw error.kind() == ErrorKind::invalid_input ? at(error, input.static_where) : error;
  }
}

template <int Dim>
int run_static_in(const Case& input, const Arguments& arguments, Console& console) {
  const auto start = Clock::now();
  const double least_bytes = least_body_bytes(input.model);
  refuse_if_too_large(least_bytes, "the body");
  ResultDirectory folder(arguments.output.value_or(input.output.directory), arguments.force);
  set_unfinished_result(folder.unfinished());

  const Sink sink = console.sink();
  const Body<Dim> body = build_body<Dim>(input.model, sink);
  const double seconds_body = seconds_since(start);
  const StaticResult result = solve_checked(body, input, least_bytes, sink);

  console.stage("writing", -1.0);
  const auto writing = Clock::now();
  const Table reactions = reactions_table(result, Dim);
  write_csv(folder.temporary() / "reactions.csv", reactions);
  write_fields_exodus(folder.temporary() / "fields.exo", input.title, body, result, input.output.fields);

  nlohmann::ordered_json summary = begin_summary("static", input.title, body);
  summary["solver"] = result.solver;
  summary["reason"] = result.reason;
  summary["status"] = result.status == StaticStatus::converged ? "done" : "not_converged";
  summary["message"] = result.message;
  summary["asymmetry"] = result.asymmetry;
  summary["rigid_modes"] = result.rigid_modes;
  summary["factor_nonzeros"] = result.factor_nonzeros;
  summary["iterations"] = result.iterations;
  summary["residual"] = result.residual;
  summary["strain_energy"] = result.strain_energy;
  summary["external_work"] = result.external_work;
  summary["balance"] = result.balance;
  add_run(summary, {{"body", seconds_body},
                    {"setup", result.seconds_setup},
                    {"solve", result.seconds_solve},
                    {"reactions", result.seconds_reactions},
                    {"write", seconds_since(writing)},
                    {"total", seconds_since(start)}});
  summary["reactions"] = table_json(reactions);
  commit_summary(folder, summary);
  console.clear_progress();

  fmt::print("{}results in {}\n", static_text(body, result), folder.target().string());
  std::fflush(stdout);
  if (result.status == StaticStatus::converged) return 0;
  console.error(result.message);
  return 1;
}

}  // namespace

int run_static(const Arguments& arguments, Console& console) {
  const Case input = read_case(arguments.case_file, arguments.set);
  if (!input.statics) {
    invalid_input({"a section analysis.static",
                   "none",
                   "add `analysis: { static: { loads: [ { body_force: [...] } ] } }`",
                   {arguments.case_file.string(), 0, 0}});
  }
  return with_dimension(input.model.dimension, [&](auto dimension) {
    return run_static_in<dimension.value>(input, arguments, console);
  });
}

}  // namespace perimode::cli
