// SPDX-License-Identifier: BSD-3-Clause
#include "dispersion/bounded_least_squares.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <limits>
#include <random>

#include "dispersion/long_wave.hpp"

namespace perimode {
namespace {

BoundedLeastSquares random_problem(std::mt19937& random, int n, int constraints, double lower) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> positive(0.1, 1.0);
  BoundedLeastSquares problem{Eigen::MatrixXd(n + 2, n), Eigen::VectorXd(n + 2),
                              Eigen::MatrixXd(constraints, n), Eigen::VectorXd::Ones(constraints), lower};
  for (double& entry : problem.rows.reshaped()) entry = normal(random);
  for (double& entry : problem.right) entry = 3.0 * normal(random);
  for (double& entry : problem.constraints.reshaped()) entry = positive(random);
  return problem;
}

/// The best of all choices of variables at the bound, each by the equations of Lagrange: exponential.
double best_of_all(const BoundedLeastSquares& problem) {
  const auto n = problem.rows.cols(), m = problem.constraints.rows();
  double best = std::numeric_limits<double>::infinity();
  for (int held = 0; held < 1 << n; ++held) {
    std::vector<Eigen::Index> free;
    Eigen::VectorXd x = Eigen::VectorXd::Constant(n, problem.lower);
    for (Eigen::Index i = 0; i < n; ++i)
      if ((held >> i & 1) == 0) free.push_back(i);
    const auto f = static_cast<Eigen::Index>(free.size());
    if (f < m) continue;
    for (const Eigen::Index i : free) x[i] = 0.0;
    const Eigen::MatrixXd rows = problem.rows(Eigen::all, free), c = problem.constraints(Eigen::all, free);
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(f + m, f + m);
    system.topLeftCorner(f, f) = rows.transpose() * rows;
    system.topRightCorner(f, m) = c.transpose();
    system.bottomLeftCorner(m, f) = c;
    Eigen::VectorXd right(f + m);
    right.head(f) = rows.transpose() * (problem.right - problem.rows * x);
    right.tail(m) = problem.values - problem.constraints * x;
    x(free) = Eigen::VectorXd(system.fullPivLu().solve(right)).head(f);
    if (x.minCoeff() < problem.lower - 1e-12) continue;
    if ((problem.constraints * x - problem.values).norm() > 1e-9) continue;
    best = std::min(best, (problem.rows * x - problem.right).squaredNorm());
  }
  return best;
}

TEST(BoundedLeastSquares, IsTheBestOfAllActiveSets) {
  std::mt19937 random(11);
  int bounds_met = 0;
  for (int n = 2; n <= 7; ++n) {
    for (int constraints = 1; constraints <= 2; ++constraints) {
      for (int repeat = 0; repeat < 8; ++repeat) {
        BoundedLeastSquares problem = random_problem(random, n, constraints, 0.0);
        const LargestBound largest = largest_bound(problem.constraints);
        problem.lower = largest.bound - (repeat % 4 == 0 ? 0.0 : 0.3 * repeat);
        const BoundedMinimum minimum = minimise(problem, largest.alpha);
        const double error = (problem.rows * minimum.x - problem.right).squaredNorm();
        EXPECT_NEAR(error, best_of_all(problem), 1e-9 * (1.0 + error));
        EXPECT_LT((problem.constraints * minimum.x - problem.values).norm(), 1e-12);
        EXPECT_GE(minimum.x.minCoeff(), problem.lower - 1e-12);
        EXPECT_LT(minimum.violation, 1e-9);
        for (const int i : minimum.active) EXPECT_EQ(minimum.x[i], problem.lower);
        bounds_met += static_cast<int>(minimum.active.size());
      }
    }
  }
  EXPECT_GT(bounds_met, 50);
}

// Where rows tell nothing of a direction the minimum nearest to the start is taken.
TEST(BoundedLeastSquares, OfSeveralMinimaTheNearest) {
  const BoundedLeastSquares problem{Eigen::RowVector3d(1.0, 1.0, 0.0), Eigen::VectorXd::Constant(1, 4.0),
                                    Eigen::RowVector3d(0.0, 0.0, 1.0), Eigen::VectorXd::Constant(1, 5.0),
                                    -std::numeric_limits<double>::infinity()};
  const BoundedMinimum minimum = minimise(problem, Eigen::Vector3d(1.0, 0.0, 5.0));
  EXPECT_LT((minimum.x - Eigen::Vector3d(2.5, 1.5, 5.0)).norm(), 1e-14);
  EXPECT_LT(minimum.violation, 1e-14);
}

// max t, alpha >= t: no random feasible point has a larger least component.
TEST(LargestBound, NoFeasiblePointIsLarger) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int repeat = 0; repeat < 20; ++repeat) {
    const Eigen::MatrixXd constraints = random_problem(random, 6, 2, 0.0).constraints;
    const LargestBound largest = largest_bound(constraints);
    EXPECT_LT((constraints * largest.alpha - Eigen::Vector2d::Ones()).norm(), 1e-12);
    EXPECT_NEAR(largest.alpha.minCoeff(), largest.bound, 1e-15 * (1.0 + std::abs(largest.bound)));
    for (int i = 0; i < 200; ++i) {
      Eigen::VectorXd change(6);
      for (double& c : change) c = normal(random);
      const Eigen::MatrixXd gram = constraints * constraints.transpose();
      change -= constraints.transpose() * gram.lu().solve(constraints * change);
      EXPECT_LE((largest.alpha + 0.1 * change).minCoeff(), largest.bound + 1e-12);
    }
  }
}

}  // namespace
}  // namespace perimode
