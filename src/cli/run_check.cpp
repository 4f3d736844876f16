// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cstdio>
#include <iterator>
#include <string>
#include <vector>

#include "cloud_dispersion.hpp"
#include "commands.hpp"
#include "dispersion_text.hpp"
#include "machine.hpp"
#include "perimode/assembly/critical_stretches.hpp"
#include "perimode/io/case.hpp"
#include "perimode/modal/plan.hpp"
#include "quasistatic_case.hpp"
#include "quasistatic_output.hpp"
#include "static_output.hpp"
#include "transient_output.hpp"

namespace perimode::cli {

namespace {

/// What `check` says of an analysis.
struct Prediction {
  std::string text;
  double memory_bytes = 0.0;
  const char* what = "";
  std::vector<std::string> warnings = {};
};

/// What `plan` returns; its errors point at a section of the case.
template <class Plan>
auto planned(const Where& section, const Plan& plan) {
  try {
    return plan();
  } catch (const Error& error) {
    throw at(error, section);
  }
}

std::string modal_plan_text(const ModalPlan& plan) {
  fmt::memory_buffer out;
  auto to = std::back_inserter(out);
  fmt::format_to(to, "particles        {}", plan.particles);
  if (plan.ghosts > 0) fmt::format_to(to, "  (+ {} fictitious)", plan.ghosts);
  fmt::format_to(to, "\nbonds            {}", plan.bonds);
  if (plan.cut > 0) fmt::format_to(to, "  ({} cut by pre-cracks)", plan.cut);
  fmt::format_to(to, "\ndofs             {}\n", plan.dofs);
  const std::string symmetry = plan.asymmetry <= symmetric_to_round_off
                                   ? "symmetric"
                                   : fmt::format("not symmetric, {:.1e}", plan.asymmetry);
  fmt::format_to(to, "stiffness        {}\n",
                 plan.nonzeros > 0 ? fmt::format("{} nonzeros, {}", plan.nonzeros, symmetry)
                                   : symmetry + ", not assembled");
  if (plan.fill.nonzeros > 0) {
    fmt::format_to(to, "factor           {} nonzeros, {:.3g} GFlop, {}\n", plan.fill.nonzeros,
                   plan.fill.flops * 1e-9, bytes_text(plan.fill.factor_bytes));
  }
  fmt::format_to(to, "rigid modes      {}\n", plan.rigid);
  fmt::format_to(to, "pieces           {}\n", plan.pieces);
  fmt::format_to(to, "solver           {}: {}\n", plan.solver, plan.reason);
  fmt::format_to(to, "memory           about {} ({} available)\n", bytes_text(plan.memory_bytes),
                 bytes_text(available_memory()));
  return fmt::to_string(out);
}

template <int Dim>
Prediction check_modal(const Body<Dim>& body, const Case& input) {
  const ModalPlan plan = planned(input.modal_where, [&] {
    ModalOptions options = input.modal.value_or(ModalOptions{});
    options.memory_limit = 0.9 * available_memory();
    return plan_modes(body, options);
  });
  const char* note = input.modal ? "" : "analysis         no modal section; predicted for 20 modes\n";
  return {modal_plan_text(plan) + note, plan.memory_bytes, "these modes", plan.warnings};
}

template <int Dim>
Prediction check_static(const Body<Dim>& body, const Case& input) {
  const StaticPlan plan = planned(input.static_where, [&] { return plan_static(body, *input.statics); });
  return {static_plan_text(plan), plan.memory_bytes, "this static analysis"};
}

template <int Dim>
Prediction check_transient(const Body<Dim>& body, const Case& input) {
  const TransientPlan plan = planned(input.transient_where, [&] {
    (void)initial_state(input.initial, body.particles);
    TransientOptions options = *input.transient;
    options.critical_stretch = critical_stretches(input.model, body);
    return plan_transient(body, options);
  });
  return {transient_plan_text(body, plan), plan.memory_bytes, "this transient analysis", plan.warnings};
}

template <int Dim>
Prediction check_quasistatic(const Body<Dim>& body, const Case& input) {
  const QuasistaticPlan plan = planned(
      input.quasistatic_where, [&] { return plan_quasistatic(body, quasistatic_options(input, body)); });
  return {quasistatic_plan_text(plan), plan.memory_bytes, "this quasi-static analysis", plan.warnings};
}

template <int Dim>
Prediction check_dispersion(const Body<Dim>& body, const Case& input) {
  if (!std::holds_alternative<GridSpec>(input.model.particles))
    return {cloud_dispersion_plan_text(body, input), 0.0, ""};
  return {dispersion_plan_text(make_lattice<Dim>(input.model), *input.dispersion), 0.0, ""};
}

/// All analyses of a case; modes where they are asked for, or nothing else is.
template <int Dim>
int check(const Case& input, Console& console) {
  refuse_if_too_large(least_body_bytes(input.model), "the body");
  const Body<Dim> body = build_body<Dim>(input.model, console.sink());
  console.stage("analysing", -1.0);
  std::vector<Prediction> predictions;
  if (input.modal || !(input.statics || input.transient || input.quasistatic || input.dispersion))
    predictions.push_back(check_modal(body, input));
  if (input.statics) predictions.push_back(check_static(body, input));
  if (input.transient) predictions.push_back(check_transient(body, input));
  if (input.quasistatic) predictions.push_back(check_quasistatic(body, input));
  if (input.dispersion) predictions.push_back(check_dispersion(body, input));
  console.clear_progress();
  fmt::print("{}: reads well\n", input.title.empty() ? input.file.filename().string() : input.title);
  for (const Prediction& prediction : predictions) fmt::print("{}", prediction.text);
  std::fflush(stdout);
  for (const Prediction& prediction : predictions) {
    for (const std::string& warning : prediction.warnings) console.warning(warning);
    refuse_if_too_large(prediction.memory_bytes, prediction.what);
  }
  return 0;
}

}  // namespace

int run_check(const Arguments& arguments, Console& console) {
  const Case input = read_case(arguments.case_file, arguments.set);
  return with_dimension(input.model.dimension,
                        [&](auto dimension) { return check<dimension.value>(input, console); });
}

}  // namespace perimode::cli
