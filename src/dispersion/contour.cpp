// SPDX-License-Identifier: BSD-3-Clause
#include "dispersion/contour.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "perimode/dispersion/symbol.hpp"

namespace perimode {

template <>
std::vector<ContourBranch<1>> contour_branches<1>() {
  return {{{0}, {1}, Point<1>(1.0), Branch::pressure, 1}};
}

template <>
std::vector<ContourBranch<2>> contour_branches<2>() {
  const double h = std::numbers::sqrt2 / 2.0;
  const Point<2> x(1.0, 0.0), y(0.0, 1.0), along(h, h), across(h, -h);
  return {{{0, 0}, {1, 0}, x, Branch::pressure, 1},       {{0, 0}, {1, 0}, y, Branch::shear, 1},
          {{1, 0}, {0, 1}, x, Branch::pressure, 1},       {{1, 0}, {0, 1}, y, Branch::shear, 1},
          {{1, 1}, {-1, -1}, along, Branch::pressure, 1}, {{1, 1}, {-1, -1}, across, Branch::shear, 1}};
}

template <>
std::vector<ContourBranch<3>> contour_branches<3>() {
  const double h = std::numbers::sqrt2 / 2.0, t = std::numbers::sqrt3 / 3.0;
  const Point<3> x(1.0, 0.0, 0.0), y(0.0, 1.0, 0.0), z(0.0, 0.0, 1.0);
  const Point<3> in_plane(h, h, 0.0), across(h, -h, 0.0), space(t, t, t);
  return {{{0, 0, 0}, {1, 0, 0}, x, Branch::pressure, 1},         // O-X
          {{0, 0, 0}, {1, 0, 0}, y, Branch::shear, 2},            //
          {{1, 0, 0}, {0, 1, 0}, x, Branch::pressure, 1},         // X-M
          {{1, 0, 0}, {0, 1, 0}, y, Branch::shear, 1},            //
          {{1, 0, 0}, {0, 1, 0}, z, Branch::shear, 1},            //
          {{1, 1, 0}, {0, 0, 1}, in_plane, Branch::pressure, 1},  // M-R
          {{1, 1, 0}, {0, 0, 1}, across, Branch::shear, 1},       //
          {{1, 1, 0}, {0, 0, 1}, z, Branch::shear, 1},            //
          {{1, 1, 1}, {-1, -1, -1}, space, Branch::pressure, 1},  // R-O
          {{1, 1, 1}, {-1, -1, -1}, across, Branch::shear, 2}};
}

template <int Dim>
Point<Dim> contour_point(const ContourBranch<Dim>& side, double s) {
  Point<Dim> k;
  for (int a = 0; a < Dim; ++a) {
    const auto i = static_cast<std::size_t>(a);
    k[a] = std::numbers::pi * side.start[i] + s * side.step[i];
  }
  return k;
}

template <int Dim>
double step_length(const ContourBranch<Dim>& side) {
  int squared = 0;
  for (const int component : side.step) squared += component * component;
  return std::sqrt(static_cast<double>(squared));
}

std::array<double, 2> target_speeds(const Continuum& continuum, const std::optional<double>& poissons_ratio) {
  const double nu = poissons_ratio.value_or(perimode::poissons_ratio(continuum));
  if (continuum.dimension == 1) {
    if (poissons_ratio) {
      invalid_input({"no Poisson's ratio in one dimension", fmt::format("{}", nu),
                     "leave it out: a bar has the speed sqrt(E/rho)"});
    }
    return {1.0, 0.0};
  }
  if (!(nu > -1.0 && nu < 0.5)) {
    invalid_input({"a Poisson's ratio between -1 and 0.5", fmt::format("{}", nu),
                   "leave it out for that of the theory"});
  }
  const bool plane_stress = continuum.dimension == 2 && continuum.plane == Plane::stress;
  const double pressure = plane_stress ? 1.0 / (1.0 - nu * nu) : (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
  return {pressure, 0.5 / (1.0 + nu)};
}

template <int Dim>
std::vector<double> unit_rates(const Lattice<Dim>& lattice) {
  const Material& material = lattice.medium.material;
  const double unit =
      material.density * lattice.family.spacing * lattice.family.spacing / material.youngs_modulus;
  std::vector<double> rates = lattice.rates;
  for (double& rate : rates) rate *= unit;
  return rates;
}

template <int Dim>
std::vector<double> constant_rates(const Lattice<Dim>& lattice) {
  Lattice<Dim> constant = lattice;
  constant.medium.material.micromodulus = {};
  constant.rates = bond_rates(constant.medium, constant.family);
  return unit_rates(constant);
}

void require_weights(const std::array<double, 2>& weights, int dimension) {
  const bool valid = weights[0] >= 0.0 && weights[1] >= 0.0 && std::isfinite(weights[0]) &&
                     std::isfinite(weights[1]) && weights[0] + (dimension > 1 ? weights[1] : 0.0) > 0.0;
  if (!valid) {
    invalid_input({"weights of the branches P and S that are not negative and not all 0",
                   fmt::format("[{}, {}]", weights[0], weights[1]), "take [1, 1]"});
  }
}

template Point<1> contour_point<1>(const ContourBranch<1>&, double);
template double step_length<1>(const ContourBranch<1>&);
template std::vector<double> unit_rates<1>(const Lattice<1>&);
template std::vector<double> constant_rates<1>(const Lattice<1>&);
template Point<2> contour_point<2>(const ContourBranch<2>&, double);
template double step_length<2>(const ContourBranch<2>&);
template std::vector<double> unit_rates<2>(const Lattice<2>&);
template std::vector<double> constant_rates<2>(const Lattice<2>&);
template Point<3> contour_point<3>(const ContourBranch<3>&, double);
template double step_length<3>(const ContourBranch<3>&);
template std::vector<double> unit_rates<3>(const Lattice<3>&);
template std::vector<double> constant_rates<3>(const Lattice<3>&);

}  // namespace perimode
