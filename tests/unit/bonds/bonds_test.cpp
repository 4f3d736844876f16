// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/bonds/bonds.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "perimode/bonds/connectivity.hpp"
#include "perimode/core/error.hpp"

namespace perimode {
namespace {

template <int Dim>
Particles<Dim> box(std::vector<int> cells) {
  Coordinates low(Dim, 0.0);
  Coordinates high(cells.begin(), cells.end());
  return grid_particles(make_grid<Dim>(low, high, 1.0), 1.0);
}

TEST(GridBonds, OpenBoxHasTheKnownNumberOfBonds) {
  const auto p = box<2>({200, 200});
  const Bonds<2> b = make_grid_bonds(p, make_family<2>(1.0, 3.0, VolumeCorrection::none), {});
  EXPECT_EQ(count_bonds(b, p.count()), 552818);  // peri reference: 2D, 200^2, m = 3
}

TEST(GridBonds, BothEndsHoldTheBond) {
  const auto p = box<2>({7, 5});
  const Bonds<2> b =
      make_grid_bonds(p, make_family<2>(1.0, 2.0, VolumeCorrection::none),
                      {Beyond::periodic_image, Beyond::periodic_image, Beyond::nothing, Beyond::nothing});
  std::map<std::pair<Index, Index>, int> ends;
  for (Index i = 0; i < p.count(); ++i) {
    for_each_bond(b, i, Which::alive, [&](const BondEnd<2>& e) { ++ends[{i, e.neighbour}]; });
  }
  for (const auto& [pair, count] : ends) EXPECT_EQ(ends.at({pair.second, pair.first}), count);
}

TEST(GridBonds, ThinPeriodicBodyHasEveryImage) {
  const auto p = box<1>({2});
  const Bonds<1> b = make_grid_bonds(p, make_family<1>(1.0, 3.0, VolumeCorrection::none),
                                     {Beyond::periodic_image, Beyond::periodic_image});
  int other = 0;
  int own = 0;
  for_each_bond(b, 0, Which::present, [&](const BondEnd<1>& e) { ++(e.neighbour == 0 ? own : other); });
  EXPECT_EQ(other, 4);  // at -3, -1, 1, 3
  EXPECT_EQ(own, 2);    // at -2, 2: in calibration only
  EXPECT_EQ(count_bonds(b, 2), 4);
}

TEST(GridBonds, GhostsAreMirrorImages) {
  const auto p = box<2>({4, 3});
  const auto b = make_grid_bonds(p, make_family<2>(1.0, 2.0, VolumeCorrection::none),
                                 {Beyond::ghosts, Beyond::nothing, Beyond::ghosts, Beyond::nothing});
  ASSERT_EQ(b.ghosts.size(), 4U * 2U + 3U * 2U + 4U);
  for (const auto& g : b.ghosts) {
    Point<2> mirrored = g.position;
    for (int a = 0; a < 2; ++a) mirrored[a] = std::abs(mirrored[a]);
    EXPECT_NEAR((mirrored - p.position[g.image]).norm(), 0.0, 1e-12);
  }
}

TEST(GridBonds, AHoleIsMirroredWithTheBody) {
  auto p = box<2>({4, 4});
  p = without(p, {0});
  const auto b = make_grid_bonds(p, make_family<2>(1.0, 1.0, VolumeCorrection::none),
                                 {Beyond::ghosts, Beyond::nothing, Beyond::nothing, Beyond::nothing});
  EXPECT_EQ(b.ghosts.size(), 3U);
}

TEST(GridBonds, OneSidedPeriodIsAnError) {
  const auto p = box<1>({4});
  EXPECT_THROW((void)make_grid_bonds(p, make_family<1>(1.0, 1.0, VolumeCorrection::none),
                                     {Beyond::periodic_image, Beyond::nothing}),
               Error);
}

TEST(CutBonds, CountEqualsHandCountOfALattice) {
  const auto p = box<2>({10, 10});
  Bonds<2> b = make_grid_bonds(p, make_family<2>(1.0, 1.0, VolumeCorrection::none), {});
  const Crack<2> crack{{Point<2>(5.0, 0.0), Point<2>(5.0, 4.0)}, {}};
  EXPECT_EQ(cut_bonds(b, p, {crack}, 1.0), 4);
}

TEST(CutBonds, CrackThroughAPeriodicFaceCutsImages) {
  const auto p = box<2>({6, 6});
  Bonds<2> b =
      make_grid_bonds(p, make_family<2>(1.0, 1.0, VolumeCorrection::none),
                      {Beyond::periodic_image, Beyond::periodic_image, Beyond::nothing, Beyond::nothing});
  const Crack<2> crack{{Point<2>(0.0, 0.0), Point<2>(0.0, 6.0)}, {}};
  EXPECT_EQ(cut_bonds(b, p, {crack}, 1.0), 6);
}

TEST(CutBonds, CrackMeetingAMirrorHasNoTipThere) {
  // Horizon 2: the bond from (4.5, 0.5) to the ghost at (5.5, -0.5) crosses x = 5 at y = 0, where crack and
  // image meet.
  const auto p = box<2>({10, 10});
  Bonds<2> b = make_grid_bonds(p, make_family<2>(1.0, 2.0, VolumeCorrection::none),
                               {Beyond::nothing, Beyond::nothing, Beyond::ghosts, Beyond::nothing});
  cut_bonds(b, p, {Crack<2>{{Point<2>(5.0, 0.0), Point<2>(5.0, 4.0)}, {}}}, 1.0);
  for_each_bond(b, 4, Which::alive, [&](const BondEnd<2>& e) { EXPECT_LT(4.5 + e.xi[0], 5.0); });
}

TEST(BreakBond, TakesBothEnds) {
  const auto p = box<2>({8, 8});
  Bonds<2> b = make_grid_bonds(p, make_family<2>(1.0, 3.0, VolumeCorrection::none), {});
  const Offset before = count_bonds(b, p.count());
  Offset slot = -1;
  Index partner = -1;
  for_each_bond(b, 20, Which::alive, [&](const BondEnd<2>& e) { slot = e.slot, partner = e.neighbour; });
  break_bond(b, 20, slot);
  EXPECT_EQ(count_bonds(b, p.count()), before - 1);
  for_each_bond(b, partner, Which::alive, [&](const BondEnd<2>& e) { EXPECT_NE(e.neighbour, 20); });
  break_bond(b, 20, slot);
  EXPECT_EQ(count_bonds(b, p.count()), before - 1);
}

Particles<3> random_cloud(int n) {
  std::mt19937 gen(7);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  Particles<3> p;
  for (int i = 0; i < n; ++i) {
    p.position.emplace_back(u(gen), u(gen), u(gen));
    p.volume.push_back((0.5 + u(gen)) / n);
    p.block.push_back(0);
  }
  return p;
}

TEST(CloudBonds, EqualBruteForce) {
  const auto p = random_cloud(300);
  const auto horizon = cloud_horizons(p, 12);
  const auto b = make_cloud_bonds(p, horizon, VolumeCorrection::none, 1.0);
  for (Index i = 0; i < p.count(); ++i) {
    std::vector<Index> expected;
    for (Index j = 0; j < p.count(); ++j) {
      const double r = (p.position[i] - p.position[j]).norm();
      if (i != j && r <= std::max(horizon[i], horizon[j]) * (1 + 1e-9)) expected.push_back(j);
    }
    const std::vector<Index> got(b.neighbour.begin() + b.start[i], b.neighbour.begin() + b.start[i + 1]);
    EXPECT_EQ(got, expected);
  }
}

TEST(CloudBonds, HorizonIsTheDistanceToTheNthNeighbour) {
  const auto p = random_cloud(100);
  const auto horizon = cloud_horizons(p, 5);
  for (Index i = 0; i < p.count(); ++i) {
    std::multiset<double> r;
    for (Index j = 0; j < p.count(); ++j) {
      if (i != j) r.insert((p.position[i] - p.position[j]).norm());
    }
    EXPECT_NEAR(horizon[i], *std::next(r.begin(), 4), 1e-14);
  }
}

TEST(CloudBonds, WeightsAreSymmetric) {
  const auto p = random_cloud(200);
  const Bonds<3> b = make_cloud_bonds(p, cloud_horizons(p, 10), VolumeCorrection::linear, 1.0);
  std::map<std::pair<Index, Index>, double> weight;
  for (Index i = 0; i < p.count(); ++i) {
    for_each_bond(b, i, Which::alive, [&](const BondEnd<3>& e) { weight[{i, e.neighbour}] = e.weight; });
  }
  for (const auto& [pair, w] : weight) EXPECT_EQ(weight.at({pair.second, pair.first}), w);
}

TEST(CloudBonds, AGridAsACloudHasTheBondsOfTheGrid) {
  auto p = box<2>({12, 9});
  const Bonds<2> grid = make_grid_bonds(p, make_family<2>(1.0, 3.0, VolumeCorrection::none), {});
  const Bonds<2> cloud =
      make_cloud_bonds(p, std::vector<double>(p.count(), 3.0), VolumeCorrection::none, 1.0);
  EXPECT_EQ(count_bonds(grid, p.count()), count_bonds(cloud, p.count()));
}

TEST(Pieces, ACrackThroughTheBodyMakesTwo) {
  const auto p = box<2>({10, 6});
  Bonds<2> b = make_grid_bonds(p, make_family<2>(1.0, 3.0, VolumeCorrection::none), {});
  EXPECT_EQ(find_pieces(b, p.count()).count, 1);
  cut_bonds(b, p, {Crack<2>{{Point<2>(4.0, -1.0), Point<2>(4.0, 7.0)}, {}}}, 1.0);
  const auto pieces = find_pieces(b, p.count());
  EXPECT_EQ(pieces.count, 2);
  EXPECT_EQ(pieces.isolated, 0);
  EXPECT_NE(pieces.of[3], pieces.of[4]);
}

}  // namespace
}  // namespace perimode
