// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/reference/wave_in_bar.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "perimode/core/error.hpp"

namespace perimode {
namespace {

using std::numbers::pi;

/// Any displacements without symmetry, of order 1.
std::vector<double> some_displacements(int cells) {
  std::vector<double> u;
  for (int i = 0; i < cells; ++i) u.push_back(std::sin(1.0 + 2.3 * i + 0.1 * i * i));
  return u;
}

double centre(int i, int cells, double length) { return (i + 0.5) * length / cells; }

class ReleasedLattice : public testing::TestWithParam<Ends> {};

// The waves are complete and orthogonal: at t = 0 they add up to what was let go. Round-off of a sum of
// `cells` terms of order 1.
TEST_P(ReleasedLattice, StartsFromTheGivenDisplacements) {
  for (const int cells : {1, 2, 7, 40}) {
    const double length = 1.7;
    const std::vector<double> u0 = some_displacements(cells);
    const auto waves = released_lattice(GetParam(), length, u0, [](double k) { return 3.0 * k; });
    ASSERT_EQ(waves.size(), u0.size());
    for (int i = 0; i < cells; ++i)
      EXPECT_NEAR(displacement(waves, centre(i, cells, length), 0.0), u0[static_cast<std::size_t>(i)],
                  2e-15 * cells * cells);
  }
}

INSTANTIATE_TEST_SUITE_P(Ends, ReleasedLattice, testing::Values(Ends::mirror, Ends::antimirror, Ends::mixed));

// Nearest neighbours, omega = (2 v/dx) sin(k dx/2): stepped with dt = dx/v this lattice is d'Alembert's,
//   u_i(t + dt) = u_{i+1}(t) + u_{i-1}(t) - u_i(t - dt), whatever the ends do.
TEST(WaveInBar, TheLatticeOfNearestNeighboursStepsAsDAlembertSays) {
  const int cells = 24;
  const double dx = 1.0 / cells, v = 5.0, dt = dx / v;
  const std::vector<double> u0 = some_displacements(cells);
  const auto waves = released_lattice(Ends::mixed, 1.0, u0, [&](double k) {
    return stepped_frequency(2.0 * v / dx * std::sin(0.5 * k * dx), dt);
  });
  std::vector<double> now = u0, before(u0.size());
  const auto at = [&](const std::vector<double>& u, int i) {
    if (i < 0) return -u[0];                                     // odd about x = 0
    return u[static_cast<std::size_t>(std::min(i, cells - 1))];  // even about x = 1
  };
  for (int i = 0; i < cells; ++i) before[static_cast<std::size_t>(i)] = 0.5 * (at(u0, i - 1) + at(u0, i + 1));
  for (int step = 1; step <= 100; ++step) {
    std::vector<double> next(u0.size());
    for (int i = 0; i < cells; ++i)
      next[static_cast<std::size_t>(i)] =
          at(now, i + 1) + at(now, i - 1) - before[static_cast<std::size_t>(i)];
    before = now;
    now = next;
    for (int i = 0; i < cells; ++i)
      ASSERT_NEAR(displacement(waves, centre(i, cells, 1.0), step * dt), at(now, i), 1e-11);
  }
}

// [scabbia2023] eq. (11): amplitude of the first wave from its formula; 40 terms give the pulse to what its
// tails lose (exp(-25) of 0.02) and the lattice's own amplitudes are the same.
TEST(WaveInBar, ThePulseOfScabbia) {
  const auto omega = [](double k) { return 5000.0 * std::sqrt(scabbia_lambda(0.1, k)); };
  const auto waves = released_pulse(1.0, 0.02, 0.5, 0.1, 79, omega);
  EXPECT_NEAR(waves[0].sine, 6.917021743094e-3, 1e-15);
  std::vector<double> u0;
  for (int i = 0; i < 200; ++i) {
    const double x = centre(i, 200, 1.0);
    u0.push_back(0.02 * std::exp(-100.0 * (x - 0.5) * (x - 0.5)));
    EXPECT_NEAR(displacement(waves, x, 0.0), u0.back(), 1e-12);
  }
  const auto lattice = released_lattice(Ends::mirror, 1.0, u0, omega);
  for (std::size_t n = 0; n < 40; ++n) EXPECT_NEAR(lattice[n].sine, waves[n].sine, 1e-12);
  // Independent evaluation of the series, 11 digits.
  EXPECT_NEAR(displacement(waves, 0.5, 0.05e-3), -1.0654528694e-04, 1e-13);
  EXPECT_NEAR(displacement(waves, 0.5, 0.10e-3), 1.1214148057e-06, 1e-13);
  EXPECT_NEAR(displacement(waves, 0.5, 0.15e-3), -4.2841368516e-04, 1e-13);
  EXPECT_NEAR(displacement(waves, 0.5, 0.20e-3), -1.5438744622e-02, 1e-12);
}

TEST(WaveInBar, StrainIsTheDifferenceOfDisplacements) {
  const auto mixed = released_lattice(Ends::mixed, 1.0, some_displacements(10), [](double k) { return k; });
  const auto even =
      released_lattice(Ends::antimirror, 1.0, some_displacements(10), [](double k) { return k; });
  for (const auto& waves : {mixed, even})
    EXPECT_NEAR(strain(waves, 0.31, 0.47, 0.8),
                (displacement(waves, 0.47, 0.8) - displacement(waves, 0.31, 0.8)) / 0.16, 1e-12);
}

// The strain of the sum of classical quarter waves tends to the square waves where they do not jump:
// [bouaraquia2024] eq. (56).
TEST(WaveInBar, SnappedBarIsTheSeriesSummed) {
  const double length = 2.0, speed = 3.0;
  const auto series = [&](double x, double t) {
    double sum = 0.0;
    for (int n = 0; n < 20000; ++n) {
      const double k = (2 * n + 1) * pi / (2.0 * length);
      sum += (n % 2 == 0 ? 1.0 : -1.0) / (2 * n + 1) * std::cos(k * x) * std::cos(k * speed * t);
    }
    return 4.0 / pi * sum;
  };
  for (const double x : {0.0, 0.7, 1.3})
    for (const double t : {0.05, 0.3, 0.95, 1.45, 2.2, 5.3})
      EXPECT_NEAR(snapped_bar_strain(length, speed, x, t), series(x, t), 1e-3);  // rest of the series
  EXPECT_EQ(snapped_bar_strain(1.0, 1.0, 0.5, 0.5), 0.5);                        // at the jump
}

TEST(WaveInBar, APeriodicBarIsRefused) {
  EXPECT_THROW((void)released_lattice(Ends::periodic, 1.0, std::vector{1.0, 2.0}, [](double k) { return k; }),
               Error);
}

}  // namespace
}  // namespace perimode
