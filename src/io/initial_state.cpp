// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/io/initial_state.hpp"

#include <fmt/format.h>

#include <string>

#include "io/mode_shape.hpp"
#include "io/number_table.hpp"

namespace perimode {

namespace {

/// Values of an initial field over all dofs of the particles, point-major; empty: zero.
template <int Dim>
struct Evaluate {
  const Particles<Dim>& particles;
  const Where& where;

  Eigen::VectorXd operator()(std::monostate) const { return {}; }

  Eigen::VectorXd operator()(const FormulaField& field) const {
    if (field.component.size() != Dim) {
      invalid_input({fmt::format("{} formulas, one per component", Dim),
                     fmt::format("{}", field.component.size()), "give one for each axis of the body", where});
    }
    Eigen::VectorXd values(size());
    for (std::size_t i = 0; i < particles.position.size(); ++i) {
      const Point<Dim>& p = particles.position[i];
      const double y = Dim > 1 ? p[Dim > 1 ? 1 : 0] : 0.0;
      const double z = Dim > 2 ? p[Dim - 1] : 0.0;
      for (std::size_t a = 0; a < Dim; ++a)
        values[static_cast<Eigen::Index>(i * Dim + a)] = field.component[a](p[0], y, z);
    }
    return values;
  }

  Eigen::VectorXd operator()(const TableField& field) const {
    const NumberTable table = read_number_table(field.file, {std::string("x,y,z").substr(0, 2 * Dim - 1)});
    if (table.rows() != particles.position.size()) {
      invalid_input({fmt::format("{} lines of numbers, one per particle", particles.position.size()),
                     fmt::format("{}", table.rows()),
                     "give the components of every particle, in their order",
                     {field.file.string(), table.line.back(), 1}});
    }
    Eigen::VectorXd values(size());
    for (std::size_t i = 0; i < table.rows(); ++i) {
      for (std::size_t a = 0; a < Dim; ++a)
        values[static_cast<Eigen::Index>(i * Dim + a)] = table.column[a][i];
    }
    return values;
  }

  Eigen::VectorXd operator()(const ModeField& field) const {
    return read_mode_shape(field, particles, where);
  }

  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(particles.count()) * Dim; }
};

}  // namespace

template <int Dim>
InitialState initial_state(const InitialSpec& spec, const Particles<Dim>& particles) {
  const Evaluate<Dim> values{particles, spec.where};
  return {std::visit(values, spec.displacement), std::visit(values, spec.velocity)};
}

template InitialState initial_state<1>(const InitialSpec&, const Particles<1>&);
template InitialState initial_state<2>(const InitialSpec&, const Particles<2>&);
template InitialState initial_state<3>(const InitialSpec&, const Particles<3>&);

}  // namespace perimode
