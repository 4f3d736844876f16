// SPDX-License-Identifier: BSD-3-Clause
// Bonds of clouds that repeat themselves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "perimode/bonds/bonds.hpp"
#include "perimode/bonds/connectivity.hpp"
#include "perimode/core/error.hpp"

namespace perimode {
namespace {

template <int Dim>
Particles<Dim> random_cloud(int n, const Point<Dim>& size, unsigned seed) {
  std::mt19937 gen(seed);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  Particles<Dim> p;
  for (int i = 0; i < n; ++i) {
    Point<Dim> x;
    for (int a = 0; a < Dim; ++a) x[a] = size[a] * u(gen) - 0.3;
    p.position.push_back(x);
    p.volume.push_back((0.5 + u(gen)) * size.prod() / n);
    p.block.push_back(0);
  }
  return p;
}

/// Calls visit(x_j + image - x_i) for the images of j up to two periods away.
template <int Dim, class Visit>
void for_each_apart(const Point<Dim>& xi, const Point<Dim>& period, const Visit& visit, int axis = 0) {
  if (axis == Dim) {
    visit(xi);
    return;
  }
  const int most = period[axis] > 0.0 ? 2 : 0;
  for (int s = -most; s <= most; ++s) {
    Point<Dim> shifted = xi;
    shifted[axis] += s * period[axis];
    for_each_apart<Dim>(shifted, period, visit, axis + 1);
  }
}

template <int Dim>
std::vector<double> brute_horizons(const Particles<Dim>& p, int neighbours, const Point<Dim>& period) {
  std::vector<double> horizon;
  for (Index i = 0; i < p.count(); ++i) {
    std::vector<double> r;
    for (Index j = 0; j < p.count(); ++j) {
      for_each_apart<Dim>(p.position[j] - p.position[i], period, [&](const Point<Dim>& xi) {
        if (xi.norm() > 0.0) r.push_back(xi.norm());
      });
    }
    std::nth_element(r.begin(), r.begin() + neighbours - 1, r.end());
    horizon.push_back(r[static_cast<std::size_t>(neighbours - 1)]);
  }
  return horizon;
}

/// Bonds and horizons against all pairs of particles and images.
template <int Dim>
void expect_brute_force(int n, const Point<Dim>& size, const Point<Dim>& period, int neighbours) {
  const auto p = random_cloud<Dim>(n, size, 11 + Dim);
  const auto horizon = cloud_horizons(p, neighbours, period);
  const auto expected_horizon = brute_horizons<Dim>(p, neighbours, period);
  for (Index i = 0; i < n; ++i) EXPECT_NEAR(horizon[i], expected_horizon[i], 1e-14 * size.norm());
  const auto b = make_cloud_bonds(p, horizon, VolumeCorrection::none, 1.0, period);
  int through_faces = 0;
  for (Index i = 0; i < n; ++i) {
    Offset slot = b.start[i];
    for (Index j = 0; j < n; ++j) {
      const double reach = std::max(horizon[i], horizon[j]) * (1.0 + 1e-9);
      for_each_apart<Dim>(p.position[j] - p.position[i], period, [&](const Point<Dim>& xi) {
        if (i == j || xi.norm() > reach) return;
        ASSERT_LT(slot, b.start[i + 1]);
        EXPECT_EQ(b.neighbour[slot], j);
        EXPECT_LT((b.xi[slot] - xi).norm(), 1e-14 * size.norm());
        through_faces += (p.position[j] - p.position[i] - xi).norm() > 0.1 ? 1 : 0;
        ++slot;
      });
    }
    EXPECT_EQ(slot, b.start[i + 1]);
  }
  EXPECT_EQ(through_faces > 0, period.norm() > 0.0);
}

TEST(PeriodicCloud, HasTheBondsOfAllImages) {
  expect_brute_force<1>(60, Point<1>(3.0), Point<1>(3.0), 6);
  expect_brute_force<2>(150, {2.0, 1.3}, {2.0, 1.3}, 12);
  expect_brute_force<2>(150, {2.0, 1.3}, {0.0, 1.3}, 12);
  expect_brute_force<2>(150, {2.0, 1.3}, {0.0, 0.0}, 12);
  expect_brute_force<3>(100, {1.0, 1.2, 1.4}, {1.0, 1.2, 1.4}, 6);
  expect_brute_force<3>(100, {1.0, 1.2, 1.4}, {1.3, 0.0, 1.4}, 6);  // a gap before the cloud repeats itself
}

TEST(PeriodicCloud, BothEndsAgreeToTheLastBit) {
  const Point<3> period(1.0, 1.2, 1.4);
  const auto p = random_cloud<3>(200, period, 3);
  const auto b = make_cloud_bonds(p, cloud_horizons(p, 8, period), VolumeCorrection::linear, 1.0, period);
  for (Index i = 0; i < p.count(); ++i) {
    for (Offset e = b.start[i]; e < b.start[i + 1]; ++e) {
      const Index j = b.neighbour[e];
      const auto first = b.neighbour.begin() + b.start[j];
      const auto last = b.neighbour.begin() + b.start[j + 1];
      const auto back = std::lower_bound(first, last, i);
      ASSERT_TRUE(back != last && *back == i);
      const auto other = static_cast<std::size_t>(back - b.neighbour.begin());
      EXPECT_EQ(b.xi[other], Point<3>(-b.xi[e]));
      EXPECT_EQ(b.weight[other], b.weight[e]);
      EXPECT_EQ(b.horizon[other], b.horizon[e]);
    }
  }
}

TEST(PeriodicCloud, DoesNotDependOnWhereItsFacesAre) {
  const Point<2> period(2.0, 1.3);
  auto p = random_cloud<2>(120, period, 5);
  const auto before = make_cloud_bonds(p, cloud_horizons(p, 10, period), VolumeCorrection::none, 1.0, period);
  for (auto& x : p.position) {
    x += Point<2>(0.71, 0.43);
    for (int a = 0; a < 2; ++a)
      if (x[a] > 0.9) x[a] -= period[a];
  }
  const auto after = make_cloud_bonds(p, cloud_horizons(p, 10, period), VolumeCorrection::none, 1.0, period);
  EXPECT_EQ(before.neighbour, after.neighbour);
  for (std::size_t e = 0; e < before.xi.size(); ++e) EXPECT_LT((before.xi[e] - after.xi[e]).norm(), 1e-14);
}

TEST(PeriodicCloud, APeriodThatAdmitsTwoBondsOfAPairIsAnError) {
  const auto p = random_cloud<2>(100, {2.0, 2.0}, 5);
  const std::vector<double> horizon(100, 1.0);
  const auto make = [&](double length, VolumeCorrection correction) {
    return make_cloud_bonds(p, horizon, correction, 1.0, Point<2>(5.0, length));
  };
  EXPECT_NO_THROW((void)make(2.0 + 1e-6, VolumeCorrection::none));
  EXPECT_THROW((void)make(2.0, VolumeCorrection::none), Error);
  EXPECT_THROW((void)make(2.0 + 1e-6, VolumeCorrection::linear), Error);  // reaches half a cell further
  try {
    (void)make(1.9, VolumeCorrection::none);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
    EXPECT_THAT(error.what(), testing::HasSubstr("along y"));
    EXPECT_THAT(error.what(), testing::HasSubstr("1.9 m"));
  }
}

class PeriodicGridAsACloud : public testing::Test {
 protected:
  const Particles<2> particles_ = grid_particles(make_grid<2>({0.0, 0.0}, {12.0, 9.0}, 1.0), 1.0);

  [[nodiscard]] Bonds<2> grid() const {
    std::array<Beyond, 4> beyond;
    beyond.fill(Beyond::periodic_image);
    return make_grid_bonds(particles_, make_family<2>(1.0, 3.0, VolumeCorrection::none), beyond);
  }
  [[nodiscard]] Bonds<2> cloud() const {
    return make_cloud_bonds(particles_, std::vector<double>(108, 3.0), VolumeCorrection::none, 1.0,
                            Point<2>(12.0, 9.0));
  }
  static std::vector<std::pair<Index, Index>> pairs(const Bonds<2>& bonds) {
    std::vector<std::pair<Index, Index>> result;
    for (Index i = 0; i < 108; ++i)
      for_each_bond(bonds, i, Which::alive,
                    [&](const BondEnd<2>& end) { result.emplace_back(i, end.neighbour); });
    std::sort(result.begin(), result.end());
    return result;
  }
};

TEST_F(PeriodicGridAsACloud, HasItsBonds) { EXPECT_EQ(pairs(cloud()), pairs(grid())); }

TEST_F(PeriodicGridAsACloud, HasItsCracks) {
  std::mt19937 gen(9);
  std::uniform_real_distribution<double> u(-3.0, 15.0);
  Offset cut = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const std::vector<Crack<2>> cracks = {{{Point<2>(u(gen), u(gen)), Point<2>(u(gen), u(gen))}, {}},
                                          {{Point<2>(0.0, u(gen)), Point<2>(12.0, 4.0)}, {}}};
    auto of_grid = grid();
    auto of_cloud = cloud();
    const Offset expected = cut_bonds(of_grid, particles_, cracks, 1.0);
    EXPECT_EQ(cut_bonds(of_cloud, particles_, cracks, 1.0), expected);
    EXPECT_EQ(pairs(of_cloud), pairs(of_grid));
    cut += expected;
  }
  EXPECT_GT(cut, 0);
}

TEST_F(PeriodicGridAsACloud, IsInOnePieceUntilTwoCracksPart) {
  auto bonds = cloud();
  const auto across = [](double x) { return Crack<2>{{Point<2>(x, 0.0), Point<2>(x, 9.0)}, {}}; };
  cut_bonds(bonds, particles_, {across(3.0)}, 1.0);
  EXPECT_EQ(find_pieces(bonds, 108).count, 1);  // joined through the faces
  cut_bonds(bonds, particles_, {across(12.0)}, 1.0);
  EXPECT_EQ(find_pieces(bonds, 108).count, 2);
}

TEST_F(PeriodicGridAsACloud, BondsThroughAFaceBreakAtBothEnds) {
  auto bonds = cloud();
  Offset slot = -1;
  for_each_bond(bonds, 0, Which::alive, [&](const BondEnd<2>& end) {
    if (end.neighbour == 11) slot = end.slot;
  });
  ASSERT_GE(slot, 0);
  const Offset before = count_bonds(bonds, 108);
  break_bond(bonds, 0, slot);
  EXPECT_EQ(count_bonds(bonds, 108), before - 1);
  for_each_bond(bonds, 11, Which::alive, [](const BondEnd<2>& end) { EXPECT_NE(end.neighbour, 0); });
}

}  // namespace
}  // namespace perimode
