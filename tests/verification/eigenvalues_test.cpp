// SPDX-License-Identifier: BSD-3-Clause
#include "verification/clamped_box_modes.hpp"

namespace perimode {
namespace {

TEST(ClampedBoxes, BarHasTheEigenvaluesOfAnIndependentComputation) {
  test::expect_clamped_box<1>(1000, 1e-10);
}
TEST(ClampedBoxes, LongBarHasTheEigenvaluesOfAnIndependentComputation) {
  test::expect_clamped_box<1>(10000, 1e-9);
}
TEST(ClampedBoxes, PlateHasTheEigenvaluesOfAnIndependentComputation) {
  test::expect_clamped_box<2>(40, 1e-10);
}
TEST(ClampedBoxes, BlockHasTheEigenvaluesOfAnIndependentComputation) {
  test::expect_clamped_box<3>(14, 1e-10);
}

}  // namespace
}  // namespace perimode
