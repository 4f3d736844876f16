// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "commands.hpp"
#include "machine.hpp"
#include "perimode/io/case.hpp"
#include "perimode/modal/plan.hpp"
#include "static_output.hpp"

namespace perimode::cli {

namespace {

/// A static analysis alone: no modes are predicted where none are asked for.
template <int Dim>
int check_static(const Case& input, Console& console) {
  refuse_if_too_large(least_body_bytes(input.model), "the body");
  const Body<Dim> body = build_body<Dim>(input.model, console.sink());
  console.stage("analysing", -1.0);
  const StaticPlan plan = [&] {
    try {
      return plan_static(body, *input.statics);
    } catch (const Error& error) {
      throw at(error, input.static_where);
    }
  }();
  console.clear_progress();
  if (!input.modal)
    fmt::print("{}: reads well\n", input.title.empty() ? input.file.filename().string() : input.title);
  fmt::print("{}", static_plan_text(plan));
  std::fflush(stdout);
  refuse_if_too_large(plan.memory_bytes, "this static analysis");
  return 0;
}

template <int Dim>
int check(const Case& input, Console& console) {
  if (input.statics && !input.modal) return check_static<Dim>(input, console);
  refuse_if_too_large(least_body_bytes(input.model), "the body");
  const Body<Dim> body = build_body<Dim>(input.model, console.sink());
  console.stage("analysing", -1.0);
  const ModalPlan plan = [&] {
    try {
      ModalOptions options = input.modal.value_or(ModalOptions{});
      options.memory_limit = 0.9 * available_memory();
      return plan_modes(body, options);
    } catch (const Error& error) {
      throw at(error, input.modal_where);
    }
  }();
  console.clear_progress();
  fmt::print("{}: reads well\n", input.title.empty() ? input.file.filename().string() : input.title);
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
  return input.statics ? check_static<Dim>(input, console) : 0;
}

}  // namespace

int run_check(const Arguments& arguments, Console& console) {
  const Case input = read_case(arguments.case_file, arguments.set);
  return with_dimension(input.model.dimension,
                        [&](auto dimension) { return check<dimension.value>(input, console); });
}

}  // namespace perimode::cli
