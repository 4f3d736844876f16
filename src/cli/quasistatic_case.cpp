// SPDX-License-Identifier: BSD-3-Clause
#include "quasistatic_case.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "perimode/assembly/critical_stretches.hpp"
#include "perimode/fracture/crack_area.hpp"

namespace perimode::cli {

template <int Dim>
QuasistaticOptions quasistatic_options(const Case& input, const Body<Dim>& body) {
  if (input.kinematics != Kinematics::linear) {
    invalid_input({"kinematics: linear for a quasi-static analysis", "large_rotation",
                   "leave it out: crack growth is that of the linearised body", input.quasistatic_where});
  }
  if (!input.model.precracks.empty() && body.cut == 0) {
    invalid_input(
        {"a pre-crack that cuts bonds",
         input.model.precracks.size() == 1 ? "one that crosses none"
                                           : fmt::format("{} that cross none", input.model.precracks.size()),
         "move it between particles that are bonded, or remove it", input.model.precracks.front().where});
  }
  QuasistaticOptions options = *input.quasistatic;
  const std::vector<double>& given = body.boundary.given;
  const bool moved = std::any_of(given.begin(), given.end(), [](double g) { return g != 0.0; });
  if (options.griffith && !options.loads.empty() && moved) {
    invalid_input({"loads or prescribed motion alone for the Griffith load", "both",
                   "leave one of them out, or set analysis.quasistatic.griffith to false", options.where});
  }
  options.critical_stretch = critical_stretches(input.model, body);
  options.area = crack_area_scale(input.model, body);
  return options;
}

template QuasistaticOptions quasistatic_options<1>(const Case&, const Body<1>&);
template QuasistaticOptions quasistatic_options<2>(const Case&, const Body<2>&);
template QuasistaticOptions quasistatic_options<3>(const Case&, const Body<3>&);

}  // namespace perimode::cli
