// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>

#include "cloud_dispersion.hpp"
#include "commands.hpp"
#include "dispersion_output.hpp"
#include "interrupt.hpp"
#include "machine.hpp"
#include "perimode/assembly/critical_stretches.hpp"
#include "perimode/dispersion/cloud_waves.hpp"
#include "perimode/io/result_directory.hpp"
#include "summary.hpp"

namespace perimode::cli {

namespace {

using std::numbers::pi;

Branch kind_of(int branch) { return branch == 0 ? Branch::pressure : Branch::shear; }

template <int Dim>
struct AxisWaves {
  int axis = 0;
  std::vector<CloudWaves<Dim>> waves;
};

/// Edge of the mean cell.
template <int Dim>
double mean_spacing(const Body<Dim>& body) {
  const auto& volume = body.particles.volume;
  const double all = std::accumulate(volume.begin(), volume.end(), 0.0);
  return std::pow(all / (body.section * static_cast<double>(volume.size())), 1.0 / Dim);
}

/// The waves asked for along every axis; errors point at the section that asks.
template <int Dim>
std::vector<AxisWaves<Dim>> waves_of(const Body<Dim>& body, const Case& input) {
  const DispersionSpec& spec = *input.dispersion;
  if (count_bonds(body.bonds, body.count()) == 0) {
    invalid_input({"bonds between the particles", "none within the horizon",
                   "take a horizon longer than their distances", input.model.where});
  }
  std::vector<AxisWaves<Dim>> result;
  try {
    for (int axis = 0; axis < Dim; ++axis) {
      const Point<Dim> direction = Point<Dim>::Unit(axis);
      const auto& period = std::get<CloudSpec>(input.model.particles).period;
      double longest = pi / mean_spacing(body);
      if (!period.empty()) {
        const double first = 2.0 * pi / period[static_cast<std::size_t>(axis)];
        longest = spec.waves ? first * (*spec.waves + 1e-6) : std::max(longest, first * (1.0 + 1e-6));
      }
      const std::vector<Point<Dim>> k = period_wave_vectors(body, direction, longest);
      result.push_back({axis, cloud_waves<Dim>(body, k, direction)});
    }
  } catch (const Error& error) {
    throw error.kind() == ErrorKind::invalid_input ? at(error, spec.where) : error;
  }
  return result;
}

template <int Dim>
Medium medium_of(const Case& input, const Body<Dim>& body) {
  return {input.model.material, {Dim, input.model.plane, body.section}, mean_horizon(body, 0)};
}

template <int Dim>
Table table_of(const std::vector<AxisWaves<Dim>>& axes, const Medium& medium, const DispersionSpec& spec) {
  Table table;
  for (int a = 0; a < Dim; ++a) table.columns.push_back(std::string("k_") + "xyz"[a]);
  for (const char* name : {"branch", "angular_frequency", "phase_velocity", "group_velocity",
                           "classical_angular_frequency", "continuum_angular_frequency"})
    table.columns.emplace_back(name);
  if (spec.time_step) table.columns.emplace_back("stepped_angular_frequency");
  table.columns.emplace_back("spread");
  table.columns.emplace_back("residual");
  for (const AxisWaves<Dim>& axis : axes) {
    for (const CloudWaves<Dim>& wave : axis.waves) {
      const double k = wave.waves.k.norm();
      for (int b = 0; b < Dim; ++b) {
        const auto at = static_cast<std::size_t>(b);
        std::vector<TableCell> row(wave.waves.k.data(), wave.waves.k.data() + Dim);
        const double omega = wave.waves.angular_frequency[at];
        row.emplace_back(branch_name(b, Dim));
        for (const double value :
             {omega, wave.waves.phase_velocity[at], wave.waves.group_velocity[at].norm(),
              classical_speed(medium, kind_of(b)) * k, continuum_frequency(medium, kind_of(b), k)})
          row.emplace_back(value);
        if (spec.time_step) row.emplace_back(stepped_frequency(omega, spec));
        row.emplace_back(wave.spread[at]);
        row.emplace_back(wave.residual[at]);
        table.rows.push_back(std::move(row));
      }
    }
  }
  return table;
}

/// Phase speed over the classical one, and the spread of the frequency over it.
template <int Dim>
std::array<double, 2> error_of(const CloudWaves<Dim>& wave, int branch, const Medium& medium) {
  const auto at = static_cast<std::size_t>(branch);
  return {wave.waves.phase_velocity[at] / classical_speed(medium, kind_of(branch)),
          wave.spread[at] / wave.waves.angular_frequency[at]};
}

template <int Dim>
std::string text_of(const Body<Dim>& body, const std::vector<AxisWaves<Dim>>& axes, const Medium& medium) {
  std::string text = fmt::format(
      "cloud            {} particles, {} bonds, mean horizon {:.6g} m\n\n"
      "axis  branch  classical [m/s]  longest wave [m]     speed    spread  shortest wave [m]     speed    "
      "spread\n",
      body.count(), count_bonds(body.bonds, body.count()), medium.horizon);
  for (const AxisWaves<Dim>& axis : axes) {
    for (int b = 0; b < Dim; ++b) {
      const auto first = error_of(axis.waves.front(), b, medium);
      const auto last = error_of(axis.waves.back(), b, medium);
      text += fmt::format("{:4}  {:6}  {:15.6g}  {:16.6g}  {:8.5f}  {:8.5f}  {:17.6g}  {:8.5f}  {:8.5f}\n",
                          "xyz"[axis.axis], branch_name(b, Dim), classical_speed(medium, kind_of(b)),
                          2.0 * pi / axis.waves.front().waves.k.norm(), first[0], first[1],
                          2.0 * pi / axis.waves.back().waves.k.norm(), last[0], last[1]);
    }
  }
  text +=
      "\nspeed            phase speed over the classical one; Rayleigh quotients, no eigenfrequencies\n"
      "spread           of the local frequency over the particles, relative\n";
  return text;
}

template <int Dim>
int run(const Case& input, const Arguments& arguments, Console& console) {
  const auto start = Clock::now();
  const DispersionSpec& spec = *input.dispersion;
  refuse_if_too_large(least_body_bytes(input.model), "the body");
  ResultDirectory folder(arguments.output.value_or(input.output.directory), arguments.force);
  set_unfinished_result(folder.unfinished());

  const Body<Dim> body = build_body<Dim>(input.model, console.sink());
  const double seconds_body = seconds_since(start);
  console.stage("waves of the cloud", -1.0);
  const auto computing = Clock::now();
  const std::vector<AxisWaves<Dim>> axes = waves_of(body, input);
  const Medium medium = medium_of(input, body);
  const double seconds_waves = seconds_since(computing);

  console.stage("writing", -1.0);
  const auto writing = Clock::now();
  write_csv(folder.temporary() / "dispersion.csv", table_of(axes, medium, spec));
  nlohmann::ordered_json summary = begin_summary("dispersion", input.title, body);
  summary["solver"] = "rayleigh";
  summary["status"] = "done";
  summary["message"] = "";
  summary["horizon"] = medium.horizon;
  summary["classical_speed"] = {{"P", classical_speed(medium, Branch::pressure)}};
  if (Dim > 1) summary["classical_speed"]["S"] = classical_speed(medium, Branch::shear);
  add_run(summary, {{"body", seconds_body},
                    {"waves", seconds_waves},
                    {"write", seconds_since(writing)},
                    {"total", seconds_since(start)}});
  commit_summary(folder, summary);
  console.clear_progress();
  fmt::print("{}results in {}\n", text_of(body, axes, medium), folder.target().string());
  std::fflush(stdout);
  return 0;
}

}  // namespace

int run_cloud_dispersion(const Case& input, const Arguments& arguments, Console& console) {
  return with_dimension(input.model.dimension,
                        [&](auto dimension) { return run<dimension.value>(input, arguments, console); });
}

template <int Dim>
std::string cloud_dispersion_plan_text(const Body<Dim>& body, const Case& input) {
  const std::vector<AxisWaves<Dim>> axes = waves_of(body, input);
  std::string text = fmt::format("dispersion\ncloud            {} particles, {} bonds\nwaves            ",
                                 body.count(), count_bonds(body.bonds, body.count()));
  for (const AxisWaves<Dim>& axis : axes)
    text += fmt::format("{}{} along {}", axis.axis > 0 ? ", " : "", axis.waves.size(), "xyz"[axis.axis]);
  return text + "\n";
}

template std::string cloud_dispersion_plan_text<1>(const Body<1>&, const Case&);
template std::string cloud_dispersion_plan_text<2>(const Body<2>&, const Case&);
template std::string cloud_dispersion_plan_text<3>(const Body<3>&, const Case&);

}  // namespace perimode::cli
