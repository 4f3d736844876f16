// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <functional>

#include "dense_kernels.hpp"
#include "perimode/core/types.hpp"

namespace perimode {

/// A symmetric Op with the eigenvectors y = M^1/2 x of A = M^-1/2 K M^-1/2, whose eigenvalues theta of
/// largest magnitude belong to the eigenvalues of A that are looked for: the shift and invert M^1/2 (K -
/// sigma M)^-1 M^1/2 or a polynomial in A.
struct SpectralTransform {
  Eigen::Index rows = 0;
  double sigma = 0.0;    ///< nearness is counted from here
  bool positive = true;  ///< no theta is negative
  /// What a product adds to a residual at least, relative to the largest theta.
  double round_off = 5e-15;
  /// No eigenvalue of A lies above; 0: Op damps what is rough, so that it cannot stand out in |K x - lambda M
  /// x|.
  double top = 0.0;
  std::function<Eigen::MatrixXd(const MatrixView&)> image;  ///< Op Y
  std::function<double(double theta)> to_eigenvalue;        ///< lambda
  std::function<double(double theta)> slope;                ///< |d theta / d lambda|
  Offset applied = 0;                                       ///< columns so far

  [[nodiscard]] Eigen::Index size() const { return rows; }
  [[nodiscard]] Eigen::MatrixXd apply(const MatrixView& y) {
    applied += y.cols();
    return image(y);
  }
  [[nodiscard]] double eigenvalue(double theta) const { return to_eigenvalue(theta); }
  [[nodiscard]] double distance(double theta) const { return std::abs(to_eigenvalue(theta) - sigma); }
};

/// theta = 1 / (lambda - sigma); `solve` is (K - sigma M)^-1.
[[nodiscard]] inline SpectralTransform shift_invert(double sigma, bool positive, Eigen::VectorXd root_mass,
                                                    std::function<Eigen::MatrixXd(const MatrixView&)> solve) {
  SpectralTransform op;
  op.rows = root_mass.size();
  op.sigma = sigma;
  op.positive = positive;
  op.image = [root = std::move(root_mass), solve = std::move(solve)](const MatrixView& y) -> Eigen::MatrixXd {
    return root.asDiagonal() * solve(root.asDiagonal() * y);
  };
  op.to_eigenvalue = [sigma](double theta) { return sigma + 1.0 / theta; };
  op.slope = [](double theta) { return theta * theta; };
  return op;
}

}  // namespace perimode
