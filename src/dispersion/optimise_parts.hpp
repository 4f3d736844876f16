// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dispersion/sampled_errors.hpp"
#include "perimode/dispersion/optimise.hpp"

namespace perimode {

/// min int e |omega^2 - c^2 k^2| dk over the sampled branches, subject to constraints alpha = 1 and alpha >=
/// lower (-infinity: none). The dual programme is solved, which has a row per orbit only:
///   max -targets . y + sum mu + lower sum z,  values^T y - constraints^T mu - z = 0,  |y| <= e measure, z >=
///   0;
/// its prices are alpha, moved to the nearest feasible point from `feasible`, one such point. Fills alpha,
/// active, solver and optimality = (primal - dual)/primal. Throws as solve_linear_programme.
[[nodiscard]] OptimisedMicromodulus least_absolute_error(const SampledErrors& samples,
                                                         const Eigen::MatrixXd& constraints, double lower,
                                                         const Eigen::VectorXd& feasible);

/// Point and sub-domain collocation and Galerkin's method of a bar with n orbits: constraints alpha = 1 and
/// n - 1 equations, with K(k) = omega^2/alpha of the orbits, k in 1/spacing:
///   points: K(k_m) alpha = k_m^2, k_m = m pi/(n - 1), m = 1..n-1;
///   sub-domains: int (K alpha - k^2) dk = 0 over [k_(m-1), k_m];
///   Galerkin: int_0^pi K_j (K alpha - k^2) dk = 0, j = 1..n-1 (the last function is left out).
/// Fills alpha, solver and optimality. [alebrahim2021] eqs. (40), (42), (46) without absolute values.
[[nodiscard]] OptimisedMicromodulus weighted_residuals(const Family<1>& family,
                                                       const std::vector<double>& rates,
                                                       const Eigen::MatrixXd& constraints,
                                                       OptimiseMethod method);

}  // namespace perimode
