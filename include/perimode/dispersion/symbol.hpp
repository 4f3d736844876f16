// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "perimode/bonds/family.hpp"
#include "perimode/core/types.hpp"
#include "perimode/dispersion/medium.hpp"

namespace perimode {

/// What the `discrete` calibrations multiply c0 by, for a complete family:
/// dilation_energy / ((1/4) sum_j c(r_j) r_j beta_j V), V = section spacing^Dim.
template <int Dim>
[[nodiscard]] double calibration_factor(const Medium& medium, const Family<Dim>& family);

/// c(r_j) beta_j V / (rho r_j), 1/s2, for every offset of the family: bond stiffness over particle mass.
template <int Dim>
[[nodiscard]] std::vector<double> bond_rates(const Medium& medium, const Family<Dim>& family,
                                             Calibration calibration = Calibration::continuum);

/// The symbol of the lattice, M(k) = sum_j rate_j n_j n_j^T (1 - cos k.xi_j), 1/s2: symmetric, 0 at
/// k = 0, positive semidefinite where no rate is negative. A plane wave u = a cos(k.x + phase) is an
/// eigenvector of the lattice with omega^2 and a an eigenpair of M(k). `rates` as from bond_rates. Cost
/// O(family).
template <int Dim>
[[nodiscard]] Eigen::Matrix<double, Dim, Dim> lattice_symbol(const Family<Dim>& family,
                                                             std::span<const double> rates,
                                                             const Point<Dim>& k);

/// amplitude cos(k.x_i + phase) for all positions, point-major (x0 y0 z0 x1 ...): an exact eigenvector of a
/// periodic lattice if k is one of its wave vectors and amplitude an eigenvector of its symbol.
template <int Dim>
[[nodiscard]] Eigen::VectorXd plane_wave(std::span<const Point<Dim>> positions, const Point<Dim>& k,
                                         const Point<Dim>& amplitude, double phase);

}  // namespace perimode
