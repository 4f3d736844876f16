// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/quadrature.hpp"
#include "dispersion/optimise_parts.hpp"

namespace perimode {
namespace {

using std::numbers::pi;

/// int f(k) (K(k), k^2) dk, a row of n + 1 numbers.
template <class Function>
Eigen::RowVectorXd integral(const Family<1>& family, const std::vector<double>& rates, double lower,
                            double upper, Function f) {
  const auto n = static_cast<Eigen::Index>(family.shell.size());
  const int panels = 1 + static_cast<int>((upper - lower) * static_cast<double>(n) / 2.0);
  const double half = 0.5 * (upper - lower) / panels;
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(n + 1);
  for (int panel = 0; panel < panels; ++panel) {
    for (const QuadratureNode& node : gauss_legendre()) {
      const double k = lower + (2 * panel + 1 + node.x) * half;
      const Eigen::VectorXd values = orbit_squares<1>(family, rates, Point<1>(k), Point<1>(1.0));
      const double scale = half * node.weight * f(values);
      sum.head(n) += scale * values.transpose();
      sum[n] += scale * k * k;
    }
  }
  return sum;
}

}  // namespace

OptimisedMicromodulus weighted_residuals(const Family<1>& family, const std::vector<double>& rates,
                                         const Eigen::MatrixXd& constraints, OptimiseMethod method) {
  const auto n = static_cast<Eigen::Index>(family.shell.size());
  Eigen::MatrixXd equations(n, n + 1);
  equations.row(0) << constraints.row(0), 1.0;
  for (Eigen::Index m = 1; m < n; ++m) {
    const double step = pi / static_cast<double>(n - 1), k = step * static_cast<double>(m);
    switch (method) {
      case OptimiseMethod::point_collocation:
        equations.row(m) << orbit_squares<1>(family, rates, Point<1>(k), Point<1>(1.0)).transpose(), k * k;
        break;
      case OptimiseMethod::subdomain_collocation:
        equations.row(m) =
            integral(family, rates, k - step, k, [](const Eigen::VectorXd& /*values*/) { return 1.0; });
        break;
      case OptimiseMethod::galerkin:
      case OptimiseMethod::least_squares:
        equations.row(m) =
            integral(family, rates, 0.0, pi, [m](const Eigen::VectorXd& values) { return values[m - 1]; });
        break;
    }
  }
  const Eigen::MatrixXd matrix = equations.leftCols(n);
  const Eigen::VectorXd right = equations.rightCols(1);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(matrix);
  Eigen::VectorXd alpha = qr.solve(right);
  alpha += qr.solve(right - matrix * alpha);

  OptimisedMicromodulus result;
  result.alpha.assign(alpha.begin(), alpha.end());
  result.solver = "equations";
  result.optimality = (matrix * alpha - right).cwiseQuotient(right).lpNorm<Eigen::Infinity>();
  return result;
}

}  // namespace perimode
