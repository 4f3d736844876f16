// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "perimode/dispersion/lattice.hpp"

namespace perimode {

/// The plane waves of one wave vector: eigenpairs of the symbol M(k). Branch 0 is P, the wave whose
/// polarisation is most parallel to k (the faster where two are equally so; of a shared frequency the
/// combination nearest to k); the others, S, follow in ascending frequency. docs/theory/16_dispersion.md.
template <int Dim>
struct PlaneWaves {
  Point<Dim> k = Point<Dim>::Zero();               ///< rad/m
  std::array<double, Dim> squared = {};            ///< omega^2, 1/s2; negative: the lattice is unstable
  std::array<double, Dim> angular_frequency = {};  ///< omega, rad/s; NaN where omega^2 < 0 beyond
                                                   ///< round-off, and so are the velocities
  std::array<double, Dim> phase_velocity = {};     ///< omega/|k|, m/s; at k = 0 its limit along the direction
  std::array<Point<Dim>, Dim> group_velocity = {};  ///< grad omega, m/s; at k = 0 its limit likewise; 0
                                                    ///< where omega is
  Eigen::Matrix<double, Dim, Dim> polarisation;     ///< unit columns, one per branch
};

/// "P", "S" (2D), "S1", "S2" (3D).
[[nodiscard]] std::string branch_name(int branch, int dimension);

/// Waves at one wave vector. For |k| delta below 1e-6 the limits along k, or along `direction` (a unit
/// vector, used at k = 0 only), from the acoustic tensor (1/2) sum_j rate_j n_j n_j^T (xi_j . direction)^2.
/// The gradient is a^T dM/dk_c a / (2 omega), a the polarisation; where branches cross it is that of one of
/// their choices. Cost O(family).
template <int Dim>
[[nodiscard]] PlaneWaves<Dim> plane_waves(const Lattice<Dim>& lattice, const Point<Dim>& k,
                                          const Point<Dim>& direction);

/// A polygon through wave vectors, `points` of them spread over its length, corners included.
template <int Dim>
struct ZonePath {
  std::vector<Point<Dim>> k;  ///< rad/m
  std::vector<Point<Dim>>
      direction;               ///< unit tangent (of the side that begins at a corner; the last: that ends)
  std::vector<double> length;  ///< along the path, rad/m
  std::vector<int> corner;     ///< which points are the corners
};

/// `corners` in pi/spacing. Throws invalid_input: fewer than two corners, two equal ones in a row, fewer
/// points than corners.
template <int Dim>
[[nodiscard]] ZonePath<Dim> zone_path(const std::vector<Point<Dim>>& corners, double spacing, int points);

/// The contour of the irreducible Brillouin zone, in pi/spacing: O-X; O-M-Y-O [alebrahim2021]; in 3D
/// O-X-M-R-O, (0,0,0) (1,0,0) (1,1,0) (1,1,1) (0,0,0).
template <int Dim>
[[nodiscard]] std::vector<Point<Dim>> irreducible_contour();

/// plane_waves along a path, in parallel; the same for any number of threads. A path that ends at k = 0 takes
/// the limit from where it came.
template <int Dim>
[[nodiscard]] std::vector<PlaneWaves<Dim>> waves_along(const Lattice<Dim>& lattice,
                                                       const ZonePath<Dim>& path);

}  // namespace perimode
