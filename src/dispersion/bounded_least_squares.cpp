// SPDX-License-Identifier: BSD-3-Clause
#include "dispersion/bounded_least_squares.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "perimode/core/error.hpp"

namespace perimode {
namespace {

using Decomposition = Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>;

std::vector<Eigen::Index> free_variables(const std::vector<char>& held) {
  std::vector<Eigen::Index> free;
  free.reserve(held.size());
  for (std::size_t i = 0; i < held.size(); ++i)
    if (held[i] == 0) free.push_back(static_cast<Eigen::Index>(i));
  return free;
}

/// The step of the free variables from x to the minimum over them.
Eigen::VectorXd step_to_minimum(const BoundedLeastSquares& problem, const Eigen::VectorXd& x,
                                const std::vector<Eigen::Index>& free) {
  const auto n = static_cast<Eigen::Index>(free.size()), m = problem.constraints.rows();
  const Eigen::MatrixXd constraints = problem.constraints(Eigen::all, free);
  const Eigen::MatrixXd rows = problem.rows(Eigen::all, free);
  Eigen::VectorXd step = Decomposition(constraints).solve(problem.values - problem.constraints * x);
  if (n <= m) return step;
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(constraints.transpose());
  const Eigen::MatrixXd full = qr.householderQ() * Eigen::MatrixXd::Identity(n, n);
  const Eigen::MatrixXd null_space = full.rightCols(n - m);
  const Decomposition reduced(rows * null_space);
  for (int round = 0; round < 2; ++round) {  // the second refines the first
    const Eigen::VectorXd residual = problem.right - problem.rows * x - rows * step;
    step += null_space * reduced.solve(residual);
  }
  return step;
}

/// g = rows^T (rows x - right) - constraints^T mu with the mu that make it least over the free variables.
Eigen::VectorXd lagrangian_gradient(const BoundedLeastSquares& problem, const Eigen::VectorXd& x,
                                    const std::vector<Eigen::Index>& free) {
  Eigen::VectorXd gradient = problem.rows.transpose() * (problem.rows * x - problem.right);
  const Eigen::MatrixXd transposed = problem.constraints(Eigen::all, free).transpose();
  const Decomposition decomposition(transposed);
  for (int round = 0; round < 2; ++round)
    gradient -= problem.constraints.transpose() * decomposition.solve(gradient(free));
  return gradient;
}

double largest_violation(const Eigen::VectorXd& gradient, const std::vector<char>& held) {
  double largest = 0.0;
  for (std::size_t i = 0; i < held.size(); ++i) {
    const double g = gradient[static_cast<Eigen::Index>(i)];
    largest = std::max(largest, held[i] != 0 ? -g : std::abs(g));
  }
  return largest;
}

/// The held variable to let go: that of the most negative multiplier, or the first; -1: none.
int variable_to_release(const Eigen::VectorXd& gradient, const std::vector<char>& held, double tolerance,
                        bool first) {
  int chosen = -1;
  double least = -tolerance;
  for (std::size_t i = 0; i < held.size(); ++i) {
    const double g = gradient[static_cast<Eigen::Index>(i)];
    if (held[i] == 0 || g >= least) continue;
    chosen = static_cast<int>(i);
    if (first) break;
    least = g;
  }
  return chosen;
}

}  // namespace

BoundedMinimum minimise(const BoundedLeastSquares& problem, const Eigen::VectorXd& start) {
  const Eigen::Index n = start.size();
  std::vector<char> held(static_cast<std::size_t>(n), 0);
  Eigen::VectorXd x = start;
  const Eigen::VectorXd at_ones =
      problem.rows.transpose() * (problem.rows * Eigen::VectorXd::Ones(n) - problem.right);
  const double tolerance = 1e-11 * at_ones.lpNorm<Eigen::Infinity>();
  const int limit = 100 * static_cast<int>(n) + 100;
  for (int iteration = 0; iteration < limit; ++iteration) {
    const std::vector<Eigen::Index> free = free_variables(held);
    const Eigen::VectorXd step = step_to_minimum(problem, x, free);
    const double slack = 1e-13 * (1.0 + x.lpNorm<Eigen::Infinity>());
    double fraction = 1.0;
    Eigen::Index blocking = -1;
    for (std::size_t f = 0; f < free.size(); ++f) {
      const double s = step[static_cast<Eigen::Index>(f)], value = x[free[f]];
      if (!(value + s < problem.lower - slack)) continue;
      const double reach = std::max(0.0, (problem.lower - value) / s);
      if (reach < fraction) {
        fraction = reach;
        blocking = free[f];
      }
    }
    for (std::size_t f = 0; f < free.size(); ++f) x[free[f]] += fraction * step[static_cast<Eigen::Index>(f)];
    if (blocking >= 0) {
      held[static_cast<std::size_t>(blocking)] = 1;
      x[blocking] = problem.lower;
      continue;
    }
    const Eigen::VectorXd gradient = lagrangian_gradient(problem, x, free);
    const int released = variable_to_release(gradient, held, tolerance, iteration > 10 * n);
    if (released >= 0) {
      held[static_cast<std::size_t>(released)] = 0;
      continue;
    }
    BoundedMinimum minimum{x, {}, largest_violation(gradient, held)};
    for (std::size_t i = 0; i < held.size(); ++i)
      if (held[i] != 0) minimum.active.push_back(static_cast<int>(i));
    return minimum;
  }
  throw Error(ErrorKind::solver_failure,
              fmt::format("the active-set method did not end within {} steps", limit));
}

}  // namespace perimode
