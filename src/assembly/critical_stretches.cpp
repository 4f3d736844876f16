// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/assembly/critical_stretches.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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

namespace {

template <int Dim>
bool some_negative(const Body<Dim>& body, int block) {
  const BondConstants& constants = body.constants;
  const auto below_zero = [](double c) { return c < 0.0; };
  if (constants.kernel.empty())
    return std::any_of(constants.kernel_of_end.begin(), constants.kernel_of_end.end(), below_zero);
  const auto first = constants.kernel.begin() + static_cast<std::ptrdiff_t>(block) * constants.family_size;
  return std::any_of(first, first + constants.family_size, below_zero);
}

}  // namespace

template <int Dim>
double fracture_energy_at(const Material& m, const Body<Dim>& body, int block, double critical_stretch,
                          const Continuum& continuum) {
  if (m.micromodulus.kernel == Kernel::shells) {
    return lattice_fracture_energy(m.micromodulus, m.youngs_modulus, critical_stretch,
                                   std::get<GridBonds<Dim>>(body.bonds).family, continuum);
  }
  return fracture_energy(m.micromodulus, m.youngs_modulus, critical_stretch, mean_horizon(body, block),
                         continuum);
}

template <int Dim>
bool negative_bonds_may_break(const Body<Dim>& body, const std::vector<double>& stretches) {
  for (std::size_t block = 0; block < stretches.size(); ++block)
    if (std::isfinite(stretches[block]) && some_negative(body, static_cast<int>(block))) return true;
  return false;
}

std::string warning_of_negative_breaks() {
  return "bonds of negative micromodulus may break (break_negative): a bond takes its energy with it when it "
         "breaks, so the body gains energy wherever one of these does; look at the energy balance, and "
         "compare "
         "with a kernel without negative parts";
}

template <int Dim>
std::vector<double> critical_stretches(const Model& model, const Body<Dim>& body) {
  const Continuum continuum{Dim, model.plane, body.section};
  std::vector<double> result;
  for (std::size_t block = 0; block < body.particles.block_names.size(); ++block) {
    const auto own = model.block_materials.find(body.particles.block_names[block]);
    const Material& m = own == model.block_materials.end() ? model.material : own->second;
    if ((m.critical_stretch || m.fracture_energy) && !m.break_negative &&
        some_negative(body, static_cast<int>(block))) {
      invalid_input(
          {"a micromodulus without negative parts in a material that breaks",
           "bonds of negative stiffness: one that breaks takes negative energy out, so the body gains "
           "energy",
           "leave out fracture_energy and critical_stretch, optimise with bounds of 0, or set "
           "break_negative: true to run all the same",
           m.where});
    }
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
          s0 = stretch_of(*m.fracture_energy,
                          fracture_energy_at(m, body, static_cast<int>(block), 1.0, continuum));
      } catch (const Error& error) {
        throw at(error, m.where);
      }
    }
    result.push_back(s0);
  }
  return result;
}

template double fracture_energy_at<1>(const Material&, const Body<1>&, int, double, const Continuum&);
template double fracture_energy_at<2>(const Material&, const Body<2>&, int, double, const Continuum&);
template double fracture_energy_at<3>(const Material&, const Body<3>&, int, double, const Continuum&);
template bool negative_bonds_may_break<1>(const Body<1>&, const std::vector<double>&);
template bool negative_bonds_may_break<2>(const Body<2>&, const std::vector<double>&);
template bool negative_bonds_may_break<3>(const Body<3>&, const std::vector<double>&);
template double mean_horizon<1>(const Body<1>&, int);
template double mean_horizon<2>(const Body<2>&, int);
template double mean_horizon<3>(const Body<3>&, int);
template std::vector<double> critical_stretches<1>(const Model&, const Body<1>&);
template std::vector<double> critical_stretches<2>(const Model&, const Body<2>&);
template std::vector<double> critical_stretches<3>(const Model&, const Body<3>&);

}  // namespace perimode
