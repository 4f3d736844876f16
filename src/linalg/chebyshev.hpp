// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "perimode/linalg/operator.hpp"
#include "spectral_transform.hpp"

namespace perimode {

/// An upper bound of the eigenvalues of M^-1 K, K symmetric: the largest Ritz value of `steps` Lanczos steps
/// plus the residual they leave, which holds for all but starting vectors of vanishing probability
/// [zhou_li2011]. Cost: `steps` products.
[[nodiscard]] double spectrum_top(const LinearOperator& stiffness, const Eigen::VectorXd& mass,
                                  std::uint64_t seed, int steps = 24);

/// Op = (T_d(z(A)) + 1) / (T_d(z(0)) + 1), z(lambda) = (top + edge - 2 lambda) / (top - edge), T_d the
/// Chebyshev polynomial: eigenvalues of A in [edge, top] go to [0, 2 / (T_d(z(0)) + 1)], those below grow
/// towards 1 at lambda = 0. `degree` products per column. `stiffness` has to outlive it.
/// @pre 0 < edge < top, no eigenvalue above top.
[[nodiscard]] SpectralTransform chebyshev_filter(const LinearOperator& stiffness, const Eigen::VectorXd& mass,
                                                 double edge, double top, int degree);

/// The degree that lifts lambda = 0 about 40 times above the spectrum beyond the edge.
[[nodiscard]] int filter_degree(double edge, double top);

}  // namespace perimode
