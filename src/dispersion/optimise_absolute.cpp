// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/QR>
#include <cmath>
#include <limits>

#include "dispersion/linear_programme.hpp"
#include "dispersion/optimise_parts.hpp"

namespace perimode {
namespace {

LinearProgramme dual_programme(const SampledErrors& samples, const Eigen::VectorXd& limits,
                               const Eigen::MatrixXd& constraints, double lower) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
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
                                           double lower) {
  const Eigen::VectorXd limits = samples.weights.cwiseProduct(samples.measure);
  const LinearOptimum optimum = solve_linear_programme(dual_programme(samples, limits, constraints, lower));
  Eigen::VectorXd alpha = optimum.prices;

  // The simplex method keeps constraints and bounds to its tolerance; here they hold to round-off.
  OptimisedMicromodulus result;
  std::vector<Eigen::Index> free;
  free.reserve(static_cast<std::size_t>(alpha.size()));
  const double slack = 1e-8 * (1.0 + alpha.lpNorm<Eigen::Infinity>());
  for (Eigen::Index i = 0; i < alpha.size(); ++i) {
    if (alpha[i] > lower + slack) {
      free.push_back(i);
    } else {
      alpha[i] = lower;
      result.active.push_back(static_cast<int>(i));
    }
  }
  const Eigen::MatrixXd of_free = constraints(Eigen::all, free);
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition(of_free);
  for (int round = 0; round < 2; ++round) {
    const Eigen::VectorXd missing = Eigen::VectorXd::Ones(constraints.rows()) - constraints * alpha;
    alpha(free) += decomposition.solve(missing);
  }
  const double primal = limits.dot((samples.values * alpha - samples.targets).cwiseAbs());
  result.alpha.assign(alpha.begin(), alpha.end());
  result.solver = "clp";
  result.optimality = std::abs(primal + optimum.value) / primal;  // value = -dual objective
  return result;
}

}  // namespace perimode
