// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/bonds/family.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "perimode/core/error.hpp"

namespace perimode {
namespace {

TEST(Family, CountsOfTheLattice) {
  EXPECT_EQ(make_family<1>(0.1, 0.3, VolumeCorrection::none).size(), 6);
  EXPECT_EQ(make_family<2>(0.1, 0.3, VolumeCorrection::none).size(), 28);
  EXPECT_EQ(make_family<3>(0.1, 0.3, VolumeCorrection::none).size(), 122);
  EXPECT_EQ(make_family<2>(0.1, 0.3, VolumeCorrection::linear).size(), 36);
  EXPECT_EQ(make_family<3>(0.1, 0.2, VolumeCorrection::linear).size(), 80);
  EXPECT_EQ(make_family<3>(0.1, 0.3, VolumeCorrection::linear).size(), 178);
}

TEST(Family, TiesAtTheHorizonBelongForAwkwardSpacings) {
  for (double spacing : {0.1, 1.0 / 3.0, 0.7, 1e-6, 123.456}) {
    EXPECT_EQ(make_family<2>(spacing, 3.0 * spacing, VolumeCorrection::none).size(), 28) << spacing;
    EXPECT_EQ(make_family<2>(spacing, 5.0 * spacing, VolumeCorrection::none).size(), 80) << spacing;
  }
}

TEST(Family, OppositeMembersMirrorTheOrder) {
  const auto f = make_family<3>(1.0, 2.5, VolumeCorrection::linear);
  for (int k = 0; k < f.size(); ++k) {
    for (int a = 0; a < 3; ++a) EXPECT_EQ(f.offset[k][a], -f.offset[f.size() - 1 - k][a]);
  }
}

TEST(Family, EndBondsOfTheBarCountHalf) {
  for (auto correction : {VolumeCorrection::linear, VolumeCorrection::exact}) {
    const auto f = make_family<1>(0.1, 0.3, correction);
    ASSERT_EQ(f.size(), 6);
    EXPECT_NEAR(f.weight.front(), 0.5, 1e-12);
    EXPECT_NEAR(f.weight[1], 1.0, 1e-12);
  }
}

TEST(Family, SelfCellAddsHalfToTheNearest) {
  const auto f = make_family<1>(0.1, 0.3, VolumeCorrection::linear, true);
  EXPECT_NEAR(f.weight[2], 1.5, 1e-12);
  EXPECT_NEAR(f.weight[3], 1.5, 1e-12);
  EXPECT_NEAR(f.weight[1], 1.0, 1e-12);
}

TEST(Family, OrbitsTellEqualLengthsApart) {
  const auto f = make_family<3>(1.0, 3.0, VolumeCorrection::none);
  const auto orbit = [&](std::array<int, 3> o) {
    return f.orbit[std::find(f.offset.begin(), f.offset.end(), o) - f.offset.begin()];
  };
  EXPECT_NE(orbit({3, 0, 0}), orbit({2, 2, 1}));
  EXPECT_EQ(orbit({-1, 2, 2}), orbit({2, 2, 1}));
}

TEST(Family, AHorizonShorterThanTheSpacingIsAnError) {
  EXPECT_THROW((void)make_family<2>(1.0, 0.9, VolumeCorrection::none), Error);
}

}  // namespace
}  // namespace perimode
