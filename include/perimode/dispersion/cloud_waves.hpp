// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "perimode/assembly/body.hpp"
#include "perimode/dispersion/waves.hpp"

namespace perimode {

/// Plane waves u_i = a exp(i k.x_i) on a cloud that repeats itself along every axis. They are no
/// eigenvectors, so what they have is Rayleigh quotients (docs/theory/19_clouds.md).
template <int Dim>
struct CloudWaves {
  /// Eigenpairs of the mean symbol M(k) = sum_i m_i M_i(k) / sum_i m_i,
  ///   M_i(k) = (1/m_i) sum_j k_ij (1 - cos k.xi_ij) n n^T:
  /// `squared` is u^H K u / u^H M u, the mean of the omega^2 of the modes that make up the wave.
  PlaneWaves<Dim> waves;
  /// Standard deviation over the particles (weighted with their masses) of a^T M_i a, over 2 omega: how much
  /// the local frequency varies, to first order, rad/s; 0 at k = 0, of no meaning where omega
  /// is 0 or NaN.
  std::array<double, Dim> spread = {};
  /// |(M^-1 K - omega^2) u|_M / |u|_M, 1/s2: the cloud has an eigenfrequency whose square lies so close to
  /// `squared`, and it is the standard deviation of omega^2 over the modes that make up the wave. 0 at k = 0.
  std::array<double, Dim> residual = {};
};

/// Rayleigh quotients of plane waves on a body with a cloud, every k (rad/m) on its own; alive bonds count,
/// conditions of the boundary do not. Any k makes sense on the endless cloud; on the body of one period the
/// wave exists where k is one of period_wave_vectors. At k = 0 (|k| times the longest bond below 1e-6) the
/// speeds are the limits along `direction` (a unit vector). Polarisations, branches and speeds as in
/// plane_waves. The same bits for any number of threads. Throws invalid_input: a grid, a cloud that is not
/// periodic along every axis (its surface would take part), a direction that is no unit vector.
/// Cost O(bond ends) per k, in parallel.
template <int Dim>
[[nodiscard]] std::vector<CloudWaves<Dim>> cloud_waves(const Body<Dim>& body, std::span<const Point<Dim>> k,
                                                       const Point<Dim>& direction);

/// The wave vectors s `direction` (a unit vector), 0 < s <= longest (rad/m), with a whole number of waves in
/// the period of a cloud along every axis (k_a P_a = 2 pi q_a), ascending: multiples of the first. Throws
/// invalid_input: as cloud_waves, or where there is none, as along a direction the periods do not admit.
/// Cost O(longest period).
template <int Dim>
[[nodiscard]] std::vector<Point<Dim>> period_wave_vectors(const Body<Dim>& body, const Point<Dim>& direction,
                                                          double longest);

}  // namespace perimode
