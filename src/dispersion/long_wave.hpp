// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "perimode/bonds/family.hpp"

namespace perimode {

/// Long waves along x run at the target speeds where constraints alpha = 1: the rows are
/// (1/2) sum over the orbit of rate n_x^2 xi_x^2 / c_P^2 and, in 2D and 3D, rate n_y^2 xi_x^2 / c_S^2.
/// Throws invalid_input where no alpha fulfils both: a family along the axes alone has no shear stiffness.
template <int Dim>
[[nodiscard]] Eigen::MatrixXd long_wave_constraints(const Family<Dim>& family,
                                                    const std::vector<double>& rates,
                                                    const std::array<double, 2>& speeds);

/// The alpha of largest least component that fulfils constraints alpha = 1 (non-negative rows, at most two,
/// independent), and that component: the linear programme max t, alpha = t + s, s >= 0, whose vertices have
/// one positive s at most per further constraint, so all of them are visited. Exact; cost O(orbits^2).
struct LargestBound {
  double bound = 0.0;
  Eigen::VectorXd alpha;
};
[[nodiscard]] LargestBound largest_bound(const Eigen::MatrixXd& constraints);

}  // namespace perimode
