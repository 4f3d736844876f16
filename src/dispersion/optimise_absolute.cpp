// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "dispersion/bounded_least_squares.hpp"
#include "dispersion/linear_programme.hpp"
#include "dispersion/optimise_parts.hpp"

namespace perimode {
namespace {

LinearProgramme dual_programme(const SampledErrors& samples, const Eigen::VectorXd& limits,
                               const Eigen::MatrixXd& constraints, double lower) {
  const Eigen::Index points = samples.values.rows(), orbits = samples.values.cols(), m = constraints.rows();
  const Eigen::Index bounds = std::isfinite(lower) ? orbits : 0, columns = points + m + bounds;
  LinearProgramme dual{Eigen::MatrixXd(orbits, columns), Eigen::VectorXd(columns), Eigen::VectorXd(columns),
                       Eigen::VectorXd::Constant(columns, infinity)};
  dual.matrix.leftCols(points) = samples.values.transpose();
  dual.matrix.middleCols(points, m) = -constraints.transpose();
  dual.matrix.rightCols(bounds) = -Eigen::MatrixXd::Identity(orbits, bounds);
  dual.cost.head(points) = samples.targets;
  dual.cost.segment(points, m).setConstant(-1.0);
  dual.cost.tail(bounds).setConstant(bounds > 0 ? -lower : 0.0);
  dual.lower.head(points) = -limits;
  dual.upper.head(points) = limits;
  dual.lower.segment(points, m).setConstant(-infinity);
  dual.lower.tail(bounds).setZero();
  return dual;
}

}  // namespace

OptimisedMicromodulus least_absolute_error(const SampledErrors& samples, const Eigen::MatrixXd& constraints,
                                           double lower, const Eigen::VectorXd& feasible) {
  const Eigen::VectorXd limits = samples.weights.cwiseProduct(samples.measure);
  const LinearOptimum optimum = solve_linear_programme(dual_programme(samples, limits, constraints, lower));

  // The simplex method keeps constraints and bounds to its tolerance. In the feasible point nearest to its
  // prices they hold to round-off; prices at the bound are pulled beyond it, so that they end on it.
  const Eigen::Index orbits = constraints.cols();
  const double size = 1.0 + optimum.prices.lpNorm<Eigen::Infinity>();
  Eigen::VectorXd wanted = optimum.prices;
  for (double& price : wanted)
    if (price <= lower + 1e-9 * size) price = lower - size;
  const BoundedLeastSquares nearest{Eigen::MatrixXd::Identity(orbits, orbits), wanted, constraints,
                                    Eigen::VectorXd::Ones(constraints.rows()), lower};
  const BoundedMinimum minimum = minimise(nearest, feasible);
  const Eigen::VectorXd& alpha = minimum.x;
  OptimisedMicromodulus result;
  result.active = minimum.active;
  const double primal = limits.dot((samples.values * alpha - samples.targets).cwiseAbs());
  result.alpha.assign(alpha.begin(), alpha.end());
  result.solver = "clp";
  result.optimality = std::abs(primal + optimum.value) / primal;  // value = -dual objective
  return result;
}

}  // namespace perimode
