// SPDX-License-Identifier: BSD-3-Clause
#include "modal_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "perimode/core/version.hpp"
#include "perimode/io/exodus.hpp"

namespace perimode::cli {

namespace {

double relative_error(double computed, double exact) {
  if (std::isnan(exact)) return exact;
  if (exact == 0.0) return computed == 0.0 ? 0.0 : std::numeric_limits<double>::infinity();
  return computed / exact - 1.0;
}

const char* name(ModeKind kind) { return kind == ModeKind::rigid ? "rigid" : "elastic"; }

}  // namespace

References match_references(const ModalResult& result, const std::vector<ClosedFormMode>& exact,
                            bool from_lowest) {
  References matched(static_cast<std::size_t>(result.count()));
  std::vector<bool> taken(exact.size(), false);
  for (std::size_t k = 0; k < matched.size(); ++k) {
    if (from_lowest) {
      if (k < exact.size()) matched[k] = exact[k];
      continue;
    }
    const double omega = result.angular_frequency[static_cast<Eigen::Index>(k)];
    std::size_t best = exact.size();
    for (std::size_t e = 0; e < exact.size(); ++e) {
      if (taken[e]) continue;
      if (best == exact.size() ||
          std::abs(exact[e].discrete - omega) < std::abs(exact[best].discrete - omega))
        best = e;
    }
    if (best == exact.size()) continue;
    taken[best] = true;
    matched[k] = exact[best];
  }
  return matched;
}

Table modes_table(const ModalResult& result, const References& references, int dimension) {
  Table table;
  table.columns = {"mode",
                   "kind",
                   "eigenvalue",
                   "angular_frequency",
                   "frequency_hz",
                   "residual",
                   "exact_angular_frequency",
                   "relative_error",
                   "nonlocal_angular_frequency",
                   "classical_angular_frequency"};
  for (int a = 0; a < dimension; ++a) table.columns.push_back(std::string("effective_mass_") + "xyz"[a]);
  for (Eigen::Index k = 0; k < result.count(); ++k) {
    const auto& exact = references[static_cast<std::size_t>(k)];
    std::vector<TableCell> row = {
        Offset{k + 1},          std::string(name(result.kind[static_cast<std::size_t>(k)])),
        result.eigenvalue[k],   result.angular_frequency[k],
        result.frequency_hz[k], result.residual[k],
        exact.discrete,         relative_error(result.angular_frequency[k], exact.discrete),
        exact.nonlocal,         exact.classical};
    for (int a = 0; a < dimension; ++a) row.emplace_back(result.effective_mass(k, a));
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string modes_text(const ModalResult& result, const References& references,
                       const std::vector<double>& total_mass) {
  const bool exact = std::any_of(references.begin(), references.end(),
                                 [](const auto& r) { return !std::isnan(r.discrete); });
  fmt::memory_buffer out;
  auto to = std::back_inserter(out);
  fmt::format_to(to, "mode  kind     frequency [Hz]");
  if (exact) fmt::format_to(to, "      exact [Hz]   rel. error");
  fmt::format_to(to, "   residual");
  for (std::size_t a = 0; a < total_mass.size(); ++a) fmt::format_to(to, "  eff. mass {}", "xyz"[a]);
  fmt::format_to(to, "\n");
  const double to_hz = 1.0 / (2.0 * 3.14159265358979323846);
  for (Eigen::Index k = 0; k < result.count(); ++k) {
    const auto& r = references[static_cast<std::size_t>(k)];
    fmt::format_to(to, "{:4}  {:7} {:15.6f}", k + 1, name(result.kind[static_cast<std::size_t>(k)]),
                   result.frequency_hz[k]);
    if (exact && std::isnan(r.discrete)) {
      fmt::format_to(to, "{:>16}{:>13}", "-", "-");
    } else if (exact) {
      fmt::format_to(to, "{:16.6f}{:13.2e}", r.discrete * to_hz,
                     relative_error(result.angular_frequency[k], r.discrete));
    }
    fmt::format_to(to, "{:11.1e}", result.residual[k]);
    for (std::size_t a = 0; a < total_mass.size(); ++a) {
      const double share = result.effective_mass(k, static_cast<Eigen::Index>(a)) / total_mass[a];
      fmt::format_to(to, "{:11.2f} %", 100.0 * std::max(0.0, share));
    }
    fmt::format_to(to, "\n");
  }
  return fmt::to_string(out);
}

nlohmann::ordered_json certificate_json(const ModalResult& result) {
  const Certificate& c = result.certificate;
  return {
      {"complete", c.complete}, {"method", c.method},
      {"count", c.count},       {"up_to_hz", std::sqrt(std::max(c.at, 0.0)) / (2.0 * 3.14159265358979323846)},
      {"seconds", c.seconds},   {"solves", c.solves}};
}

template <int Dim>
void write_modes_exodus(const std::filesystem::path& file, const std::string& title, const Body<Dim>& body,
                        const ModalResult& result) {
  ExodusMesh mesh = exodus_mesh(body.particles);
  mesh.title = title;
  mesh.info.push_back("perimode " + version() + ", modes: step = mode number");
  ExodusWriter writer(file, mesh, {"frequency_hz"}, {"displacement_x", "displacement_y", "displacement_z"});
  std::vector<double> u(body.boundary.free_number.size());
  for (Eigen::Index k = 0; k < result.count(); ++k) {
    for (std::size_t d = 0; d < u.size(); ++d) {
      const Index number = body.boundary.free_number[d];
      u[d] = number >= 0 ? result.shape(number, k) : 0.0;
    }
    writer.write({static_cast<double>(k + 1), {result.frequency_hz[k]}, three_components(u, Dim)});
  }
  writer.close();
}

template void write_modes_exodus<1>(const std::filesystem::path&, const std::string&, const Body<1>&,
                                    const ModalResult&);
template void write_modes_exodus<2>(const std::filesystem::path&, const std::string&, const Body<2>&,
                                    const ModalResult&);
template void write_modes_exodus<3>(const std::filesystem::path&, const std::string&, const Body<3>&,
                                    const ModalResult&);

}  // namespace perimode::cli
