// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/geometry/grid.hpp"

#include <gtest/gtest.h>

#include "perimode/geometry/particles.hpp"

namespace perimode {
namespace {

TEST(Grid, PutsParticlesAtCellCentres) {
  const auto grid = make_grid<2>({1.0, 2.0}, {2.0, 2.5}, 0.25);
  EXPECT_EQ(grid.count(), 8);
  const auto p = grid_particles(grid, 0.1);
  EXPECT_NEAR(p.position[5][0], 1.375, 1e-15);  // cell (1, 1)
  EXPECT_NEAR(p.position[5][1], 2.375, 1e-15);
  EXPECT_NEAR(p.volume[5], 0.25 * 0.25 * 0.1, 1e-18);
}

TEST(Grid, AcceptsSpacingsThatRoundBadly) {
  EXPECT_EQ(make_grid<1>({0.0}, {1.0}, 0.1).count(), 10);
  EXPECT_EQ(make_grid<1>({0.0}, {0.3}, 0.1).count(), 3);
}

TEST(Grid, RefusesAFractionOfACell) {
  EXPECT_THROW((void)make_grid<1>({0.0}, {1.0}, 0.3), Error);
  EXPECT_THROW((void)make_grid<1>({0.0}, {0.0}, 0.3), Error);
  EXPECT_THROW((void)make_grid<1>({0.0}, {1.0}, -0.1), Error);
  EXPECT_THROW((void)make_grid<2>({0.0}, {1.0}, 0.1), Error);
}

TEST(Grid, RefusesMoreParticlesThanIndicesHold) {
  EXPECT_THROW((void)make_grid<3>({0, 0, 0}, {1, 1, 1}, 1.0 / 2000), Error);
}

class Select : public testing::Test {
 protected:
  Particles<2> plate = grid_particles(make_grid<2>({0, 0}, {1.0, 0.5}, 0.1), 1.0);
  std::size_t size(const Region& r) const { return select(r, plate).size(); }
};

TEST_F(Select, FaceTakesWholeLayers) {
  EXPECT_EQ(size({FaceRegion{{0, false}, 2, 0.0}}), 10U);
  EXPECT_EQ(size({FaceRegion{{1, true}, 1, 0.0}}), 10U);
}

TEST_F(Select, BoxAndBallHoldCentresOnTheirEdge) {
  EXPECT_EQ(size({BoxRegion{{0.05, 0.05}, {0.25, 0.15}}}), 6U);
  EXPECT_EQ(size({BallRegion{{0.55, 0.25}, 0.1}}), 5U);
}

TEST_F(Select, NearestTieGoesToTheHigherCoordinate) {
  const auto chosen = select({NearestRegion{{0.5, 0.2}}}, plate);  // four centres at equal distance
  ASSERT_EQ(chosen.size(), 1U);
  EXPECT_NEAR(plate.position[chosen[0]][0], 0.55, 1e-12);
  EXPECT_NEAR(plate.position[chosen[0]][1], 0.25, 1e-12);
}

TEST_F(Select, UnknownBlockAndWrongDimensionAreErrors) {
  EXPECT_THROW((void)size({BlockRegion{"rivet"}}), Error);
  EXPECT_THROW((void)size({BallRegion{{0.1}, 0.1}}), Error);
  EXPECT_THROW((void)size({FaceRegion{{2, false}, 1, 0.0}}), Error);
  EXPECT_THROW((void)size({FaceRegion{{0, false}, 0, 0.1}}), Error);
}

TEST_F(Select, RemovingKeepsCellsOfTheRest) {
  const auto left = without(plate, select({BallRegion{{0.55, 0.25}, 0.1}}, plate));
  EXPECT_EQ(left.count(), 45);
  for (Index i = 0; i < left.count(); ++i) {
    EXPECT_NEAR((left.position[i] - left.grid->centre(left.grid->cell(left.cell[i]))).norm(), 0.0, 1e-15);
  }
}

}  // namespace
}  // namespace perimode
