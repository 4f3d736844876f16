// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/assembly/critical_stretches.hpp"

#include <fmt/format.h>

#include <limits>

#include "perimode/material/critical_stretch.hpp"

namespace perimode {

template <int Dim>
double mean_horizon(const Body<Dim>& body, int block) {
  if (const auto* grid = std::get_if<GridBonds<Dim>>(&body.bonds)) return grid->family.horizon;
  double sum = 0.0;
  Offset ends = 0;
  for (Index i = 0; i < body.count(); ++i) {
    if (body.particles.block[i] != block) continue;
    for_each_bond(body.bonds, i, Which::present, [&](const BondEnd<Dim>& end) {
      sum += end.horizon;
      ++ends;
    });
  }
  return ends > 0 ? sum / static_cast<double>(ends) : 0.0;
}

template <int Dim>
std::vector<double> critical_stretches(const Model& model, const Body<Dim>& body) {
  const Continuum continuum{Dim, model.plane, body.section};
  std::vector<double> result;
  for (std::size_t block = 0; block < body.particles.block_names.size(); ++block) {
    const auto own = model.block_materials.find(body.particles.block_names[block]);
    const Material& m = own == model.block_materials.end() ? model.material : own->second;
    double s0 = std::numeric_limits<double>::infinity();
    if (m.critical_stretch) {
      s0 = *m.critical_stretch;
      if (!(s0 > 0.0)) {
        invalid_input(
            {"critical_stretch > 0", fmt::format("{}", s0), "leave it out: bonds do not break", m.where});
      }
    } else if (m.fracture_energy) {
      const double horizon = mean_horizon(body, static_cast<int>(block));
      try {
        if (horizon > 0.0)
          s0 = critical_stretch(m.micromodulus, m.youngs_modulus, *m.fracture_energy, horizon, continuum);
      } catch (const Error& error) {
        throw at(error, m.where);
      }
    }
    result.push_back(s0);
  }
  return result;
}

template double mean_horizon<1>(const Body<1>&, int);
template double mean_horizon<2>(const Body<2>&, int);
template double mean_horizon<3>(const Body<3>&, int);
template std::vector<double> critical_stretches<1>(const Model&, const Body<1>&);
template std::vector<double> critical_stretches<2>(const Model&, const Body<2>&);
template std::vector<double> critical_stretches<3>(const Model&, const Body<3>&);

}  // namespace perimode
