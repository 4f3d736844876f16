// SPDX-License-Identifier: BSD-3-Clause
#include "static_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "fields.hpp"
#include "machine.hpp"
#include "perimode/core/version.hpp"
#include "perimode/io/exodus.hpp"

namespace perimode::cli {

Table reactions_table(const StaticResult& result, int dimension) {
  Table table;
  table.columns = {"region"};
  for (int a = 0; a < dimension; ++a) table.columns.push_back(std::string("force_") + "xyz"[a]);
  for (const Reaction& reaction : result.reactions) {
    std::vector<TableCell> row = {reaction.region};
    for (int a = 0; a < dimension; ++a) row.emplace_back(reaction.force[static_cast<std::size_t>(a)]);
    table.rows.push_back(std::move(row));
  }
  return table;
}

template <int Dim>
std::string static_text(const Body<Dim>& body, const StaticResult& result) {
  fmt::memory_buffer out;
  auto to = std::back_inserter(out);
  fmt::format_to(to, "{} particles, {} bonds, {} dofs\n", body.count(), count_bonds(body.bonds, body.count()),
                 body.boundary.free);
  fmt::format_to(to, "solver           {}: {}\n", result.solver, result.reason);
  if (result.iterations > 0) fmt::format_to(to, "iterations       {}\n", result.iterations);
  if (result.rigid_modes > 0) fmt::format_to(to, "rigid motions    {}, projected out\n", result.rigid_modes);
  fmt::format_to(to, "residual         {:.1e}\n", result.residual);
  if (!result.reactions.empty()) {
    std::size_t width = 8;
    for (const Reaction& reaction : result.reactions) width = std::max(width, reaction.region.size());
    fmt::format_to(to, "\n{:{}}", "reaction", width);
    for (int a = 0; a < Dim; ++a) fmt::format_to(to, "  {:>14}", fmt::format("force {} [N]", "xyz"[a]));
    fmt::format_to(to, "\n");
    for (const Reaction& reaction : result.reactions) {
      fmt::format_to(to, "{:{}}", reaction.region, width);
      for (int a = 0; a < Dim; ++a)
        fmt::format_to(to, "  {:14.6e}", reaction.force[static_cast<std::size_t>(a)]);
      fmt::format_to(to, "\n");
    }
    fmt::format_to(to, "\n");
  }
  fmt::format_to(to, "balance          {:.1e}\n", result.balance);
  fmt::format_to(to, "strain energy    {:.9e} J\n", result.strain_energy);
  fmt::format_to(to, "external work    {:.9e} J\n", result.external_work);
  Index furthest = 0;
  double largest = 0.0;
  for (Index i = 0; i < body.count(); ++i) {
    const double size = result.displacement.template segment<Dim>(static_cast<Eigen::Index>(i) * Dim).norm();
    if (size > largest) {
      largest = size;
      furthest = i;
    }
  }
  const auto& x = body.particles.position[static_cast<std::size_t>(furthest)];
  fmt::format_to(to, "displacement     at most {:.6e} m, at (", largest);
  for (int a = 0; a < Dim; ++a) fmt::format_to(to, "{}{:.6g}", a == 0 ? "" : ", ", x[a]);
  fmt::format_to(to, ")\n");
  return fmt::to_string(out);
}

template <int Dim>
void write_fields_exodus(const std::filesystem::path& file, const std::string& title, const Body<Dim>& body,
                         const StaticResult& result, const std::vector<std::string>& fields) {
  ExodusMesh mesh = exodus_mesh(body.particles);
  mesh.title = title;
  mesh.info.push_back("perimode " + version() + ", static analysis");
  Fields chosen = chosen_fields<Dim>(body, result.displacement, nullptr, fields);
  ExodusWriter writer(file, mesh, {}, chosen.names);
  writer.write({0.0, {}, std::move(chosen.values)});
  writer.close();
}

std::string static_plan_text(const StaticPlan& plan) {
  fmt::memory_buffer out;
  auto to = std::back_inserter(out);
  fmt::format_to(to, "static\n");
  fmt::format_to(to, "particles        {}{}\n", plan.particles,
                 plan.ghosts > 0 ? fmt::format("  (+ {} fictitious)", plan.ghosts) : std::string());
  fmt::format_to(to, "bonds            {}\ndofs             {}\n", plan.bonds, plan.dofs);
  if (plan.fill.nonzeros > 0) {
    fmt::format_to(to, "factor           {} nonzeros, {:.3g} GFlop, {}\n", plan.fill.nonzeros,
                   plan.fill.flops * 1e-9, bytes_text(plan.fill.factor_bytes));
  }
  fmt::format_to(to, "rigid motions    {}\n", plan.rigid);
  fmt::format_to(to, "solver           {}: {}\n", plan.name, plan.reason);
  fmt::format_to(to, "memory           about {} ({} available)\n", bytes_text(plan.memory_bytes),
                 bytes_text(available_memory()));
  return fmt::to_string(out);
}

#define PERIMODE_STATIC_OUTPUT(D)                                                                        \
  template std::string static_text<D>(const Body<D>&, const StaticResult&);                              \
  template void write_fields_exodus<D>(const std::filesystem::path&, const std::string&, const Body<D>&, \
                                       const StaticResult&, const std::vector<std::string>&)
PERIMODE_STATIC_OUTPUT(1);
PERIMODE_STATIC_OUTPUT(2);
PERIMODE_STATIC_OUTPUT(3);
#undef PERIMODE_STATIC_OUTPUT

}  // namespace perimode::cli
