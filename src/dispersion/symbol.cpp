// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/dispersion/symbol.hpp"

#include <cmath>
#include <cstddef>

namespace perimode {
namespace {

double cell_volume(const Medium& medium, double spacing, int dimension) {
  return medium.continuum.section * std::pow(spacing, dimension);
}

}  // namespace

template <int Dim>
double calibration_factor(const Medium& medium, const Family<Dim>& family) {
  const double c0 = micromodulus_constant(medium);
  const double volume = cell_volume(medium, family.spacing, Dim);
  const std::vector<double> shape = kernel_shapes(medium.material.micromodulus, family);
  double energy = 0.0;
  for (std::size_t j = 0; j < shape.size(); ++j)
    energy += 0.25 * c0 * shape[j] * family.length[j] * family.weight[j] * volume;
  return dilation_energy(medium.material.youngs_modulus, medium.continuum) / energy;
}

template <int Dim>
std::vector<double> bond_rates(const Medium& medium, const Family<Dim>& family, Calibration calibration) {
  const double factor = calibration == Calibration::continuum ? 1.0 : calibration_factor<Dim>(medium, family);
  const double c0 = factor * micromodulus_constant(medium);
  const double volume_per_density = cell_volume(medium, family.spacing, Dim) / medium.material.density;
  std::vector<double> rates = kernel_shapes(medium.material.micromodulus, family);
  for (std::size_t j = 0; j < rates.size(); ++j)
    rates[j] *= c0 * family.weight[j] * volume_per_density / family.length[j];
  return rates;
}

template <int Dim>
Eigen::Matrix<double, Dim, Dim> lattice_symbol(const Family<Dim>& family, std::span<const double> rates,
                                               const Point<Dim>& k) {
  Eigen::Matrix<double, Dim, Dim> symbol = Eigen::Matrix<double, Dim, Dim>::Zero();
  const std::size_t pairs = family.offset.size() / 2;  // offset j and its negative give the same
  for (std::size_t j = 0; j < pairs; ++j) {
    Point<Dim> xi;
    for (int a = 0; a < Dim; ++a) xi[a] = family.spacing * family.offset[j][static_cast<std::size_t>(a)];
    const double s = std::sin(0.5 * k.dot(xi));
    const double factor = 4.0 * rates[j] * s * s / (family.length[j] * family.length[j]);
    symbol += factor * xi * xi.transpose();
  }
  return symbol;
}

template <int Dim>
Eigen::VectorXd plane_wave(std::span<const Point<Dim>> positions, const Point<Dim>& k,
                           const Point<Dim>& amplitude, double phase) {
  Eigen::VectorXd u(Dim * static_cast<Eigen::Index>(positions.size()));
  for (std::size_t i = 0; i < positions.size(); ++i) {
    u.template segment<Dim>(Dim * static_cast<Eigen::Index>(i)) =
        amplitude * std::cos(k.dot(positions[i]) + phase);
  }
  return u;
}

template double calibration_factor<1>(const Medium&, const Family<1>&);
template std::vector<double> bond_rates<1>(const Medium&, const Family<1>&, Calibration);
template Eigen::Matrix<double, 1, 1> lattice_symbol<1>(const Family<1>&, std::span<const double>,
                                                       const Point<1>&);
template Eigen::VectorXd plane_wave<1>(std::span<const Point<1>>, const Point<1>&, const Point<1>&, double);

template double calibration_factor<2>(const Medium&, const Family<2>&);
template std::vector<double> bond_rates<2>(const Medium&, const Family<2>&, Calibration);
template Eigen::Matrix<double, 2, 2> lattice_symbol<2>(const Family<2>&, std::span<const double>,
                                                       const Point<2>&);
template Eigen::VectorXd plane_wave<2>(std::span<const Point<2>>, const Point<2>&, const Point<2>&, double);

template double calibration_factor<3>(const Medium&, const Family<3>&);
template std::vector<double> bond_rates<3>(const Medium&, const Family<3>&, Calibration);
template Eigen::Matrix<double, 3, 3> lattice_symbol<3>(const Family<3>&, std::span<const double>,
                                                       const Point<3>&);
template Eigen::VectorXd plane_wave<3>(std::span<const Point<3>>, const Point<3>&, const Point<3>&, double);

}  // namespace perimode
