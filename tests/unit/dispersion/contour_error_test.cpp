// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "perimode/core/error.hpp"
#include "unit/dispersion/optimise_support.hpp"

namespace perimode {
namespace {

using std::numbers::pi;
using test::constant_lattice;

// [alebrahim2021] eq. (51) and the integral of eq. (45) of the original model, the latter with the roots
// sorted by size, as eq. (15) does. Sorted or told apart by polarisation, the sum of absolute errors is the
// same; that of squares is not where the branches cross (N = 2, 4, 5; on Y-O).
TEST(ContourError, OfTheOriginalModel) {
  const std::vector<std::array<double, 2>> errors = {{98.3298129445, 1123.5599255},
                                                     {112.8405907775, 1328.1122683},
                                                     {119.6514609412, 1430.3275527},
                                                     {122.6342045554, 1472.9095037}};
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const Lattice<2> lattice = constant_lattice<2>(static_cast<double>(i) + 2.0);
    const ContourError error = contour_error(lattice);
    EXPECT_NEAR(error.l1, errors[i][0], 1e-9 * errors[i][0]);
    const double spacing = lattice.family.spacing, unit = 2440.0 * spacing * spacing / 72e9;
    double sorted = 0.0;
    constexpr int intervals = 3000;
    for (const auto& [from, to] :
         {std::pair<Point<2>, Point<2>>{{0, 0}, {1, 0}}, {{1, 0}, {1, 1}}, {{1, 1}, {0, 0}}}) {
      for (int j = 0; j < intervals; ++j) {
        const Point<2> k = pi * (from + (j + 0.5) / intervals * (to - from));
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(
            unit * lattice_symbol<2>(lattice.family, lattice.rates, Point<2>(k / spacing)));
        const double p = solver.eigenvalues()[1] - 1.2 * k.squaredNorm(),
                     s = solver.eigenvalues()[0] - 0.4 * k.squaredNorm();
        sorted += pi * (to - from).norm() / intervals * (p * p + s * s);
      }
    }
    EXPECT_NEAR(sorted, errors[i][1], 1e-6 * errors[i][1]);  // midpoint rule
    EXPECT_GE(error.l2, errors[i][1] * (1.0 - 1e-9));
    if (i == 1) {
      EXPECT_NEAR(error.l2, errors[i][1], 1e-9 * errors[i][1]);
    }
  }
}

// A bar of one orbit: omega^2 = 4 (1 - cos k), longer than k^2 up to where they meet.
TEST(ContourError, OfNeighboursAloneInClosedForm) {
  double meet = 2.0;
  for (int i = 0; i < 60; ++i) meet = std::sqrt(4.0 * (1.0 - std::cos(meet)));
  for (int i = 0; i < 8; ++i)
    meet -= (4.0 * (1.0 - std::cos(meet)) - meet * meet) / (4.0 * std::sin(meet) - 2.0 * meet);
  const auto integral = [](double k) { return 4.0 * (k - std::sin(k)) - k * k * k / 3.0; };
  const ContourError error = contour_error(constant_lattice<1>(1));
  EXPECT_NEAR(error.l1, 2.0 * integral(meet) - integral(pi), 1e-12);
  // int (4 - 4 cos k - k^2)^2 = 24 pi + pi^5/5 - 8 pi^3/3 - 16 pi
  EXPECT_NEAR(error.l2, 8.0 * pi + std::pow(pi, 5) / 5.0 - 8.0 * std::pow(pi, 3) / 3.0, 1e-11);
}

// The same by brute force: eigenvalues of the symbol at many points, told apart by polarisation.
TEST(ContourError, InSpaceByTheTrapeziumRule) {
  const Lattice<3> lattice = constant_lattice<3>(2.0);
  const double spacing = lattice.family.spacing, unit = 2440.0 * spacing * spacing / 72e9;
  const std::vector<Point<3>> corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {0, 0, 0}};
  double l1 = 0.0, l2 = 0.0;
  constexpr int intervals = 4000;
  for (std::size_t side = 0; side + 1 < corners.size(); ++side) {
    const Point<3> step = corners[side + 1] - corners[side];
    const double measure = pi * step.norm() / intervals;
    for (int i = 0; i < intervals; ++i) {
      const Point<3> k = pi * (corners[side] + (i + 0.5) / intervals * step);
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
          unit * lattice_symbol<3>(lattice.family, lattice.rates, Point<3>(k / spacing)));
      // Of degenerate eigenvalues any basis will do: P is that of the largest share of k.
      int pressure = 0;
      double share = -1.0;
      for (int b = 0; b < 3; ++b) {
        double same = 0.0;
        for (int c = 0; c < 3; ++c) {
          if (std::abs(solver.eigenvalues()[c] - solver.eigenvalues()[b]) < 1e-9 * solver.eigenvalues()[2])
            same += std::pow(solver.eigenvectors().col(c).dot(k.normalized()), 2);
        }
        if (same > share + 1e-12) {
          share = same;
          pressure = b;
        }
      }
      for (int b = 0; b < 3; ++b) {
        const double error = solver.eigenvalues()[b] - (b == pressure ? 1.2 : 0.4) * k.squaredNorm();
        l1 += measure * std::abs(error);
        l2 += measure * error * error;
      }
    }
  }
  const ContourError error = contour_error(lattice);
  EXPECT_NEAR(error.l1, l1, 1e-5 * l1);  // midpoint rule with kinks
  EXPECT_NEAR(error.l2, l2, 1e-5 * l2);
}

TEST(ContourError, IsWeighedPerBranch) {
  const Lattice<2> lattice = constant_lattice<2>(3.0, Plane::stress);
  const ContourError p = contour_error(lattice, {}, {1.0, 0.0}), s = contour_error(lattice, {}, {0.0, 1.0}),
                     both = contour_error(lattice, {}, {2.0, 3.0});
  EXPECT_NEAR(both.l1, 2.0 * p.l1 + 3.0 * s.l1, 1e-13 * both.l1);
  EXPECT_NEAR(both.l2, 4.0 * p.l2 + 9.0 * s.l2, 1e-13 * both.l2);
  EXPECT_THROW((void)contour_error(lattice, {}, {0.0, 0.0}), Error);
  EXPECT_THROW((void)contour_error(lattice, 0.6), Error);
  EXPECT_NEAR(contour_error(lattice, 1.0 / 3.0).l1, contour_error(lattice).l1, 1e-12 * p.l1);
}

}  // namespace
}  // namespace perimode
