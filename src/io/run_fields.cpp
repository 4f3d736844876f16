// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/io/run_fields.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

#include "io/exodus_fields.hpp"
#include "perimode/core/error.hpp"

namespace perimode {
namespace {

const ExodusFields::Role role = {
    "a run", "displacements", "run `perimode transient` with fields_every and output.fields: [displacement]",
    "run the same case"};

/// The fields.exo of a result folder.
std::filesystem::path fields_of_run(const std::filesystem::path& folder, const Where& where) {
  std::filesystem::path file = folder / "fields.exo";
  if (!std::filesystem::is_directory(folder)) {
    invalid_input({"the result folder of a transient run", fmt::format("no folder {}", folder.string()),
                   role.remedy, where});
  }
  if (!std::filesystem::exists(file)) {
    invalid_input({"fields.exo in the result folder of a run", fmt::format("{} without one", folder.string()),
                   role.remedy, where});
  }
  return file;
}

/// Calls `frame` at the steps of these times.
template <int Dim>
void visit(const ExodusFields& file, const Particles<Dim>& particles, const std::vector<double>& times,
           const std::function<void(double, const Eigen::VectorXd&)>& frame) {
  const std::vector<int> variable = file.displacements(Dim);
  std::vector<double> component(static_cast<std::size_t>(particles.count()));
  Eigen::VectorXd u(static_cast<Eigen::Index>(component.size()) * Dim);
  for (std::size_t n = 0; n < times.size(); ++n) {
    for (int a = 0; a < Dim; ++a) {
      file.values(variable[static_cast<std::size_t>(a)], static_cast<int>(n) + 1, component);
      for (std::size_t i = 0; i < component.size(); ++i)
        u[static_cast<Eigen::Index>(i) * Dim + a] = component[i];
    }
    frame(times[n], u);
  }
}

/// The times without a last one that comes early. Throws where the others are not equally spaced.
std::vector<double> even_times(std::vector<double> times, const ExodusFields& file) {
  const auto too_few = [&](std::size_t count) {
    if (count < 4)
      file.complain(fmt::format("4 steps or more at equal times in {}", file.name()),
                    fmt::format("{}", count));
  };
  too_few(times.size());
  const double step = times[1] - times[0];
  const double close = 1e-6 * step;
  const auto is_even = [&](std::size_t n) {
    return std::abs(times[n] - times[0] - static_cast<double>(n) * step) <= close;
  };
  const std::size_t last = times.size() - 1;
  if (!is_even(last) && times[last] < times[0] + static_cast<double>(last) * step &&
      times[last] > times[last - 1])
    times.pop_back();
  too_few(times.size());
  for (std::size_t n = 2; n < times.size(); ++n) {
    if (is_even(n)) continue;
    file.complain(fmt::format("steps every {:.6e} s in {}, as the first two", step, file.name()),
                  fmt::format("step {} at {:.6e} s", n + 1, times[n]));
  }
  return times;
}

template <int Dim>
Particles<Dim> periodic_grid(const Model& model, const Where& where) {
  const auto* spec = std::get_if<GridSpec>(&model.particles);
  if (model.dimension != Dim) {
    invalid_input({fmt::format("a body of dimension {}", Dim), fmt::format("{}", model.dimension),
                   "change body.dimension", model.where});
  }
  if (spec == nullptr || !spec->remove.empty()) {
    invalid_input({"a full grid for the spectrum of a run",
                   spec == nullptr ? "a cloud" : "a grid with cells removed",
                   "run waves on a grid without holes", where});
  }
  for (int a = 0; a < Dim; ++a) {
    if (model.periodic[static_cast<std::size_t>(a)]) continue;
    invalid_input({"a body that is periodic along every axis for the spectrum of a run",
                   fmt::format("{} not periodic", "xyz"[a]), "set body.periodic", where});
  }
  const double section = Dim == 1 ? model.area : Dim == 2 ? model.thickness : 1.0;
  return grid_particles<Dim>(make_grid<Dim>(spec->lower, spec->upper, spec->spacing, spec->where), section);
}

}  // namespace

template <int Dim>
void for_each_run_frame(const std::filesystem::path& folder, const Particles<Dim>& particles,
                        const Where& where,
                        const std::function<void(double, const Eigen::VectorXd&)>& frame) {
  const ExodusFields file(fields_of_run(folder, where), role, where);
  file.require(particles);
  visit<Dim>(file, particles, file.times(), frame);
}

template <int Dim>
WaveRecorder<Dim> record_run(const std::filesystem::path& folder, const Model& model,
                             const std::vector<Point<Dim>>& corners, const Where& where) {
  const Particles<Dim> particles = periodic_grid<Dim>(model, where);
  const ExodusFields file(fields_of_run(folder, where), role, where);
  file.require(particles);
  const std::vector<double> times = even_times(file.times(), file);
  try {
    WaveRecorder<Dim> record(*particles.grid, waves_on_path(*particles.grid, corners), times.size());
    visit<Dim>(file, particles, times, [&](double time, const Eigen::VectorXd& u) {
      record.add(time, {u.data(), static_cast<std::size_t>(u.size())});
    });
    return record;
  } catch (const Error& error) {
    throw at(error, where);
  }
}

#define PERIMODE_RUN_FIELDS(D)                                                                         \
  template void for_each_run_frame<D>(const std::filesystem::path&, const Particles<D>&, const Where&, \
                                      const std::function<void(double, const Eigen::VectorXd&)>&);     \
  template WaveRecorder<D> record_run<D>(const std::filesystem::path&, const Model&,                   \
                                         const std::vector<Point<D>>&, const Where&)
PERIMODE_RUN_FIELDS(1);
PERIMODE_RUN_FIELDS(2);
PERIMODE_RUN_FIELDS(3);
#undef PERIMODE_RUN_FIELDS

}  // namespace perimode
