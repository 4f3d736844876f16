// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "perimode/bonds/family.hpp"
#include "perimode/core/types.hpp"
#include "perimode/material/material.hpp"
#include "perimode/material/micromodulus.hpp"

namespace perimode {

/// A homogeneous peridynamic medium without boundaries.
struct Medium {
  Material material = {};
  Continuum continuum = {};
  double horizon = 0.0;  ///< delta, m
};

/// Polarisation of a plane wave: along the wave vector or across it (2D, 3D).
enum class Branch { pressure, shear };

/// Speed of classical elastic waves, m/s, at the Poisson's ratio the theory fixes: 1D sqrt(E/rho); plane
/// stress sqrt(9E/8rho), sqrt(3E/8rho); plane strain and 3D sqrt(6E/5rho), sqrt(2E/5rho).
/// Throws invalid_input for a shear wave in 1D.
[[nodiscard]] double classical_speed(const Medium& medium, Branch branch);

/// Angular frequency (rad/s) of a plane wave of wave number k (rad/m) in the peridynamic continuum,
///   omega^2 = (1/rho) int c(r)/r <w(n) (1 - cos(k r n.e))> dV,  e = k/|k|,
/// w = (n.e)^2 for pressure, (1 - (n.e)^2)/(Dim - 1) for shear (docs/theory/05_closed_forms.md eq. (7), (8)).
/// Relative error < 1e-13; cost O((1 + k delta)^2) evaluations. Throws invalid_input for a shear wave in 1D.
[[nodiscard]] double continuum_frequency(const Medium& medium, Branch branch, double k);

/// What the `discrete` calibrations multiply c0 by, for a complete family:
/// dilation_energy / ((1/4) sum_j c(r_j) r_j beta_j V), V = section spacing^Dim.
template <int Dim>
[[nodiscard]] double calibration_factor(const Medium& medium, const Family<Dim>& family);

/// c(r_j) beta_j V / (rho r_j), 1/s2, for every offset of the family: bond stiffness over particle mass.
template <int Dim>
[[nodiscard]] std::vector<double> bond_rates(const Medium& medium, const Family<Dim>& family,
                                             Calibration calibration = Calibration::continuum);

/// The symbol of the lattice, M(k) = sum_j rate_j n_j n_j^T (1 - cos k.xi_j), 1/s2: symmetric, positive
/// semidefinite, 0 at k = 0. A plane wave u = a cos(k.x + phase) is an eigenvector of the lattice with
/// omega^2 and a an eigenpair of M(k). `rates` as from bond_rates. Cost O(family).
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
