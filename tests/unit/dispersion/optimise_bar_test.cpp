// SPDX-License-Identifier: BSD-3-Clause
// Optimised micromoduli of the bar: [alebrahim2021] table 1, recomputed independently where its columns can
// be reproduced, the true least-squares minima otherwise.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "perimode/core/error.hpp"
#include "unit/dispersion/optimise_support.hpp"

namespace perimode {
namespace {

using test::constant_lattice;

OptimisedMicromodulus optimised(int n, OptimiseMethod method) {
  OptimiseOptions options;
  options.method = method;
  return optimise_micromodulus(constant_lattice<1>(n), options);
}

constexpr OptimiseMethod points = OptimiseMethod::point_collocation;
constexpr OptimiseMethod domains = OptimiseMethod::subdomain_collocation;
constexpr OptimiseMethod galerkin = OptimiseMethod::galerkin;
constexpr OptimiseMethod squares = OptimiseMethod::least_squares;

struct Column {
  OptimiseMethod method;
  std::vector<double> computed, printed;  // printed empty: not reproducible
};
const std::vector<Column> table = {
    {points, {10.540805, -5.551652, 1.687500}, {10.5, -5.5, 1.7}},
    {domains, {8.808243, -3.338446, 0.789550}, {8.8, -3.3, 0.8}},
    {galerkin, {9.078276, -4.343448, 1.369540}, {9.1, -4.3, 1.4}},
    {squares, {9.122688, -4.698741, 1.591598}, {}},
    {points, {26.325732, -15.421257, 12.198796, -7.710628, 2.252582}, {26.3, -15.4, 12.2, -7.7, 2.2}},
    {domains, {24.958359, -12.111827, 6.854760, -3.041450, 0.673363}, {25, -12.1, 6.8, -3.0, 0.7}},
    {galerkin, {25.029212, -12.441577, 8.420968, -6.133154, 2.324731}, {25.0, -12.4, 8.4, -6.1, 2.3}},
    {squares, {25.104184, -12.410010, 8.172375, -7.017038, 3.153372}, {}},
    {points,
     {101.021608, -52.081245, 36.554090, -29.490337, 25.954747, -24.369394, 24.147999, -22.125529, 13.707784,
      -3.751923},
     {101, -52.1, 36.5, -29.5, 25.9, -24.3, 24.1, -22.1, 13.7, -3.7}},
    {domains,
     {99.993754, -49.948547, 33.150893, -24.535989, 19.005430, -14.733730, 10.737976, -6.530164, 2.713210,
      -0.537356},
     {100, -50, 33.1, -24.5, 19.0, -14.7, 10.7, -6.5, 2.7, -0.5}},
    {galerkin,
     {99.992554, -50.014891, 33.310996, -25.029783, 19.962771, -16.711341, 14.233594, -12.559566, 11.044099,
      -4.787796},
     {100, -50, 33.3, -25.0, 20, -16.7, 14.2, -12.6, 11.0, -4.8}},
    {squares,
     {99.936434, -50.109222, 33.214278, -25.075157, 20.040385, -16.421187, 14.843754, -11.504025, 12.688308,
      -7.680385},
     {}}};

TEST(OptimiseBar, ColumnsOfTableOne) {
  for (const Column& column : table) {
    const auto n = static_cast<int>(column.computed.size());
    const OptimisedMicromodulus result = optimised(n, column.method);
    ASSERT_EQ(result.alpha.size(), column.computed.size());
    double moment = 0.0;  // sum i alpha_i = N^2/2
    for (std::size_t i = 0; i < result.alpha.size(); ++i) {
      EXPECT_NEAR(result.alpha[i], column.computed[i], 1e-5) << "N = " << n << ", alpha_" << i + 1;
      if (!column.printed.empty()) {
        EXPECT_NEAR(result.alpha[i], column.printed[i], 0.08);  // printed digits, cut or rounded
      }
      moment += static_cast<double>(i + 1) * result.alpha[i];
    }
    EXPECT_NEAR(moment, 0.5 * n * n, 1e-10 * n * n);
    EXPECT_LT(result.constraint_error, 1e-12);
    EXPECT_LT(result.optimality, 1e-10) << "N = " << n << " by " << result.solver;
    EXPECT_EQ(result.solver, column.method == squares ? "null space" : "equations");
  }
}

// Eq. (49) over that of the original N = 3.
TEST(OptimiseBar, ErrorsOfTheMethods) {
  struct Row {
    int n;
    double original;
    std::map<OptimiseMethod, double> optimised;
    double best;
  };
  const std::vector<Row> rows = {
      {1,
       0.3655402255,
       {{points, 0.5187056119}, {domains, 0.5187056119}, {squares, 0.5187056119}, {galerkin, 0.5187056119}},
       0.5187056119},
      {2,
       0.7519348093,
       {{points, 0.3664420622}, {domains, 0.1507472660}, {squares, 0.1608173823}, {galerkin, 0.1552320720}},
       0.14994},
      {3,
       1.0,
       {{points, 0.1857819311}, {domains, 0.0855074226}, {squares, 0.0832394039}, {galerkin, 0.0782936543}},
       0.07353},
      {5,
       1.1764354987,
       {{points, 0.0756721538}, {domains, 0.0366905433}, {squares, 0.0364301087}, {galerkin, 0.0333546324}},
       0.02971},
      {10,
       1.2758786013,
       {{points, 0.0225876699}, {domains, 0.0101469345}, {squares, 0.0115826922}, {galerkin, 0.0103661290}},
       0.00838}};
  const double unit = contour_error(constant_lattice<1>(3)).l1;
  EXPECT_NEAR(unit, 7.812215946, 1e-8);
  for (const Row& row : rows) {
    const Lattice<1> lattice = constant_lattice<1>(row.n);
    EXPECT_NEAR(contour_error(lattice).l1 / unit, row.original, 1e-7);
    for (const auto& [method, expected] : row.optimised) {
      const OptimisedMicromodulus result = optimised(row.n, method);
      EXPECT_NEAR(contour_error(with_shells(lattice, result.alpha)).l1 / unit, expected, 1e-7);
    }
    try {
      OptimiseOptions absolute;
      absolute.norm = ErrorNorm::l1;
      const OptimisedMicromodulus best = optimise_micromodulus(lattice, absolute);
      EXPECT_NEAR(contour_error(with_shells(lattice, best.alpha)).l1 / unit, row.best, 6e-6);  // digits given
    } catch (const Error& error) {
      ASSERT_EQ(error.kind(), ErrorKind::environment) << error.what();  // built without Clp
    }
  }
}

// The Fourier series of k^2 is what alpha tends to: alpha_i = -(-1)^i N^2/i.
TEST(OptimiseBar, ManyOrbitsTendToTheFourierSeries) {
  constexpr int n = 40;
  const OptimisedMicromodulus result = optimised(n, galerkin);
  for (int i = 1; i <= 5; ++i) {
    const double limit = (i % 2 == 1 ? 1.0 : -1.0) * n * n / i;
    EXPECT_NEAR(result.alpha[static_cast<std::size_t>(i - 1)] / limit, 1.0, 1e-2);
  }
}

TEST(OptimiseBar, OneOrbitIsFixedByTheSpeedOfLongWaves) {
  for (const OptimiseMethod method : {points, domains, galerkin, squares})
    EXPECT_NEAR(optimised(1, method).alpha[0], 0.5, 1e-15);
}

TEST(OptimiseBar, BoundsUpToTheLargestThatCanBe) {
  OptimiseOptions options;
  options.lower_bound = 0.75;  // sum i alpha_i = 4.5 over 6 = sum i
  OptimisedMicromodulus result = optimise_micromodulus(constant_lattice<1>(3), options);
  ASSERT_EQ(result.status, OptimiseStatus::optimal);
  for (const double alpha : result.alpha) EXPECT_NEAR(alpha, 0.75, 1e-12);
  options.lower_bound = 0.75 + 1e-9;
  result = optimise_micromodulus(constant_lattice<1>(3), options);
  EXPECT_EQ(result.status, OptimiseStatus::infeasible);
  EXPECT_TRUE(result.alpha.empty());
  EXPECT_NEAR(result.largest_feasible_bound, 0.75, 1e-14);
  options.lower_bound = 0.0;
  result = optimise_micromodulus(constant_lattice<1>(3), options);
  EXPECT_NEAR(result.alpha[0], 4.5, 1e-12);  // the far bonds want to be negative
  EXPECT_EQ(result.active, (std::vector<int>{1, 2}));
  EXPECT_EQ(result.solver, "active set");
}

TEST(OptimiseBar, RefusesAPoissonsRatio) {
  OptimiseOptions options;
  options.poissons_ratio = 0.2;
  EXPECT_THROW((void)optimise_micromodulus(constant_lattice<1>(3), options), Error);
  EXPECT_THROW((void)contour_error(constant_lattice<1>(3), 0.2), Error);
}

}  // namespace
}  // namespace perimode
