// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/dispersion/optimise.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "dispersion/long_wave.hpp"
#include "dispersion/sampled_errors.hpp"
#include "perimode/core/error.hpp"
#include "unit/dispersion/optimise_support.hpp"

namespace perimode {
namespace {

using test::as_vector;
using test::constant_lattice;

std::vector<double> as_list(const Eigen::VectorXd& values) { return {values.begin(), values.end()}; }

template <int Dim>
ContourError relative_error(const Lattice<Dim>& lattice, const std::vector<double>& alpha) {
  const ContourError original = contour_error(lattice), now = contour_error(with_shells(lattice, alpha));
  return {now.l1 / original.l1, now.l2 / original.l2};
}

bool has_clp() {
  try {
    OptimiseOptions options;
    options.norm = ErrorNorm::l1;
    options.points = 16;
    (void)optimise_micromodulus(constant_lattice<1>(2), options);
    return true;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::environment);
    EXPECT_THAT(error.what(), testing::HasSubstr("PERIMODE_WITH_CLP"));
    return false;
  }
}

/// Squared errors of the original model with the roots sorted by size (contour_error_test.cpp), which the
/// reference values below are divided by.
double sorted_original(int m) { return m == 2 ? 1123.5599255 : 1328.1122683; }

// Coefficients in the order (1,0), (1,1), (2,0), (2,1), (2,2), (3,0); errors over those of the original.
TEST(Optimise, QuadraticProgrammesInThePlane) {
  struct Row {
    int m;
    std::vector<double> alpha;
    double l1, l2;
  };
  for (const Row& row :
       {Row{2, {8.1746376428, 1.4809609794, -3.0401212702}, 0.4756786383, 0.1995682119},
        Row{3,
            {27.1405315903, 6.5826657897, -19.7723191273, -0.4557006259, -0.3310746313, 6.7354513300},
            0.3930227092,
            0.1546823077}}) {
    const Lattice<2> lattice = constant_lattice<2>(row.m);
    const OptimisedMicromodulus result = optimise_micromodulus(lattice);
    ASSERT_EQ(result.alpha.size(), row.alpha.size());
    for (std::size_t o = 0; o < row.alpha.size(); ++o) EXPECT_NEAR(result.alpha[o], row.alpha[o], 1e-6);
    const ContourError error = contour_error(with_shells(lattice, result.alpha));
    EXPECT_NEAR(error.l1 / contour_error(lattice).l1, row.l1, 1e-6);
    EXPECT_NEAR(error.l2 / sorted_original(row.m), row.l2, 1e-6);
    EXPECT_LT(result.constraint_error, 1e-13);
    EXPECT_LT(result.optimality, 1e-12);
    EXPECT_TRUE(result.active.empty());
  }
}

TEST(Optimise, BoundedProgrammesInThePlane) {
  struct Row {
    int m;
    double bound, first, second, l1, l2;
  };
  for (const Row& row : {Row{2, 0.5, 1.0943951024, 1.4809609794, .9663045828, .9587953545},
                         Row{3, 0.5, 3.7635989987, 2.9863144542, .8731886009, .8231439066},
                         Row{2, 0.0, 2.0943951024, 1.4809609794, .8291013439, .7594769726},
                         Row{3, 0.0, 7.0685834706, 4.9982433054, .7224827475, .6425043358}}) {
    const Lattice<2> lattice = constant_lattice<2>(row.m);
    OptimiseOptions options;
    options.lower_bound = row.bound;
    for (const ErrorNorm norm : {ErrorNorm::l2, ErrorNorm::l1}) {
      if (norm == ErrorNorm::l1 && !has_clp()) continue;
      options.norm = norm;
      const OptimisedMicromodulus result = optimise_micromodulus(lattice, options);
      EXPECT_NEAR(result.alpha[0], row.first, 1e-8);
      EXPECT_NEAR(result.alpha[1], row.second, 1e-8);
      for (std::size_t o = 2; o < result.alpha.size(); ++o) EXPECT_EQ(result.alpha[o], row.bound);
      EXPECT_EQ(result.active.size(), result.alpha.size() - 2);
      EXPECT_LT(result.optimality, 1e-9);
      EXPECT_LT(result.constraint_error, 1e-13);
      const ContourError error = contour_error(with_shells(lattice, result.alpha));
      EXPECT_NEAR(error.l1 / contour_error(lattice).l1, row.l1, 1e-8);
      EXPECT_NEAR(error.l2 / sorted_original(row.m), row.l2, 1e-8);
    }
  }
}

TEST(Optimise, TheSizeOfTheWeightsDoesNotCount) {
  const Lattice<2> lattice = constant_lattice<2>(3);
  for (const ErrorNorm norm : {ErrorNorm::l2, ErrorNorm::l1}) {
    if (norm == ErrorNorm::l1 && !has_clp()) continue;
    OptimiseOptions options;
    options.norm = norm;
    options.weights = {0.5, 1.0};
    const std::vector<double> expected = optimise_micromodulus(lattice, options).alpha;
    for (const double size : {0x1p-40, 0x1p60}) {  // a power of two: the very same problem
      options.weights = {0.5 * size, size};
      const OptimisedMicromodulus scaled = optimise_micromodulus(lattice, options);
      EXPECT_EQ(scaled.alpha, expected) << size;
      EXPECT_LT(scaled.optimality, 1e-8) << size;
    }
  }
}

TEST(Optimise, LinearProgrammesReachTheLeastAbsoluteError) {
  if (!has_clp()) GTEST_SKIP() << "built without Clp";
  OptimiseOptions options;
  options.norm = ErrorNorm::l1;
  for (const auto& [m, bound] : {std::pair{2, .46130}, {3, .32717}}) {
    const Lattice<2> lattice = constant_lattice<2>(m);
    const OptimisedMicromodulus absolute = optimise_micromodulus(lattice, options),
                                square = optimise_micromodulus(lattice);
    EXPECT_EQ(absolute.solver, "clp");
    EXPECT_LT(absolute.optimality, 1e-8);
    EXPECT_LT(absolute.constraint_error, 1e-13);
    const ContourError a = relative_error(lattice, absolute.alpha), s = relative_error(lattice, square.alpha);
    EXPECT_LE(a.l1, bound);
    EXPECT_LT(a.l1, s.l1);
    EXPECT_LT(s.l2, a.l2);
  }
}

// A change that keeps the constraints and bounds never lowers the error a result is the least of.
template <int Dim>
void expect_no_better_neighbour(const Lattice<Dim>& lattice, const OptimiseOptions& options) {
  const OptimisedMicromodulus result = optimise_micromodulus(lattice, options);
  ASSERT_EQ(result.status, OptimiseStatus::optimal);
  const Eigen::VectorXd alpha = as_vector(result.alpha);
  const auto speeds = target_speeds(lattice.medium.continuum, options.poissons_ratio);
  const std::vector<double> rates = constant_rates(lattice);
  const Eigen::MatrixXd constraints = long_wave_constraints(lattice.family, rates, speeds);
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> projector(constraints);
  const auto error = [&](const Eigen::VectorXd& x) {
    if (options.domain == ErrorDomain::zone) {
      const ReducedObjective zone =
          zone_objective(lattice.family, rates, speeds, options.weights, 1 + lattice.family.reach());
      return (zone.rows() * x - zone.right()).squaredNorm();
    }
    const ContourError both =
        contour_error(with_shells(lattice, as_list(x)), options.poissons_ratio, options.weights);
    return options.norm == ErrorNorm::l1 ? both.l1 : both.l2;
  };
  const double least = error(alpha);
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  int tried = 0;
  for (int i = 0; i < 40; ++i) {
    Eigen::VectorXd change(alpha.size());
    for (double& c : change) c = normal(random);
    for (const int o : result.active) change[o] = 0.0;  // stay on the bounds, then leave some of them
    if (options.lower_bound && !result.active.empty() && i % 2 == 1)
      change[result.active[static_cast<std::size_t>(i) % result.active.size()]] = 1.0;
    std::vector<Eigen::Index> free;
    for (Eigen::Index o = 0; o < alpha.size(); ++o) {
      if (std::find(result.active.begin(), result.active.end(), o) == result.active.end()) free.push_back(o);
    }
    const Eigen::MatrixXd of_free = constraints(Eigen::all, free);
    change(free) -= Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(of_free).solve(
        Eigen::VectorXd(constraints * change));
    ASSERT_LT((constraints * change).norm(), 1e-10);
    const double size = std::pow(10.0, -(i % 4));
    if (options.lower_bound && (alpha + size * change).minCoeff() < *options.lower_bound - 1e-12) continue;
    ++tried;
    // Round-off of the error, and for l1 what its kinks between quadrature points leave.
    const double slack = options.norm == ErrorNorm::l1 ? 1e-5 : 1e-12;
    EXPECT_GE(error(alpha + size * change), least * (1.0 - slack)) << size;
  }
  EXPECT_GT(tried, 5);
}

TEST(Optimise, NoNeighbourIsBetter) {
  OptimiseOptions options;
  expect_no_better_neighbour(constant_lattice<2>(3), options);
  expect_no_better_neighbour(constant_lattice<2>(4, Plane::stress), options);
  expect_no_better_neighbour(constant_lattice<3>(2), options);
  options.lower_bound = -1.0;
  expect_no_better_neighbour(constant_lattice<2>(3), options);
  expect_no_better_neighbour(constant_lattice<3>(2), options);
  options.lower_bound = {};
  options.weights = {1.0, 3.0};
  options.poissons_ratio = 0.3;
  expect_no_better_neighbour(constant_lattice<2>(3), options);
  options.domain = ErrorDomain::zone;
  expect_no_better_neighbour(constant_lattice<2>(3), options);
  if (!has_clp()) return;
  options = {};
  options.norm = ErrorNorm::l1;
  expect_no_better_neighbour(constant_lattice<2>(3), options);
  expect_no_better_neighbour(constant_lattice<3>(2), options);
  options.lower_bound = -2.0;
  expect_no_better_neighbour(constant_lattice<2>(3), options);
}

// Whole zone, m = 3: error on the contour .3437 of the original's.
TEST(Optimise, WholeZone) {
  OptimiseOptions options;
  options.domain = ErrorDomain::zone;
  const Lattice<2> lattice = constant_lattice<2>(3);
  const OptimisedMicromodulus result = optimise_micromodulus(lattice, options);
  EXPECT_NEAR(relative_error(lattice, result.alpha).l1, .3437, 5e-5);
  EXPECT_LT(result.constraint_error, 1e-13);
  options.points = 96;  // the default is exact already
  const OptimisedMicromodulus fine = optimise_micromodulus(lattice, options);
  EXPECT_LT((as_vector(fine.alpha) - as_vector(result.alpha)).norm(), 1e-10 * as_vector(fine.alpha).norm());
}

TEST(Optimise, TighterBoundsNeverHelp) {
  const Lattice<2> lattice = constant_lattice<2>(3);
  const double unbounded = contour_error(with_shells(lattice, optimise_micromodulus(lattice).alpha)).l2;
  double previous = unbounded;
  for (const double bound : {-30.0, -15.0, -5.0, -1.0, 0.0, 0.3, 0.5, 0.7}) {
    OptimiseOptions options;
    options.lower_bound = bound;
    const OptimisedMicromodulus result = optimise_micromodulus(lattice, options);
    const double error = contour_error(with_shells(lattice, result.alpha)).l2;
    EXPECT_GE(error, previous * (1.0 - 1e-13)) << bound;
    for (const double alpha : result.alpha) EXPECT_GE(alpha, bound);
    if (bound == -30.0) {
      EXPECT_NEAR(error, unbounded, 1e-12 * unbounded);
    }
    previous = error;
  }
}

template <int Dim>
void expect_bound_is_sharp(double ratio, ErrorNorm norm, std::optional<double> poisson) {
  const Lattice<Dim> lattice = constant_lattice<Dim>(ratio);
  OptimiseOptions options;
  options.norm = norm;
  options.poissons_ratio = poisson;
  options.points = norm == ErrorNorm::l1 ? 64 : 0;
  options.lower_bound = 1e6;
  const OptimisedMicromodulus refused = optimise_micromodulus(lattice, options);
  ASSERT_EQ(refused.status, OptimiseStatus::infeasible);
  EXPECT_TRUE(refused.alpha.empty());
  const double largest = refused.largest_feasible_bound, size = std::max(1.0, std::abs(largest));
  options.lower_bound = largest + 1e-9 * size;
  EXPECT_EQ(optimise_micromodulus(lattice, options).status, OptimiseStatus::infeasible);
  for (const double below : {0.0, 1e-9, 1e-6, 1e-3}) {
    options.lower_bound = largest - below * size;
    const OptimisedMicromodulus result = optimise_micromodulus(lattice, options);
    ASSERT_EQ(result.status, OptimiseStatus::optimal);
    EXPECT_LT(result.constraint_error, 1e-12);
    EXPECT_LT(result.optimality, 1e-8);
    EXPECT_EQ(result.largest_feasible_bound, largest);
    for (const double alpha : result.alpha) EXPECT_GE(alpha, *options.lower_bound - 1e-12 * size);
  }
}

TEST(Optimise, TheLargestBoundIsSharp) {
  const bool clp = has_clp();
  for (const ErrorNorm norm : {ErrorNorm::l2, ErrorNorm::l1}) {
    if (norm == ErrorNorm::l1 && !clp) continue;
    for (const std::optional<double> poisson : {std::optional<double>(), std::optional<double>(0.1)}) {
      expect_bound_is_sharp<2>(2.0, norm, poisson);
      expect_bound_is_sharp<2>(3.0, norm, poisson);
      expect_bound_is_sharp<2>(4.0, norm, poisson);
      expect_bound_is_sharp<3>(2.0, norm, poisson);
    }
  }
}

TEST(Optimise, TheCubeImprovesOnTheOriginal) {
  for (const int m : {2, 3}) {
    const Lattice<3> lattice = constant_lattice<3>(m);
    const OptimisedMicromodulus result = optimise_micromodulus(lattice);
    EXPECT_LT(result.optimality, 1e-12);
    const ContourError error = relative_error(lattice, result.alpha);
    EXPECT_LT(error.l2, 0.5);
    EXPECT_LT(error.l1, 0.75);
  }
}

// Units of the case do not matter, nor what multipliers the lattice had.
TEST(Optimise, DependsOnTheLatticeAlone) {
  const std::vector<double> one = optimise_micromodulus(constant_lattice<2>(3)).alpha;
  const std::vector<double> other =
      optimise_micromodulus(with_shells(constant_lattice<2>(3, Plane::strain, 4e-3), one)).alpha;
  EXPECT_LT((as_vector(one) - as_vector(other)).norm(), 1e-11 * as_vector(one).norm());
}

TEST(Optimise, ShellsOfOneGiveTheConstantKernel) {
  const Lattice<3> lattice = constant_lattice<3>(3);
  const Lattice<3> same = with_shells(lattice, std::vector<double>(lattice.family.shell.size(), 1.0));
  EXPECT_EQ(same.rates, lattice.rates);
  EXPECT_EQ(same.medium.material.micromodulus.kernel, Kernel::shells);
  EXPECT_THROW((void)with_shells(lattice, {1.0}), Error);
}

template <int Dim>
void expect_refusal(const Lattice<Dim>& lattice, const OptimiseOptions& options, const std::string& says) {
  try {
    (void)optimise_micromodulus(lattice, options);
    ADD_FAILURE() << "expected: " << says;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
    EXPECT_THAT(error.what(), testing::HasSubstr(says));
  }
}

TEST(Optimise, RefusesWhatCannotBe) {
  expect_refusal(constant_lattice<2>(1.0), {}, "1 orbit, along the axes alone");
  expect_refusal(constant_lattice<3>(1.2), {}, "1.5 spacings or more");
  const Lattice<2> plate = constant_lattice<2>(3);
  OptimiseOptions options;
  options.method = OptimiseMethod::galerkin;
  expect_refusal(plate, options, "belong to one dimension");
  options.norm = ErrorNorm::l1;
  expect_refusal(constant_lattice<1>(3), options, "leave the norm out");
  options.norm = ErrorNorm::l2;
  options.lower_bound = 0.0;
  expect_refusal(constant_lattice<1>(3), options, "no room for a bound");
  options = {};
  options.poissons_ratio = 0.5;
  expect_refusal(plate, options, "between -1 and 0.5");
  options = {};
  options.weights = {0.0, 0.0};
  expect_refusal(plate, options, "weights");
  options.weights = {1.0, -1.0};
  expect_refusal(plate, options, "weights");
  options = {};
  options.norm = ErrorNorm::l1;
  options.domain = ErrorDomain::zone;
  expect_refusal(plate, options, "l1 over the zone");
  options = {};
  options.lower_bound = NAN;
  expect_refusal(plate, options, "finite lower_bound");
  options = {};
  options.points = -1;
  expect_refusal(plate, options, "quadrature points");
  Lattice<2> corrected = plate;
  corrected.family = make_family<2>(0.25, 0.75, VolumeCorrection::linear);
  corrected.rates = bond_rates<2>(corrected.medium, corrected.family);
  expect_refusal(corrected, {}, "volume_correction: none");
  Lattice<2> conical = plate;
  conical.medium.material.micromodulus.kernel = Kernel::conical;
  expect_refusal(conical, {}, "kernel: constant");
}

}  // namespace
}  // namespace perimode
