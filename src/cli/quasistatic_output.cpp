// SPDX-License-Identifier: BSD-3-Clause
#include "quasistatic_output.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>

#include "machine.hpp"
#include "perimode/linalg/updated_solver.hpp"

namespace perimode::cli {

std::string load_curve_header(QuasistaticControl control) {
  std::string header =
      "event,load_factor,displacement,stored_energy,dissipated_energy,bond_energy_released,external_work,"
      "broken_bonds,crack_length,force,relaxation_energy,balance,breaking_bonds,total_force,"
      "mean_displacement";
  if (control == QuasistaticControl::steps) header += ",time,iterations";
  return header;
}

void add_load_curve(OutputFile& file, const QuasistaticRow& row, QuasistaticControl control) {
  const auto to = std::back_inserter(file.buffer());
  fmt::format_to(to, "{}", row.event);
  for (const double value : {row.load_factor, row.displacement, row.stored_energy, row.dissipated_energy,
                             row.bond_energy_released, row.external_work})
    fmt::format_to(to, ",{:.17g}", value);
  fmt::format_to(to, ",{}", row.broken_bonds);
  for (const double value : {row.crack_length, row.force, row.relaxation_energy, row.balance()})
    fmt::format_to(to, ",{:.17g}", value);
  fmt::format_to(to, ",{},{:.17g},{:.17g}", row.breaking_bonds, row.total_force, row.mean_displacement);
  if (control == QuasistaticControl::steps) fmt::format_to(to, ",{:.17g},{}", row.time, row.iterations);
  file.buffer().push_back('\n');
  file.flush_if_full();
}

std::string crack_path_header(int dimension) {
  return fmt::format("event,first,second,{},energy", dimension == 1 ? "x" : dimension == 2 ? "x,y" : "x,y,z");
}

template <int Dim>
void add_crack_path(OutputFile& file, const std::vector<BrokenBond<Dim>>& bonds) {
  const auto to = std::back_inserter(file.buffer());
  for (const BrokenBond<Dim>& bond : bonds) {
    fmt::format_to(to, "{},{},{}", bond.event, bond.first, bond.second);
    for (int a = 0; a < Dim; ++a) fmt::format_to(to, ",{:.17g}", bond.middle[a]);
    fmt::format_to(to, ",{:.17g}\n", bond.energy);
  }
  file.flush_if_full();
}

std::string_view status_name(QuasistaticStatus status) {
  switch (status) {
    case QuasistaticStatus::separated:
      return "separated";
    case QuasistaticStatus::events:
      return "events";
    case QuasistaticStatus::load_drop:
      return "load_drop";
    case QuasistaticStatus::done:
      return "done";
    case QuasistaticStatus::unstretched:
      return "unstretched";
    case QuasistaticStatus::dead_loads:
      return "dead_loads";
    case QuasistaticStatus::not_converged:
      return "not_converged";
    case QuasistaticStatus::interrupted:
      break;
  }
  return "interrupted";
}

namespace {

/// Area that the crack grew by up to the last row, m2.
double grown_area(const QuasistaticResult& result, const QuasistaticFacts& facts) {
  const double grown = result.last.crack_length - facts.area.initial;
  return facts.dimension == 3 ? grown : grown * facts.section;
}

/// Of a unit area of new crack, J/m2; 0 before there is any.
double per_area(double energy, double area) { return area > 0.0 ? energy / area : 0.0; }

}  // namespace

void add_quasistatic(nlohmann::ordered_json& summary, const QuasistaticResult& result,
                     const QuasistaticFacts& facts) {
  using Json = nlohmann::ordered_json;
  summary["control"] = facts.control == QuasistaticControl::event ? "event" : "steps";
  summary["solver"] = result.plan.solver;
  summary["status"] = status_name(result.status);
  summary["message"] = result.message;
  summary["rigid_modes"] = result.plan.rigid_modes;
  summary["events"] = result.events;
  summary["first_load"] =
      facts.control == QuasistaticControl::event ? Json(result.first_load) : Json();  // steps have none
  summary["peak_load"] = result.peak_load;
  summary["peak_event"] = result.peak_event;
  summary["griffith"] = nullptr;
  if (facts.griffith) {
    summary["griffith"] = {{"load_factor", facts.griffith->load_factor},
                           {"energy_release_rate", facts.griffith->energy_release_rate},
                           {"fracture_energy", facts.griffith->fracture_energy},
                           {"increment", facts.griffith->increment},
                           {"cut", facts.griffith->cut}};
  }
  summary["broken_bonds"] = result.broken_bonds;
  summary["initial_crack_length"] = facts.area.initial;
  summary["crack_length"] = result.crack_length;
  const QuasistaticRow& last = result.last;
  summary["energies"] = {{"stored", last.stored_energy},
                         {"dissipated", last.dissipated_energy},
                         {"bond_energy_released", last.bond_energy_released},
                         {"relaxation", last.relaxation_energy},
                         {"external_work", last.external_work},
                         {"balance", last.balance()}};
  const double area = grown_area(result, facts);
  summary["energy_per_area"] = {{"dissipated", per_area(last.dissipated_energy, area)},
                                {"bond_energy_released", per_area(last.bond_energy_released, area)},
                                {"fracture_energy", facts.fracture_energy}};
  summary["worst_balance"] = result.worst_balance;
  summary["worst_residual"] = result.worst_residual;
  summary["factor_seconds"] = result.factor_seconds;
  for (int k = 0; k < solve_ways; ++k) {
    const WayTotals& way = result.ways[static_cast<std::size_t>(k)];
    summary["ways"][name(static_cast<SolveWay>(k))] = {{"solves", way.solves},
                                                       {"columns", way.columns},
                                                       {"iterations", way.iterations},
                                                       {"seconds", way.seconds}};
  }
  summary["loose_pieces"] = Json::array();
  for (const LoosePiece& piece : result.loose) {
    summary["loose_pieces"].push_back({{"event", piece.event},
                                       {"particles", piece.particles},
                                       {"centre", piece.centre},
                                       {"loaded", piece.loaded}});
  }
}

template <int Dim>
std::string quasistatic_start_text(const Body<Dim>& body, const QuasistaticPlan& plan) {
  std::string text = fmt::format("{} particles, {} bonds, {} dofs\nsolver           {}\n", body.count(),
                                 plan.bonds, plan.dofs, plan.solver);
  if (plan.rigid_modes > 0)
    text += fmt::format("rigid motions    {} free, projected out\n", plan.rigid_modes);
  return text;
}

std::string loose_text(const LoosePiece& piece, const QuasistaticOptions& options) {
  // A piece with load may end the run, and of those to be removed the ones that hang by a hinge are held.
  const bool held = options.loose == LoosePieces::hold && !(piece.loaded && options.stop.separated);
  return fmt::format("{} {}: a piece of {} particle{} at [{:.4g}] m has lost its support{}{}",
                     options.control == QuasistaticControl::event ? "event" : "step", piece.event,
                     piece.particles, piece.particles == 1 ? "" : "s", fmt::join(piece.centre, ", "),
                     piece.loaded ? " and carries load" : "", held ? "; it is held" : "");
}

namespace {

void add_loads(std::back_insert_iterator<fmt::memory_buffer> to, const QuasistaticResult& result,
               const QuasistaticFacts& facts) {
  if (facts.control == QuasistaticControl::event) {
    fmt::format_to(to, "first failure    load factor {:.6g}\n", result.first_load);
    fmt::format_to(to, "peak             load factor {:.6g} at event {}\n", result.peak_load,
                   result.peak_event);
  } else {
    fmt::format_to(to, "peak             load factor {:.6g} at step {}\n", result.peak_load,
                   result.peak_event);
  }
  if (!facts.griffith) return;
  fmt::format_to(to, "Griffith         load factor {:.6g} (G {:.4g} J/m2 at load factor 1, G0 {:.4g} J/m2)\n",
                 facts.griffith->load_factor, facts.griffith->energy_release_rate,
                 facts.griffith->fracture_energy);
}

void add_energies(std::back_insert_iterator<fmt::memory_buffer> to, const QuasistaticResult& result,
                  const QuasistaticFacts& facts) {
  const QuasistaticRow& last = result.last;
  fmt::format_to(to, "\nenergy [J]       at {} {}\n",
                 facts.control == QuasistaticControl::event ? "event" : "step", last.event);
  fmt::format_to(to, "  external work  {:14.6e}\n  stored         {:14.6e}\n", last.external_work,
                 last.stored_energy);
  fmt::format_to(to, "  broken bonds   {:14.6e}  ({:.6e} held, {:.6e} as they were let go)\n",
                 last.bond_energy_released + last.relaxation_energy, last.bond_energy_released,
                 last.relaxation_energy);
  fmt::format_to(to, "  dissipated     {:14.6e}  (along the load curve)\n", last.dissipated_energy);
  fmt::format_to(to, "balance          {:.1e} of the external work at worst\n", result.worst_balance);
  const double area = grown_area(result, facts);
  if (area > 0.0) {
    fmt::format_to(to, "per area [J/m2]  {:.4g} dissipated, {:.4g} of bonds, G0 {:.4g}\n",
                   per_area(last.dissipated_energy, area), per_area(last.bond_energy_released, area),
                   facts.fracture_energy);
  }
}

/// The crack at the end and at the start.
std::string extent_text(const QuasistaticResult& result, const QuasistaticFacts& facts) {
  constexpr const char* label[] = {"cuts             ", "crack length     ", "crack area       "};
  constexpr const char* unit[] = {"", " m", " m2"};
  const int d = facts.dimension - 1;
  return fmt::format("{}{:.6g}{}, from {:.6g}{}\n", label[d], result.crack_length, unit[d],
                     facts.area.initial, unit[d]);
}

/// "after 7 events: separated, ..."
std::string end_text(const QuasistaticResult& result, const char* counted) {
  const std::string after =
      fmt::format("after {} {}{}", result.events, counted, result.events == 1 ? "" : "s");
  switch (result.status) {
    case QuasistaticStatus::events:
      return after + ", as asked";
    case QuasistaticStatus::separated:
      return fmt::format("{}: separated, {}", after, result.message);
    case QuasistaticStatus::not_converged:
      return fmt::format("{}: not converged, {}", after, result.message);
    default:  // the message says it all; a run of all its steps has none
      return fmt::format("{}: {}", after, result.message.empty() ? "done" : result.message);
  }
}

}  // namespace

std::string quasistatic_text(const QuasistaticResult& result, const QuasistaticFacts& facts) {
  fmt::memory_buffer out;
  const auto to = std::back_inserter(out);
  const char* counted = facts.control == QuasistaticControl::event ? "event" : "step";
  add_loads(to, result, facts);
  if (facts.resumed_from > 0)
    fmt::format_to(to, "resumed          from {} {}\n", counted, facts.resumed_from);
  fmt::format_to(to, "ended            {}\n", end_text(result, counted));
  fmt::format_to(to, "broken bonds     {}\n", result.broken_bonds);
  fmt::format_to(to, "{}", extent_text(result, facts));
  if (!result.loose.empty()) fmt::format_to(to, "loose pieces     {}\n", result.loose.size());
  add_energies(to, result, facts);
  const char* label = "\nsolutions        ";
  for (int k = 0; k < solve_ways; ++k) {
    const WayTotals& way = result.ways[static_cast<std::size_t>(k)];
    if (way.solves == 0) continue;
    fmt::format_to(to, "{}{}: {}, {} bonds, {} iterations, {:.3g} s\n", label, name(static_cast<SolveWay>(k)),
                   way.solves, way.columns, way.iterations, way.seconds);
    label = "                 ";
  }
  fmt::format_to(to, "residual         {:.1e} at worst\n", result.worst_residual);
  return fmt::to_string(out);
}

std::string quasistatic_plan_text(const QuasistaticPlan& plan) {
  std::string text =
      fmt::format("quasistatic\nbonds            {}\ndofs             {}\nsolver           {}\n", plan.bonds,
                  plan.dofs, plan.solver);
  if (plan.rigid_modes > 0)
    text += fmt::format("rigid motions    {} free, projected out\n", plan.rigid_modes);
  return text + fmt::format("memory           about {} ({} available)\n", bytes_text(plan.memory_bytes),
                            bytes_text(available_memory()));
}

#define PERIMODE_QUASISTATIC_OUTPUT(D)                                             \
  template void add_crack_path<D>(OutputFile&, const std::vector<BrokenBond<D>>&); \
  template std::string quasistatic_start_text<D>(const Body<D>&, const QuasistaticPlan&)
PERIMODE_QUASISTATIC_OUTPUT(1);
PERIMODE_QUASISTATIC_OUTPUT(2);
PERIMODE_QUASISTATIC_OUTPUT(3);
#undef PERIMODE_QUASISTATIC_OUTPUT

}  // namespace perimode::cli
