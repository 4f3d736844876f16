// SPDX-License-Identifier: BSD-3-Clause
#include "transient_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "machine.hpp"

namespace perimode::cli {

std::string history_header(const std::vector<std::string>& probes, bool boundary_work) {
  std::string header = "step,time,kinetic,strain,external_work,damping,broken,balance";
  for (const std::string& name : probes) header += "," + name;
  if (boundary_work) header += ",boundary_work";
  return header;
}

void add_history(OutputFile& file, const HistoryRow& row, bool boundary_work) {
  const auto to = std::back_inserter(file.buffer());
  const Energies& e = row.energies;
  fmt::format_to(to, "{}", row.step);
  for (const double value :
       {row.time, e.kinetic, e.strain, e.external_work, e.damping, e.broken, e.balance()})
    fmt::format_to(to, ",{:.17g}", value);
  for (const double value : row.probes) fmt::format_to(to, ",{:.17g}", value);
  if (boundary_work) fmt::format_to(to, ",{:.17g}", e.balance());
  file.buffer().push_back('\n');
  file.flush_if_full();
}

double relative_balance(const Energies& e) {
  const double scale =
      std::max({e.initial, std::abs(e.external_work), e.kinetic + e.strain + e.broken + e.damping});
  return scale > 0.0 ? std::abs(e.balance()) / scale : 0.0;
}

namespace {

std::string step_text(const TransientPlan& plan) {
  fmt::memory_buffer out;
  auto to = std::back_inserter(out);
  fmt::format_to(to, "method           {}, operator {}\n", plan.method, plan.form);
  if (!plan.solver.empty()) fmt::format_to(to, "solver           {}\n", plan.solver);
  if (plan.stable.limit > 0.0) {
    fmt::format_to(to, "stable step      {:.6e} s (omega_max {:.6e} rad/s; sufficient bound {:.6e} s)\n",
                   plan.stable.limit, plan.stable.omega_max, plan.stable.bound);
  }
  fmt::format_to(to, "step             {:.6e} s", plan.dt);
  if (plan.stable.limit > 0.0) fmt::format_to(to, ", {:.3g} of the stable one", plan.dt / plan.stable.limit);
  fmt::format_to(to, "\nsteps            {}, to {:.6e} s\n", plan.steps,
                 plan.dt * static_cast<double>(plan.steps));
  return fmt::to_string(out);
}

}  // namespace

template <int Dim>
std::string transient_start_text(const Body<Dim>& body, const TransientPlan& plan) {
  return fmt::format("{} particles, {} bonds, {} dofs\n{}", body.count(),
                     count_bonds(body.bonds, body.count()), body.boundary.free, step_text(plan));
}

std::string transient_text(const TransientResult& result) {
  fmt::memory_buffer out;
  auto to = std::back_inserter(out);
  if (result.plan.method == "modal") {
    fmt::format_to(to, "left out         {:.1e} of the initial energy, {:.1e} of the loads\n",
                   result.truncation.initial_energy, result.truncation.load);
  }
  if (result.iterations > 0) fmt::format_to(to, "iterations       {}\n", result.iterations);
  if (result.first_step > 0) fmt::format_to(to, "resumed          from step {}\n", result.first_step);
  const Energies& e = result.energies;
  fmt::format_to(to, "\nenergy [J]       at step {}\n", result.step);
  fmt::format_to(to, "  initial        {:14.6e}\n  external work  {:14.6e}\n  kinetic        {:14.6e}\n",
                 e.initial, e.external_work, e.kinetic);
  fmt::format_to(to, "  strain         {:14.6e}\n", e.strain);
  if (e.damping != 0.0) fmt::format_to(to, "  damping        {:14.6e}\n", e.damping);
  if (e.broken != 0.0) fmt::format_to(to, "  broken bonds   {:14.6e}\n", e.broken);
  if (!result.plan.symmetric) fmt::format_to(to, "  boundary work  {:14.6e}\n", result.boundary_work);
  fmt::format_to(to, "balance          {:.1e} of the energy that went through{}\n", relative_balance(e),
                 result.plan.symmetric ? "" : " (unsymmetric boundary)");
  if (result.broken_bonds > 0) fmt::format_to(to, "broken bonds     {}\n", result.broken_bonds);
  return fmt::to_string(out);
}

template <int Dim>
std::string transient_plan_text(const Body<Dim>& body, const TransientPlan& plan) {
  return fmt::format("transient\n{}memory           about {} ({} available)\n",
                     transient_start_text(body, plan), bytes_text(plan.memory_bytes),
                     bytes_text(available_memory()));
}

#define PERIMODE_TRANSIENT_OUTPUT(D)                                                  \
  template std::string transient_start_text<D>(const Body<D>&, const TransientPlan&); \
  template std::string transient_plan_text<D>(const Body<D>&, const TransientPlan&)
PERIMODE_TRANSIENT_OUTPUT(1);
PERIMODE_TRANSIENT_OUTPUT(2);
PERIMODE_TRANSIENT_OUTPUT(3);
#undef PERIMODE_TRANSIENT_OUTPUT

}  // namespace perimode::cli
