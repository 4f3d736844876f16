// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>

#include "dense_kernels.hpp"

namespace perimode {

/// Op = M^1/2 (K - sigma M)^-1 M^1/2: symmetric, eigenvalues theta = 1 / (lambda - sigma), the same
/// eigenvectors y = M^1/2 x as M^-1/2 K M^-1/2.
struct ShiftInvert {
  double sigma = 0.0;
  bool positive = true;                                     ///< K - sigma M is positive definite
  Eigen::VectorXd root_mass;                                ///< M^1/2
  std::function<Eigen::MatrixXd(const MatrixView&)> solve;  ///< (K - sigma M)^-1
  int solves = 0;                                           ///< right-hand sides so far

  [[nodiscard]] Eigen::Index size() const { return root_mass.size(); }
  [[nodiscard]] Eigen::MatrixXd apply(const MatrixView& y) {
    solves += static_cast<int>(y.cols());
    Eigen::MatrixXd x = solve(root_mass.asDiagonal() * y);
    return root_mass.asDiagonal() * x;
  }
  [[nodiscard]] double eigenvalue(double theta) const { return sigma + 1.0 / theta; }
  [[nodiscard]] double theta(double eigenvalue) const { return 1.0 / (eigenvalue - sigma); }
};

}  // namespace perimode
