// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/io/run_fields.hpp"

#include <exodusII.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "perimode/core/error.hpp"

namespace perimode {
namespace {

constexpr std::size_t longest_name = 255;
constexpr const char* how_to_write =
    "run `perimode transient` with fields_every and output.fields: [displacement]";

/// The fields.exo of a result, open for reading.
class FieldsOfRun {
 public:
  FieldsOfRun(const std::filesystem::path& folder, Where where)
      : file_(folder / "fields.exo"), where_(std::move(where)) {
    if (!std::filesystem::is_directory(folder))
      complain("the result folder of a transient run", fmt::format("no folder {}", folder.string()));
    if (!std::filesystem::exists(file_))
      complain("fields.exo in the result folder of a run", fmt::format("{} without one", folder.string()));
    ex_opts(EX_DEFAULT);  // report errors by code, print nothing
    int word = sizeof(double);
    int stored = 0;
    float version = 0.0F;
    id_ = ex_open(file_.c_str(), EX_READ, &word, &stored, &version);
    check(id_);
  }
  ~FieldsOfRun() {
    if (id_ >= 0) (void)ex_close(id_);
  }
  FieldsOfRun(const FieldsOfRun&) = delete;
  FieldsOfRun& operator=(const FieldsOfRun&) = delete;
  FieldsOfRun(FieldsOfRun&&) = delete;
  FieldsOfRun& operator=(FieldsOfRun&&) = delete;

  [[nodiscard]] std::int64_t nodes() const {
    ex_init_params init = {};
    check(ex_get_init_ext(id_, &init));
    if (init.num_dim != 3) complain("particles in x, y and z", fmt::format("{} axes", init.num_dim));
    return init.num_nodes;
  }

  [[nodiscard]] std::array<std::vector<double>, 3> places(std::int64_t nodes) const {
    std::array<std::vector<double>, 3> x;
    for (auto& component : x) component.assign(static_cast<std::size_t>(nodes), 0.0);
    check(ex_get_coord(id_, x[0].data(), x[1].data(), x[2].data()));
    return x;
  }

  [[nodiscard]] std::vector<double> times() const {
    const std::int64_t steps = ex_inquire_int(id_, EX_INQ_TIME);
    check(static_cast<int>(std::min<std::int64_t>(steps, 0)));
    std::vector<double> result(static_cast<std::size_t>(steps));
    if (steps > 0) check(ex_get_all_times(id_, result.data()));
    return result;
  }

  [[nodiscard]] int displacement(int axis) const {
    int count = 0;
    check(ex_get_variable_param(id_, EX_NODAL, &count));
    check(ex_set_max_name_length(id_, longest_name));
    const std::string name = std::string("displacement_") + "xyz"[axis];
    std::array<char, longest_name + 1> text = {};
    for (int k = 1; k <= count; ++k) {
      check(ex_get_variable_name(id_, EX_NODAL, k, text.data()));
      if (name == text.data()) return k;
    }
    complain(fmt::format("displacements in {}", file_.string()), fmt::format("no variable {}", name));
  }

  void values(int variable, int step, std::vector<double>& result) const {
    check(ex_get_var(id_, step, EX_NODAL, variable, 1, static_cast<std::int64_t>(result.size()),
                     result.data()));
  }

  [[noreturn]] void complain(const std::string& expected, const std::string& got) const {
    invalid_input({expected, got, how_to_write, where_});
  }
  [[nodiscard]] const Where& where() const { return where_; }
  [[nodiscard]] std::string name() const { return file_.string(); }

 private:
  void check(int code) const {
    if (code >= 0) return;
    complain(fmt::format("an Exodus file that can be read ({})", file_.string()),
             fmt::format("error {}", code));
  }

  std::filesystem::path file_;
  Where where_;
  int id_ = -1;
};

template <int Dim>
void require_particles(const FieldsOfRun& file, const Particles<Dim>& particles) {
  const std::int64_t n = file.nodes();
  if (n != particles.count()) {
    invalid_input({fmt::format("a run of the {} particles of this body", particles.count()),
                   fmt::format("{} particles in {}", n, file.name()), "run the same case", file.where()});
  }
  if (n == 0) return;
  const std::array<std::vector<double>, 3> place = file.places(n);
  Point<Dim> lower = particles.position[0], upper = lower;
  for (const Point<Dim>& point : particles.position) {
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  }
  const double close = 1e-9 * (upper - lower).maxCoeff();
  for (std::size_t i = 0; i < particles.position.size(); ++i) {
    for (int a = 0; a < Dim; ++a) {
      const double x = place[static_cast<std::size_t>(a)][i];
      if (std::abs(x - particles.position[i][a]) <= close) continue;
      invalid_input({fmt::format("a run of this body, whose particle {} has {} = {:.17g} m", i + 1, "xyz"[a],
                                 particles.position[i][a]),
                     fmt::format("{:.17g} m in {}", x, file.name()), "run the same case", file.where()});
    }
  }
}

/// Calls `frame` at the first `steps` steps.
template <int Dim>
void visit(const FieldsOfRun& file, const Particles<Dim>& particles, const std::vector<double>& times,
           const std::function<void(double, const Eigen::VectorXd&)>& frame) {
  std::array<int, Dim> variable;
  for (int a = 0; a < Dim; ++a) variable[static_cast<std::size_t>(a)] = file.displacement(a);
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
std::vector<double> even_times(std::vector<double> times, const FieldsOfRun& file) {
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
  const FieldsOfRun file(folder, where);
  require_particles(file, particles);
  visit<Dim>(file, particles, file.times(), frame);
}

template <int Dim>
WaveRecorder<Dim> record_run(const std::filesystem::path& folder, const Model& model,
                             const std::vector<Point<Dim>>& corners, const Where& where) {
  const Particles<Dim> particles = periodic_grid<Dim>(model, where);
  const FieldsOfRun file(folder, where);
  require_particles(file, particles);
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
