// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/geometry/crack.hpp"

#include <gtest/gtest.h>

namespace perimode {
namespace {

constexpr double tol = 1e-9;

Crack<2> segment(double x0, double y0, double x1, double y1) {
  return {{Point<2>(x0, y0), Point<2>(x1, y1)}, {false, false}};
}

TEST(Crack, CutsBondsThatCrossItsInterior) {
  const auto c = segment(0, 0, 0, 1);
  EXPECT_TRUE(crosses<2>(c, {-1, 0.5}, {1, 0.5}, tol));
  EXPECT_TRUE(crosses<2>(c, {1, 0.2}, {-1, 0.9}, tol));
  EXPECT_FALSE(crosses<2>(c, {-1, 1.5}, {1, 1.5}, tol));
  EXPECT_FALSE(crosses<2>(c, {-2, 0.5}, {-1, 0.5}, tol));
}

TEST(Crack, TouchingTheTipDoesNotCut) {
  const auto c = segment(0, 0, 0, 1);
  EXPECT_FALSE(crosses<2>(c, {-1, 1}, {1, 1}, tol));
  EXPECT_FALSE(crosses<2>(c, {-1, 1 - 0.5e-9}, {1, 1 - 0.5e-9}, tol));
  EXPECT_TRUE(crosses<2>(c, {-1, 1 - 2e-9}, {1, 1 - 2e-9}, tol));
}

TEST(Crack, AParticleOnItCountsOnTheLeft) {
  const auto c = segment(0, 0, 0, 1);  // left normal: -x
  EXPECT_FALSE(crosses<2>(c, {0, 0.5}, {-1, 0.5}, tol));
  EXPECT_TRUE(crosses<2>(c, {0, 0.5}, {1, 0.5}, tol));
  EXPECT_TRUE(crosses<2>(c, {1, 0.5}, {0, 0.5}, tol));
}

TEST(Crack, ReflectionMirrorsThePositiveSide) {
  const auto image = reflected<2>(segment(1, 0, 1, 1), 0, 0.0);  // at x = -1, positive side now +x
  EXPECT_FALSE(crosses<2>(image, {-1, 0.5}, {-0.5, 0.5}, tol));
  EXPECT_TRUE(crosses<2>(image, {-1, 0.5}, {-1.5, 0.5}, tol));
}

TEST(Crack, JoinedEndsAreNoTips) {
  std::vector<Crack<2>> pair = {segment(0, 0, 0, 1), segment(0, 0, 0, -1)};
  EXPECT_FALSE(crosses<2>(pair[0], {-1, 0}, {1, 0}, tol));
  join(pair, tol);
  EXPECT_TRUE(crosses<2>(pair[0], {-1, 0}, {1, 0}, tol));
  EXPECT_FALSE(crosses<2>(pair[0], {-1, 1}, {1, 1}, tol));
}

TEST(Crack, OneDimensionIsAPoint) {
  const Crack<1> c{{Point<1>(0.5)}, {false}};
  EXPECT_TRUE(crosses<1>(c, Point<1>(0.4), Point<1>(0.6), tol));
  EXPECT_FALSE(crosses<1>(c, Point<1>(0.5), Point<1>(0.6), tol));  // on it: the positive side
  EXPECT_TRUE(crosses<1>(c, Point<1>(0.4), Point<1>(0.5), tol));
}

TEST(Crack, PolygonCutsInsideOnly) {
  const Crack<3> l{{Point<3>(0, 0, 0), Point<3>(2, 0, 0), Point<3>(2, 1, 0), Point<3>(1, 1, 0),
                    Point<3>(1, 2, 0), Point<3>(0, 2, 0)},
                   std::vector<bool>(6, false)};  // an L: not convex
  EXPECT_TRUE(crosses<3>(l, {0.5, 1.5, -1}, {0.5, 1.5, 1}, tol));
  EXPECT_FALSE(crosses<3>(l, {1.5, 1.5, -1}, {1.5, 1.5, 1}, tol));
  EXPECT_FALSE(crosses<3>(l, {1.5, 1.0, -1}, {1.5, 1.0, 1}, tol));  // through the front
  EXPECT_TRUE(crosses<3>(l, {1.0, 0.5, -1}, {1.0, 0.5, 1}, tol));
}

}  // namespace
}  // namespace perimode
