// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "unit/statics/loaded_models.hpp"

namespace perimode {
namespace {

using test::add_wall;
using test::box_model;
using test::cantilever;
using test::end_load;
using test::face;
using test::fix_face;
using test::loaded;
using test::prescribe;
using test::solved;

TEST(Reactions, OfTheOnlySupportAreTheLoads) {
  const StaticResult r = solved<2>(cantilever(), loaded(end_load()));
  ASSERT_EQ(r.reactions.size(), 1U);
  EXPECT_EQ(r.reactions[0].region, "fix x-");
  EXPECT_NEAR(r.reactions[0].force[0], -2e-3 * 0.8, 1e-13);
  EXPECT_NEAR(r.reactions[0].force[1], 1e-3 * 0.8, 1e-13);
}

TEST(Reactions, ADofInTwoRegionsCountsForTheFirst) {
  Model m = cantilever();
  fix_face(m, 0, false, 2, {0});  // the same particles again: nothing is left to take
  prescribe(m, {{1, 0.0}}, Region{BoxRegion{{0.0, 0.0}, {1.2, 0.1}}, {}});
  m.boundary.push_back({Fix{{0}, Region{BallRegion{{0.85, 0.45}, 0.06}, {}}}, {}});
  const StaticResult r = solved<2>(m, loaded(end_load()));
  ASSERT_EQ(r.reactions.size(), 4U);
  EXPECT_EQ(r.reactions[1].region, "fix x- 2");
  EXPECT_EQ(r.reactions[1].force[0], 0.0);
  EXPECT_EQ(r.reactions[2].region, "prescribe box");
  EXPECT_NE(r.reactions[2].force[1], 0.0);
  EXPECT_EQ(r.reactions[2].force[0], 0.0);
  EXPECT_EQ(r.reactions[3].region, "fix ball");
}

TEST(Reactions, OfAMirrorAreTheForceTheOtherHalfWouldExert) {
  // A bar of 2 x 10 particles pulled apart: across the middle passes the whole force, and no shear.
  Model half = box_model({10, 6}, 0.1, 3.0);
  half.volume_correction = VolumeCorrection::linear;
  add_wall(half, 0, false, WallType::mirror);
  half.boundary.push_back({Fix{{1}, Region{NearestRegion{{0.0, 0.29}}, {}}}, {}});
  const StaticResult r = solved<2>(half, loaded({{Traction{{1e-3, 0.0}}, face(0, true, 1)}}));
  ASSERT_EQ(r.reactions.size(), 2U);
  EXPECT_EQ(r.reactions[0].region, "wall x-");
  EXPECT_NEAR(r.reactions[0].force[0], -1e-3 * 0.6, 1e-14);
  EXPECT_NEAR(r.reactions[0].force[1], 0.0, 1e-14);
  EXPECT_NEAR(r.reactions[1].force[1], 0.0, 1e-14);
}

TEST(Reactions, GhostsBeyondACornerCountForTheWallNamedFirst) {
  const auto with = [](std::vector<int> axes) {
    Model m = box_model({8, 8}, 0.1, 3.0);
    for (int axis : axes) add_wall(m, axis, false, WallType::mirror);
    return solved<2>(
        m, loaded({{Traction{{1e-3, 0.0}}, face(0, true, 1)}, {Traction{{0.0, 2e-3}}, face(1, true, 1)}}));
  };
  const StaticResult xy = with({0, 1});
  const StaticResult yx = with({1, 0});
  ASSERT_EQ(xy.reactions[0].region, "wall x-");
  ASSERT_EQ(yx.reactions[0].region, "wall y-");
  for (int a = 0; a < 2; ++a) {
    const std::size_t c = static_cast<std::size_t>(a);
    const double sum = xy.reactions[0].force[c] + xy.reactions[1].force[c];
    EXPECT_NEAR(sum, yx.reactions[0].force[c] + yx.reactions[1].force[c], 1e-15);
    EXPECT_NEAR(sum, a == 0 ? -0.8e-3 : -1.6e-3, 1e-14);
  }
}

TEST(Reactions, GivenDofsThatNoConditionNamesAreOther) {
  Model m = box_model({6, 5}, 0.1, 2.0);
  auto body = build_body<2>(m);
  auto& map = body.boundary;
  map.free = 0;
  for (std::size_t d = 0; d < map.free_number.size(); ++d) {
    const bool left = body.particles.position[d / 2][0] < 0.2;
    map.free_number[d] = left ? -1 : map.free++;
  }
  const StaticResult r = solve_static(body, {}, loaded({{BodyForce{{0.0, -1.0}}}}));
  ASSERT_EQ(r.reactions.size(), 1U);
  EXPECT_EQ(r.reactions[0].region, "other");
  EXPECT_NEAR(r.reactions[0].force[1], 0.3, 1e-13);
}

}  // namespace
}  // namespace perimode
