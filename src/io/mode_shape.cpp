// SPDX-License-Identifier: BSD-3-Clause
#include "io/mode_shape.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "io/exodus_fields.hpp"

namespace perimode {

template <int Dim>
Eigen::VectorXd read_mode_shape(const ModeField& field, const Particles<Dim>& particles, const Where& where) {
  const ExodusFields modes(field.file,
                           {"modes", "modes", "name the modes.exo of a modal analysis of this body",
                            "compute the modes of the same body"},
                           where);
  modes.require(particles);
  if (field.mode > modes.steps()) {
    invalid_input({fmt::format("a mode from 1 to {}", modes.steps()), fmt::format("{}", field.mode),
                   "choose one of them, or compute more modes", where});
  }
  const std::vector<int> variable = modes.displacements(Dim);
  std::vector<double> u(particles.position.size());
  Eigen::VectorXd shape(static_cast<Eigen::Index>(u.size()) * Dim);
  for (int a = 0; a < Dim; ++a) {
    modes.values(variable[static_cast<std::size_t>(a)], field.mode, u);
    for (std::size_t i = 0; i < u.size(); ++i)
      shape[static_cast<Eigen::Index>(i) * Dim + a] = field.scale * u[i];
  }
  return shape;
}

template Eigen::VectorXd read_mode_shape<1>(const ModeField&, const Particles<1>&, const Where&);
template Eigen::VectorXd read_mode_shape<2>(const ModeField&, const Particles<2>&, const Where&);
template Eigen::VectorXd read_mode_shape<3>(const ModeField&, const Particles<3>&, const Where&);

}  // namespace perimode
