// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>

#include "perimode/assembly/body.hpp"

namespace perimode {

/// Dominant wave vector of a displacement of the free dofs on a grid, in units of pi/spacing (0: uniform
/// along the axis, 1: alternating): along x the strongest of the waves exp(i pi q x/(n spacing)), q = 0 .. n,
/// then along y in what goes with it, then z. Cost O(particles times cells along an axis).
template <int Dim>
[[nodiscard]] std::array<double, Dim> wave_vector(const Body<Dim>& body, const Eigen::VectorXd& q);

/// Throws invalid_input: the body's material is unstable, its motion q growing by exp(rate t) where lambda
/// (1/s^2, of K q = lambda M q) is negative or complex.
template <int Dim>
[[noreturn]] void refuse_instability(const Body<Dim>& body, const Eigen::VectorXd& q,
                                     std::complex<double> lambda);

}  // namespace perimode
