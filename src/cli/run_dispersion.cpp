// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "cloud_dispersion.hpp"
#include "commands.hpp"
#include "dispersion_output.hpp"
#include "dispersion_spectrum.hpp"
#include "dispersion_text.hpp"
#include "interrupt.hpp"
#include "machine.hpp"
#include "perimode/io/case.hpp"
#include "perimode/io/result_directory.hpp"
#include "summary.hpp"

namespace perimode::cli {

namespace {

namespace fs = std::filesystem;

/// What the case has and waves of the endless lattice do not see.
std::string left_aside(const Model& model) {
  std::vector<std::string> parts;
  if (!model.block_materials.empty()) parts.emplace_back("materials of blocks");
  if (!std::get<GridSpec>(model.particles).remove.empty()) parts.emplace_back("cells removed");
  if (!model.precracks.empty()) parts.emplace_back("pre-cracks");
  if (!model.boundary.empty()) parts.emplace_back("boundary");
  if (parts.empty()) return {};
  return fmt::format("left aside       {}: waves of the endless lattice of `material`\n",
                     fmt::join(parts, ", "));
}

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream out(file);
  out << text;
  out.close();
  if (!out) {
    throw Error(
        ErrorKind::environment,
        Complaint{"room to write " + file.filename().string(), "a failed write", "free some disk space", {}});
  }
}

/// The result's file as a case beside this one would name it.
fs::path seen_from_case(const fs::path& file, const Case& input) {
  std::error_code code;
  const fs::path folder = input.file.has_parent_path() ? input.file.parent_path() : fs::path(".");
  fs::path relative = fs::relative(file, folder, code);
  return code || relative.empty() ? file : relative;
}

template <int Dim>
void write_tables(const fs::path& folder, const Lattice<Dim>& lattice, const LatticeReport<Dim>& report,
                  const DispersionSpec& spec) {
  write_csv(folder / "dispersion.csv", waves_table(lattice, report.waves, spec));
  write_csv(folder / "bands.csv", bands_table(report.bands));
  if (spec.polar) write_csv(folder / "polar.csv", polar_table(lattice, spec));
  if (Dim < 3 && spec.zone) {
    constexpr double bytes_per_row = 400.0;
    refuse_if_too_large(bytes_per_row * Dim * std::pow(*spec.zone, Dim), "zone.csv");
    write_csv(folder / "zone.csv", zone_table(lattice, *spec.zone));
  }
}

template <int Dim>
void write_optimised(const fs::path& folder, const OptimisedReport<Dim>& optimised,
                     const DispersionSpec& spec) {
  if (!optimised.lattice) return;
  const Lattice<Dim>& lattice = *optimised.lattice;
  write_csv(folder / "coefficients.csv", coefficients_table(lattice.family, optimised.result.alpha));
  write_csv(folder / "optimised.csv", waves_table(lattice, optimised.report.waves, spec));
  if (optimised.fit)
    write_text(folder / "influence.yaml", influence_yaml(*optimised.fit, lattice.family.horizon));
}

std::string infeasible_message(const OptimisedMicromodulus& result, const OptimiseOptions& options) {
  const std::string bound =
      options.lower_bound ? fmt::format(" with lower_bound {}", *options.lower_bound) : std::string();
  const double most = result.largest_feasible_bound;
  if (!std::isfinite(most)) return fmt::format("no coefficients{} meet the long-wave speeds", bound);
  return fmt::format(
      "no coefficients{} meet the long-wave speeds: the largest bound that can be met is {}; give that "
      "or less",
      bound, most);
}

/// Warnings about what was found.
template <int Dim>
void warn(const OptimisedReport<Dim>& optimised, Console& console) {
  if (!optimised.lattice) return;
  constexpr double no_optimum = 1e-6;
  if (!(optimised.result.optimality <= no_optimum)) {
    console.warning(
        fmt::format("the coefficients are no optimum: the conditions of one are met to {:.1e} only; take "
                    "weights of one size",
                    optimised.result.optimality));
  }
  if (optimised.report.survey.least_squared < 0.0)
    console.warning(
        "the optimised lattice is unstable: some of its waves grow; give domain: zone, or a lower_bound");
  if (optimised.fit && optimised.fitted_survey.least_squared < 0.0)
    console.warning("the lattice with the fitted influence function is unstable; fit more cosines");
  constexpr double much = 0.1;
  if (optimised.fit && !(std::abs(optimised.fit->energy_ratio - 1.0) < much)) {
    console.warning(
        fmt::format("the influence function stores {:.4g} times the energy of the material as a continuum: "
                    "it fits the lattice's "
                    "distances alone; a lower_bound or fewer cosines make it smoother",
                    optimised.fit->energy_ratio));
  }
  const auto& alpha = optimised.result.alpha;
  const auto negative = std::count_if(alpha.begin(), alpha.end(), [](double a) { return a < 0.0; });
  if (negative > 0 && optimised.critical_stretch != 0.0) {
    console.warning(
        fmt::format("{} of {} coefficients are negative: such bonds release negative energy when they break, "
                    "so a case with a strength needs break_negative: true, or a lower_bound: 0 here",
                    negative, alpha.size()));
  }
}

template <int Dim>
int run_lattice(const Case& input, const Arguments& arguments, Console& console) {
  const auto start = Clock::now();
  const DispersionSpec& spec = *input.dispersion;
  ResultDirectory folder(arguments.output.value_or(input.output.directory), arguments.force);
  set_unfinished_result(folder.unfinished());

  console.stage("waves of the lattice", -1.0);
  const Lattice<Dim> lattice = make_lattice<Dim>(input.model);
  const ZonePath<Dim> path = zone_path(path_corners<Dim>(spec), lattice.family.spacing, spec.points);
  const LatticeReport<Dim> report = report_lattice(lattice, path, spec);
  const double seconds_waves = seconds_since(start);
  std::optional<OptimisedReport<Dim>> optimised;
  const auto optimising = Clock::now();
  if (spec.optimise) {
    console.stage("optimising the micromodulus", -1.0);
    optimised = report_optimised(lattice, path, spec);
  }
  const double seconds_optimise = seconds_since(optimising);

  console.stage("writing", -1.0);
  const auto writing = Clock::now();
  write_tables(folder.temporary(), lattice, report, spec);
  if (optimised) write_optimised(folder.temporary(), *optimised, spec);
  nlohmann::ordered_json spectrum;
  if (spec.spectrum) {
    console.stage("spectrum of the run", -1.0);
    spectrum = write_spectrum(folder.temporary(), lattice, input);
  }
  const bool done = !optimised || optimised->lattice;
  const std::string message = done ? std::string() : infeasible_message(optimised->result, *spec.optimise);

  nlohmann::ordered_json summary = {{"analysis", "dispersion"},
                                    {"title", input.title},
                                    {"particles", 1},
                                    {"bonds", lattice.family.size() / 2},
                                    {"dofs", Dim},
                                    {"engine", "serial"},
                                    {"solver", "symbol"},
                                    {"status", done ? "done" : "infeasible"},
                                    {"message", message},
                                    {"orbits", lattice.family.shell.size()},
                                    {"spacing", lattice.family.spacing},
                                    {"horizon", lattice.medium.horizon},
                                    {"kernel", name(lattice.medium.material.micromodulus.kernel)}};
  summary["classical_speed"] = {{"P", classical_speed(lattice.medium, Branch::pressure)}};
  if (Dim > 1) summary["classical_speed"]["S"] = classical_speed(lattice.medium, Branch::shear);
  summary["phase_error"] = spec.phase_error;
  summary["bands"] = bands_json(report.bands);
  summary["zone"] = survey_json(report.survey);
  if (optimised) {
    summary["certificate"] = certificate_json(*optimised);
    summary["optimised"] = optimised_json(*optimised, spec);
  }
  if (spec.spectrum) summary["spectrum"] = spectrum;
  add_run(summary, {{"waves", seconds_waves},
                    {"optimise", seconds_optimise},
                    {"write", seconds_since(writing)},
                    {"total", seconds_since(start)}});
  commit_summary(folder, summary);
  console.clear_progress();

  fmt::print("{}{}", waves_text(lattice, report, spec), left_aside(input.model));
  if (spec.spectrum) fmt::print("{}", spectrum_text(spectrum));
  if (optimised) {
    fmt::print("{}", optimised_text(lattice, *optimised, spec,
                                    seen_from_case(folder.target() / "coefficients.csv", input)));
  }
  fmt::print("results in {}\n", folder.target().string());
  std::fflush(stdout);
  if (report.survey.least_squared < 0.0)
    console.warning("the lattice is unstable: omega^2 < 0 somewhere, its waves grow there");
  if (optimised) warn(*optimised, console);
  if (done) return 0;
  console.error(message);
  return 1;
}

}  // namespace

int run_dispersion(const Arguments& arguments, Console& console) {
  const Case input = read_case(arguments.case_file, arguments.set);
  if (!input.dispersion) {
    invalid_input({"a section analysis.dispersion",
                   "none",
                   "add `analysis: { dispersion: {} }`",
                   {arguments.case_file.string(), 0, 0}});
  }
  if (!std::holds_alternative<GridSpec>(input.model.particles))
    return run_cloud_dispersion(input, arguments, console);
  return with_dimension(input.model.dimension, [&](auto dimension) {
    return run_lattice<dimension.value>(input, arguments, console);
  });
}

}  // namespace perimode::cli
