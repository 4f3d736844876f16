// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>

namespace perimode {

/// Eigenpairs of a real unsymmetric operator, largest magnitude first; complex ones in conjugate
/// pairs, unit length.
struct ArnoldiPairs {
  Eigen::VectorXcd theta;
  Eigen::MatrixXcd vector;
};

/// Which eigenvalues are looked for: of largest magnitude, or of largest imaginary part (in magnitude).
enum class ArnoldiTarget { magnitude, imaginary_part };

/// At least `count` eigenpairs by implicitly restarted Arnoldi (ARPACK); tolerance 0: machine precision.
/// Empty if it does not converge within most_restarts. Throws Error(solver_failure).
[[nodiscard]] ArnoldiPairs arnoldi(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& apply,
                                   Eigen::Index n, int count, double tolerance, std::uint64_t seed,
                                   ArnoldiTarget target = ArnoldiTarget::magnitude, int most_restarts = 1000);

}  // namespace perimode
