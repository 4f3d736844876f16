// SPDX-License-Identifier: BSD-3-Clause
#include "io/mode_shape.hpp"

#include <exodusII.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace perimode {

namespace {

constexpr std::size_t longest_name = 255;

/// A file of a modal analysis, open for reading.
class ModesFile {
 public:
  ModesFile(const std::filesystem::path& file, const Where& where) : file_(file), where_(where) {
    ex_opts(EX_DEFAULT);  // report errors by code, print nothing
    int word = sizeof(double);
    int stored = 0;
    float version = 0.0F;
    id_ = ex_open(file.c_str(), EX_READ, &word, &stored, &version);
    check(id_);
  }
  ~ModesFile() {
    if (id_ >= 0) (void)ex_close(id_);
  }
  ModesFile(const ModesFile&) = delete;
  ModesFile& operator=(const ModesFile&) = delete;
  ModesFile(ModesFile&&) = delete;
  ModesFile& operator=(ModesFile&&) = delete;

  [[nodiscard]] std::int64_t nodes() const {
    ex_init_params init = {};
    check(ex_get_init_ext(id_, &init));
    return init.num_nodes;
  }

  [[nodiscard]] std::array<std::vector<double>, 3> places(std::int64_t nodes) const {
    std::array<std::vector<double>, 3> x;
    for (auto& component : x) component.assign(static_cast<std::size_t>(nodes), 0.0);
    check(ex_get_coord(id_, x[0].data(), x[1].data(), x[2].data()));
    return x;
  }

  [[nodiscard]] std::int64_t steps() const { return ex_inquire_int(id_, EX_INQ_TIME); }

  /// Values of a nodal variable at a step, from 1.
  [[nodiscard]] std::vector<double> values(const std::string& name, int step, std::int64_t nodes) const {
    const int number = number_of(name);
    std::vector<double> result(static_cast<std::size_t>(nodes));
    check(ex_get_var(id_, step, EX_NODAL, number, 1, nodes, result.data()));
    return result;
  }

 private:
  [[nodiscard]] int number_of(const std::string& name) const {
    int count = 0;
    check(ex_get_variable_param(id_, EX_NODAL, &count));
    check(ex_set_max_name_length(id_, longest_name));
    std::array<char, longest_name + 1> text = {};
    for (int k = 1; k <= count; ++k) {
      check(ex_get_variable_name(id_, EX_NODAL, k, text.data()));
      if (name == text.data()) return k;
    }
    invalid_input({fmt::format("modes in {}", file_.string()), fmt::format("no variable {}", name),
                   "name the modes.exo of a modal analysis of this body", where_});
  }

  void check(int code) const {
    if (code >= 0) return;
    invalid_input({fmt::format("an Exodus file that can be read ({})", file_.string()),
                   fmt::format("error {}", code), "name the modes.exo of a modal analysis", where_});
  }

  std::filesystem::path file_;
  Where where_;
  int id_ = -1;
};

/// Extent of the particles' places along the longest axis, m.
template <int Dim>
double extent(const Particles<Dim>& particles) {
  Point<Dim> lower = particles.position[0];
  Point<Dim> upper = lower;
  for (const Point<Dim>& point : particles.position) {
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  }
  return (upper - lower).maxCoeff();
}

}  // namespace

template <int Dim>
Eigen::VectorXd read_mode_shape(const ModeField& field, const Particles<Dim>& particles, const Where& where) {
  const ModesFile modes(field.file, where);
  const std::int64_t n = modes.nodes();
  if (n != particles.count()) {
    invalid_input({fmt::format("modes of the {} particles of this body", particles.count()),
                   fmt::format("{} particles in {}", n, field.file.string()),
                   "compute the modes of the same body", where});
  }
  const std::array<std::vector<double>, 3> place = modes.places(n);
  const double close = 1e-9 * extent(particles);
  for (std::size_t i = 0; i < particles.position.size(); ++i) {
    for (int a = 0; a < Dim; ++a) {
      const double x = place[static_cast<std::size_t>(a)][i];
      if (std::abs(x - particles.position[i][a]) <= close) continue;
      invalid_input({fmt::format("modes of this body, whose particle {} has {} = {:.17g} m", i + 1, "xyz"[a],
                                 particles.position[i][a]),
                     fmt::format("{:.17g} m in {}", x, field.file.string()),
                     "compute the modes of the same body", where});
    }
  }
  if (field.mode > modes.steps()) {
    invalid_input({fmt::format("a mode from 1 to {}", modes.steps()), fmt::format("{}", field.mode),
                   "choose one of them, or compute more modes", where});
  }
  Eigen::VectorXd shape(static_cast<Eigen::Index>(n) * Dim);
  for (int a = 0; a < Dim; ++a) {
    const std::vector<double> u = modes.values(std::string("displacement_") + "xyz"[a], field.mode, n);
    for (std::int64_t i = 0; i < n; ++i) shape[i * Dim + a] = field.scale * u[static_cast<std::size_t>(i)];
  }
  return shape;
}

template Eigen::VectorXd read_mode_shape<1>(const ModeField&, const Particles<1>&, const Where&);
template Eigen::VectorXd read_mode_shape<2>(const ModeField&, const Particles<2>&, const Where&);
template Eigen::VectorXd read_mode_shape<3>(const ModeField&, const Particles<3>&, const Where&);

}  // namespace perimode
