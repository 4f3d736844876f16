// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <limits>

#include "commands.hpp"
#include "interrupt.hpp"
#include "machine.hpp"
#include "perimode/fracture/crack_growth.hpp"
#include "perimode/io/case.hpp"
#include "perimode/io/result_directory.hpp"
#include "perimode/modal/plan.hpp"
#include "summary.hpp"

namespace perimode::cli {

namespace {

const char* name(GrowthFactor factor) { return factor == GrowthFactor::updated ? "updated" : "fresh"; }

/// f / f_intact - 1; unknown for a mode that is rigid in the intact body.
double relative_change(const CrackGrowthResult& result, const CrackGrowthStep& step, std::size_t mode) {
  const double intact = result.steps.front().frequency[mode];
  return intact > 0.0 ? step.frequency[mode] / intact - 1.0 : std::numeric_limits<double>::quiet_NaN();
}

/// crack_growth.csv, one row per step and mode.
Table growth_table(const CrackGrowthResult& result) {
  Table table;
  table.columns = {"step", "fraction",     "crack_length",    "cut_bonds", "factor",
                   "mode", "frequency_hz", "relative_change", "residual"};
  for (std::size_t k = 0; k < result.steps.size(); ++k) {
    const CrackGrowthStep& step = result.steps[k];
    for (std::size_t m = 0; m < step.frequency.size(); ++m) {
      table.rows.push_back({static_cast<Offset>(k), step.fraction, step.crack_length, step.cut,
                            std::string(name(step.factor)), static_cast<Offset>(m) + 1, step.frequency[m],
                            relative_change(result, step, m), step.residual});
    }
  }
  return table;
}

nlohmann::ordered_json growth_json(const CrackGrowthResult& result) {
  auto steps = nlohmann::ordered_json::array();
  for (const CrackGrowthStep& step : result.steps) {
    steps.push_back({{"fraction", step.fraction},
                     {"crack_length", step.crack_length},
                     {"cut_bonds", step.cut},
                     {"factor", name(step.factor)},
                     {"residual", step.residual},
                     {"factor_s", step.seconds_factor},
                     {"modes_s", step.seconds_modes},
                     {"frequency_hz", step.frequency}});
  }
  return steps;
}

/// One line per step: the first five frequencies that are not rigid in the intact body, and how far they
/// fell.
std::string growth_text(const CrackGrowthResult& result) {
  const auto& intact = result.steps.front().frequency;
  std::size_t rigid = 0;
  while (rigid < intact.size() && intact[rigid] == 0.0) ++rigid;
  const std::size_t last = std::min(intact.size(), rigid + 5);
  std::string text = fmt::format("{:>8} {:>12} {:>10} {:>8}", "fraction", "crack", "cut bonds", "factor");
  for (std::size_t m = rigid; m < last; ++m)
    text += fmt::format(" {:>12} {:>8}", fmt::format("Hz, mode {}", m + 1), "change");
  text += '\n';
  for (const CrackGrowthStep& step : result.steps) {
    text += fmt::format("{:8.4f} {:12.5g} {:10} {:>8}", step.fraction, step.crack_length, step.cut,
                        name(step.factor));
    for (std::size_t m = rigid; m < last; ++m)
      text += fmt::format(" {:12.6g} {:7.2f}%", step.frequency[m], 100.0 * relative_change(result, step, m));
    text += '\n';
  }
  return text;
}

template <int Dim>
int run_crack_growth_in(const Case& input, const Arguments& arguments, Console& console) {
  const auto start = Clock::now();
  refuse_if_too_large(least_body_bytes(input.model), "the body");
  ResultDirectory folder(arguments.output.value_or(input.output.directory), arguments.force);
  set_unfinished_result(folder.unfinished());
  const Sink sink = console.sink();
  const Body<Dim> body = build_body<Dim>(input.model, sink);
  const double seconds_body = seconds_since(start);
  ModalOptions factored = *input.modal;
  factored.solver = ModalSolver::lanczos;
  if (3.0 * rough_memory(body, factored) > available_memory())
    refuse_if_too_large(plan_modes(body, factored).memory_bytes, "these modes");
  const CrackGrowthResult result = [&] {
    try {
      return crack_growth_modes<Dim>(input.model, *input.modal, *arguments.crack_growth,
                                     GrowthFactor::automatic, sink);
    } catch (const Error& error) {
      throw error.kind() == ErrorKind::invalid_input ? at(error, input.modal_where) : error;
    }
  }();

  console.stage("writing", -1.0);
  write_csv(folder.temporary() / "crack_growth.csv", growth_table(result));
  nlohmann::ordered_json summary = begin_summary("modal", input.title, body);
  summary["factor_nonzeros"] = result.factor_nonzeros;
  summary["solver"] = "lanczos";
  summary["status"] = result.converged ? "done" : "not_converged";
  summary["message"] = result.message;
  double factor = 0.0;
  double modes = 0.0;
  for (const CrackGrowthStep& step : result.steps) {
    factor += step.seconds_factor;
    modes += step.seconds_modes;
  }
  add_run(summary,
          {{"body", seconds_body}, {"factor", factor}, {"modes", modes}, {"total", seconds_since(start)}});
  summary["crack_growth"] = growth_json(result);
  commit_summary(folder, summary);
  console.clear_progress();

  fmt::print("{}", growth_text(result));
  fmt::print("{} particles, {} bonds, {} dofs; lanczos; results in {}\n", body.count(),
             count_bonds(body.bonds, body.count()), body.boundary.free, folder.target().string());
  std::fflush(stdout);
  if (result.converged) return 0;
  console.error(result.message);
  return 1;
}

}  // namespace

int run_crack_growth(const Case& input, const Arguments& arguments, Console& console) {
  return with_dimension(input.model.dimension, [&](auto dimension) {
    return run_crack_growth_in<dimension.value>(input, arguments, console);
  });
}

}  // namespace perimode::cli
