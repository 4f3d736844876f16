// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lattices.hpp"
#include "perimode/core/error.hpp"
#include "perimode/dispersion/zone.hpp"
#include "support/relative.hpp"

namespace perimode {
namespace {

using std::numbers::pi;
using test::expect_relative;
using test::lattice_of;
using test::shells_of;

// [alebrahim2021] 7.1.2, N = 2 in 1D, original and with the sub-domain multipliers,
// which the paper rounds to 3.72 and -0.86.
TEST(BranchBand, OfTheOriginalAndModifiedChainOfTwoNeighbours) {
  const auto original =
      branch_band<1>(lattice_of<1>({Kernel::constant}, 1.0, 2.0), Branch::pressure, Point<1>(1.0), pi, 0.05);
  expect_relative(original.long_wave_ratio, std::sqrt(1.5), 1e-13);
  ASSERT_EQ(original.crossings.size(), 1U);
  const double meets = original.crossings[0];  // k^2 = omega^2 there
  EXPECT_NEAR(meets, 1.27297, 5e-6);
  expect_relative(2.0 - std::cos(meets) - std::pow(std::cos(meets), 2), meets * meets, 1e-12);
  expect_relative(original.cut_off, 1.5, 1e-12);  // omega^2 = (1 - c) + (1 - c^2), c = cos k: 9/4 at c = -1/2
  expect_relative(original.cut_off_k, 2.0 * pi / 3.0, 1e-10);
  EXPECT_EQ(original.band_k, 0.0);  // 22.5 % too fast from the start
  EXPECT_EQ(original.band_frequency, 0.0);
  expect_relative(original.worst_overshoot, std::sqrt(1.5) - 1.0, 1e-12);

  const auto lattice = lattice_of<1>(shells_of<1>(2.0, {3.719824, -0.859912}), 1.0, 2.0);
  const auto modified = branch_band<1>(lattice, Branch::pressure, Point<1>(1.0), pi, 0.05);
  expect_relative(modified.long_wave_ratio, 1.0, 1e-14);  // 3.719824 - 2 x 0.859912 = 2
  ASSERT_EQ(modified.crossings.size(), 1U);
  EXPECT_NEAR(modified.crossings[0], 2.56648, 1e-5);
  EXPECT_NEAR(modified.cut_off, 2.72757, 1e-5);
  EXPECT_NEAR(modified.worst_overshoot, 0.0773, 5e-5);
  EXPECT_NEAR(modified.worst_overshoot_k, 1.665, 5e-4);
  EXPECT_NEAR(modified.band_k, 1.010, 5e-4);
  const auto edge = plane_waves<1>(lattice, Point<1>(modified.band_k), Point<1>(1.0));
  expect_relative(edge.phase_velocity[0], 1.05, 1e-10);
  expect_relative(edge.angular_frequency[0], modified.band_frequency, 1e-14);
}

// m = 1, speed 1: omega = 2 sin(k/2): the band ends where sin x = (1 - e) x.
TEST(BranchBand, OfASpringChain) {
  const auto chain = lattice_of<1>(shells_of<1>(1.0, {0.5}), 0.1, 1.0);
  const auto band = branch_band<1>(chain, Branch::pressure, Point<1>(1.0), pi / 0.1, 0.05);
  EXPECT_TRUE(band.crossings.empty());
  const double x = 0.05 * band.band_k;
  expect_relative(std::sin(x), 0.95 * x, 1e-12);
  expect_relative(band.band_frequency, 20.0 * std::sin(x), 1e-12);
  expect_relative(band.cut_off, 20.0, 1e-14);
  expect_relative(band.cut_off_k, pi / 0.1, 1e-14);
  const auto whole = branch_band<1>(chain, Branch::pressure, Point<1>(1.0), pi / 0.1, 0.5);
  EXPECT_EQ(whole.band_k, pi / 0.1);
}

TEST(BranchBand, AlongADiagonalIsThatOfTheWaves) {
  const auto lattice = lattice_of<2>({Kernel::constant}, 1.0, 3.0);
  const Point<2> d = Point<2>(1.0, 1.0).normalized();
  const double longest = pi * std::sqrt(2.0);
  for (const Branch branch : {Branch::pressure, Branch::shear}) {
    const std::size_t b = branch == Branch::pressure ? 0 : 1;
    const auto band = branch_band<2>(lattice, branch, Point<2>(2.0, 2.0), longest, 0.03);
    expect_relative(band.long_wave_ratio,
                    plane_waves<2>(lattice, Point<2>::Zero(), d).phase_velocity[b] /
                        classical_speed(lattice.medium, branch),
                    1e-14);
    double largest = 0.0;
    for (int i = 0; i <= 5000; ++i) {
      const auto waves = plane_waves<2>(lattice, longest * i / 5000.0 * d, d);
      largest = std::max(largest, waves.angular_frequency[b]);
      const double s = longest * i / 5000.0;
      const double error = waves.phase_velocity[b] / classical_speed(lattice.medium, branch) - 1.0;
      if (s < band.band_k) {
        EXPECT_LE(std::abs(error), 0.03 + 1e-10);
      }
    }
    EXPECT_GE(band.cut_off, largest * (1.0 - 1e-14));
    expect_relative(band.cut_off, largest, 1e-6);  // flat top, (slope 0), mesh 1e-3
  }
  EXPECT_THROW((void)branch_band<2>(lattice, Branch::shear, Point<2>::Zero(), 1.0, 0.1), Error);
  EXPECT_THROW((void)branch_band<2>(lattice, Branch::shear, d, 0.0, 0.1), Error);
}

TEST(SchemeDispersion, CentralDifferenceAndNewmarkSolveTheirRecurrences) {
  const double omega = 3.7, dt = 0.21;
  // u_{n+1} - 2 u_n + u_{n-1} = -(omega dt)^2 u_n for u = cos(w t).
  const double w = central_difference_frequency(omega, dt);
  expect_relative(2.0 * std::cos(w * dt) - 2.0, -omega * omega * dt * dt, 1e-13);
  // Average acceleration: (2 cos - 2) = -(omega dt)^2 (2 cos + 2)/4.
  const double v = newmark_frequency(omega, dt);
  expect_relative(2.0 * std::cos(v * dt) - 2.0,
                  -omega * omega * dt * dt * (2.0 * std::cos(v * dt) + 2.0) / 4.0, 1e-13);
  EXPECT_TRUE(std::isnan(central_difference_frequency(2.001 / dt, dt)));
  expect_relative(central_difference_frequency(2.0 / dt, dt), pi / dt, 1e-15);
}

TEST(SchemeDispersion, FiniteDifferences) {
  // [bouaraquia2024] eq. (51): omega/v at k = 1000 1/m, dx = 2 mm, Courant number 1/2.
  expect_relative(finite_difference_frequency(1000.0, 1.0, 0.002, 0.5), 868.5118212477, 1e-12);
  // Courant number 1 is exact, 0 the limit of short steps.
  expect_relative(finite_difference_frequency(900.0, 5.0, 0.002, 1.0), 4500.0, 1e-13);
  expect_relative(finite_difference_frequency(900.0, 5.0, 0.002, 1e-5),
                  finite_difference_frequency(900.0, 5.0, 0.002, 0.0), 1e-10);
  // N = 1 with the multiplier 1/2 is the same chain.
  const auto chain = lattice_of<1>(shells_of<1>(1.0, {0.5}), 0.002, 1.0);
  expect_relative(plane_waves<1>(chain, Point<1>(1000.0), Point<1>(1.0)).angular_frequency[0],
                  finite_difference_frequency(1000.0, 1.0, 0.002, 0.0), 1e-14);
}

}  // namespace
}  // namespace perimode
