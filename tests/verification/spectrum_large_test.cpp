// SPDX-License-Identifier: BSD-3-Clause
// The runs of the plate of [alebrahim2021] at their full size.
#include <gtest/gtest.h>

#include "verification/recorded_waves.hpp"

namespace perimode {
namespace {

TEST(RunSpectrumLarge, PlateOf96CellsMeetsBothBranchesOnTheContour) {
  for (const double ratio : {2.0, 3.0}) {
    const test::Deviation worst = test::contour_deviation(96, 2048, ratio);
    RecordProperty(ratio < 2.5 ? "bins_2" : "bins_3", std::to_string(worst.bins));
    EXPECT_LE(worst.bins, 0.02) << "N = " << ratio;
    EXPECT_GE(worst.compared, 240) << "N = " << ratio;
  }
}

}  // namespace
}  // namespace perimode
