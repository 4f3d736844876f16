// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "commands.hpp"
#include "machine.hpp"
#include "perimode/assembly/critical_stretches.hpp"
#include "perimode/io/case.hpp"
#include "perimode/modal/plan.hpp"
#include "static_output.hpp"
#include "transient_output.hpp"

namespace perimode::cli {

namespace {

/// The body of a case, once it is clear that it can fit.
template <int Dim>
Body<Dim> checked_body(const Case& input, Console& console) {
  refuse_if_too_large(least_body_bytes(input.model), "the body");
  Body<Dim> body = build_body<Dim>(input.model, console.sink());
  console.stage("analysing", -1.0);
  return body;
}

/// What `plan` returns; its errors point at a section of the case.
template <class Plan>
auto planned(const Where& section, const Plan& plan) {
  try {
    return plan();
  } catch (const Error& error) {
    throw at(error, section);
  }
}

void show_plan(const std::string& text, double memory_bytes, const char* what, Console& console) {
  console.clear_progress();
  fmt::print("{}", text);
  std::fflush(stdout);
  refuse_if_too_large(memory_bytes, what);
}

template <int Dim>
void check_static(const Body<Dim>& body, const Case& input, Console& console) {
  const StaticPlan plan = planned(input.static_where, [&] { return plan_static(body, *input.statics); });
  show_plan(static_plan_text(plan), plan.memory_bytes, "this static analysis", console);
}

template <int Dim>
void check_transient(const Body<Dim>& body, const Case& input, Console& console) {
  const TransientPlan plan = planned(input.transient_where, [&] {
    (void)initial_state(input.initial, body.particles);
    TransientOptions options = *input.transient;
    options.critical_stretch = critical_stretches(input.model, body);
    return plan_transient(body, options);
  });
  show_plan(transient_plan_text(body, plan), plan.memory_bytes, "this transient analysis", console);
}

template <int Dim>
void check_modal(const Body<Dim>& body, const Case& input, Console& console) {
  const ModalPlan plan = planned(input.modal_where, [&] {
    ModalOptions options = input.modal.value_or(ModalOptions{});
    options.memory_limit = 0.9 * available_memory();
    return plan_modes(body, options);
  });
  console.clear_progress();
  fmt::print("particles        {}", plan.particles);
  if (plan.ghosts > 0) fmt::print("  (+ {} fictitious)", plan.ghosts);
  fmt::print("\nbonds            {}", plan.bonds);
  if (plan.cut > 0) fmt::print("  ({} cut by pre-cracks)", plan.cut);
  fmt::print("\ndofs             {}\n", plan.dofs);
  const std::string symmetry =
      plan.asymmetry <= 1e-12 ? "symmetric" : fmt::format("not symmetric, {:.1e}", plan.asymmetry);
  fmt::print("stiffness        {}\n", plan.nonzeros > 0
                                          ? fmt::format("{} nonzeros, {}", plan.nonzeros, symmetry)
                                          : symmetry + ", not assembled");
  if (plan.fill.nonzeros > 0) {
    fmt::print("factor           {} nonzeros, {:.3g} GFlop, {}\n", plan.fill.nonzeros, plan.fill.flops * 1e-9,
               bytes_text(plan.fill.factor_bytes));
  }
  fmt::print("rigid modes      {}\n", plan.rigid);
  fmt::print("pieces           {}\n", plan.pieces);
  fmt::print("solver           {}: {}\n", plan.solver, plan.reason);
  fmt::print("memory           about {} ({} available)\n", bytes_text(plan.memory_bytes),
             bytes_text(available_memory()));
  if (!input.modal) fmt::print("analysis         no modal section; predicted for 20 modes\n");
  std::fflush(stdout);
  for (const auto& warning : plan.warnings) console.warning(warning);
  refuse_if_too_large(plan.memory_bytes, "these modes");
}

/// Modes are predicted where they are asked for, or nothing else is.
template <int Dim>
int check(const Case& input, Console& console) {
  const Body<Dim> body = checked_body<Dim>(input, console);
  console.clear_progress();
  fmt::print("{}: reads well\n", input.title.empty() ? input.file.filename().string() : input.title);
  if (input.modal || !(input.statics || input.transient)) check_modal(body, input, console);
  if (input.statics) check_static(body, input, console);
  if (input.transient) check_transient(body, input, console);
  return 0;
}

}  // namespace

int run_check(const Arguments& arguments, Console& console) {
  const Case input = read_case(arguments.case_file, arguments.set);
  return with_dimension(input.model.dimension,
                        [&](auto dimension) { return check<dimension.value>(input, console); });
}

}  // namespace perimode::cli
