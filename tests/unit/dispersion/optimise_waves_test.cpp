// SPDX-License-Identifier: BSD-3-Clause
// What the optimised micromoduli stand on: branches of the contour that symmetry fixes, long waves that are
// exact.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "dispersion/sampled_errors.hpp"
#include "unit/dispersion/optimise_support.hpp"

namespace perimode {
namespace {

using test::as_vector;
using test::constant_lattice;

// The branches of the contour are eigenpairs of the symbol, whatever the multipliers.
template <int Dim>
void expect_eigenpairs_on_the_contour(double ratio) {
  const Lattice<Dim> lattice = constant_lattice<Dim>(ratio);
  std::vector<double> alpha(lattice.family.shell.size());
  for (std::size_t o = 0; o < alpha.size(); ++o) alpha[o] = std::sin(3.0 + 2.0 * static_cast<double>(o));
  const Lattice<Dim> changed = with_shells(lattice, alpha);
  const std::vector<double> rates = unit_rates(changed), constant = constant_rates(changed);
  const double spacing = lattice.family.spacing;
  for (const ContourBranch<Dim>& side : contour_branches<Dim>()) {
    for (const double s : {0.0, 0.4, 1.7, 3.0, std::numbers::pi}) {
      const Point<Dim> k = contour_point(side, s);
      const Eigen::Matrix<double, Dim, Dim> symbol =
          lattice_symbol<Dim>(changed.family, rates, Point<Dim>(k / spacing));
      const double value = side.polarisation.dot(symbol * side.polarisation);
      EXPECT_LT((symbol * side.polarisation - value * side.polarisation).norm(), 1e-13);
      EXPECT_NEAR(orbit_squares<Dim>(lattice.family, constant, k, side.polarisation).dot(as_vector(alpha)),
                  value, 1e-13);
    }
  }
  // Every point of a side has Dim waves.
  std::map<std::array<int, Dim>, int> waves;
  for (const ContourBranch<Dim>& side : contour_branches<Dim>()) waves[side.step] += side.count;
  for (const auto& [step, count] : waves) EXPECT_EQ(count, Dim);
}

TEST(Optimise, BranchesOfTheContourAreFixedBySymmetry) {
  expect_eigenpairs_on_the_contour<1>(3.0);
  expect_eigenpairs_on_the_contour<2>(3.0);
  expect_eigenpairs_on_the_contour<2>(5.0);
  expect_eigenpairs_on_the_contour<3>(2.0);
  expect_eigenpairs_on_the_contour<3>(3.0);
}

template <int Dim>
Eigen::Matrix<double, Dim, 1> long_wave_speeds(const Lattice<Dim>& lattice, const Point<Dim>& direction) {
  // The acoustic tensor (1/2) sum rate n n^T (xi . direction)^2, no small wave number.
  Eigen::Matrix<double, Dim, Dim> tensor = Eigen::Matrix<double, Dim, Dim>::Zero();
  for (std::size_t j = 0; j < lattice.rates.size(); ++j) {
    Point<Dim> xi;
    for (int a = 0; a < Dim; ++a)
      xi[a] = lattice.family.spacing * lattice.family.offset[j][static_cast<std::size_t>(a)];
    tensor +=
        0.5 * lattice.rates[j] * std::pow(xi.dot(direction), 2) / xi.squaredNorm() * xi * xi.transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, Dim, Dim>>(tensor).eigenvalues().cwiseSqrt();
}

template <int Dim>
void expect_exact_long_waves(double ratio, Plane plane, ErrorDomain domain) {
  const Lattice<Dim> lattice = constant_lattice<Dim>(ratio, plane);
  OptimiseOptions options;
  options.domain = domain;
  const Lattice<Dim> better = with_shells(lattice, optimise_micromodulus(lattice, options).alpha);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 10; ++i) {
    Point<Dim> direction;
    for (double& d : direction) d = normal(random);
    direction.normalize();
    const Eigen::Matrix<double, Dim, 1> speeds = long_wave_speeds(better, direction);
    EXPECT_NEAR(speeds[Dim - 1] / classical_speed(lattice.medium, Branch::pressure), 1.0, 1e-12);
    for (int s = 0; s + 1 < Dim; ++s)
      EXPECT_NEAR(speeds[s] / classical_speed(lattice.medium, Branch::shear), 1.0, 1e-12);
  }
}

TEST(Optimise, LongWavesAreExactInEveryDirection) {
  for (const ErrorDomain domain : {ErrorDomain::contour, ErrorDomain::zone}) {
    expect_exact_long_waves<2>(3.0, Plane::strain, domain);
    expect_exact_long_waves<2>(3.0, Plane::stress, domain);
    expect_exact_long_waves<2>(std::numbers::sqrt2, Plane::stress, domain);
    expect_exact_long_waves<3>(2.0, Plane::stress, domain);
    expect_exact_long_waves<3>(3.0, Plane::stress, domain);
  }
}

TEST(Optimise, AnotherPoissonsRatioHoldsAlongTheAxes) {
  const Lattice<2> lattice = constant_lattice<2>(3);
  OptimiseOptions options;
  options.poissons_ratio = 0.2;
  const OptimisedMicromodulus result = optimise_micromodulus(lattice, options);
  const Lattice<2> better = with_shells(lattice, result.alpha);
  const double bar = std::sqrt(72e9 / 2440.0);
  const double p = bar * std::sqrt(0.8 / (1.2 * 0.6)), s = bar * std::sqrt(0.5 / 1.2);
  const Eigen::Vector2d along = long_wave_speeds(better, Point<2>(0.0, 1.0));
  EXPECT_NEAR(along[1] / p, 1.0, 1e-12);
  EXPECT_NEAR(along[0] / s, 1.0, 1e-12);
  // Cauchy's relation C12 = C44 along the diagonal: (C11 + 3 C44)/2 instead of C11, (C11 - C44)/2.
  const Eigen::Vector2d diagonal = long_wave_speeds(better, Point<2>(1.0, 1.0).normalized());
  EXPECT_NEAR(diagonal[1], std::sqrt(0.5 * (p * p + 3.0 * s * s)), 1e-12 * p);
  EXPECT_NEAR(diagonal[0], std::sqrt(0.5 * (p * p - s * s)), 1e-12 * p);
}

}  // namespace
}  // namespace perimode
