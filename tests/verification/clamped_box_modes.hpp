// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "verification/clamped_boxes.hpp"
#include "verification/modes_of.hpp"

namespace perimode::test {

/// Block Lanczos on the boxes of that size, without and with volume correction.
template <int Dim>
void expect_clamped_box(int cells, double relative) {
  int compared = 0;
  for (const ClampedBox& box : clamped_boxes()) {
    if (box.dimension != Dim || box.cells != cells) continue;
    ++compared;
    Model m = box_model(std::vector<int>(Dim, cells), 1.0 / cells, 3.0);
    m.volume_correction = box.linear ? VolumeCorrection::linear : VolumeCorrection::none;
    const std::vector<int> all = {0, 1, 2};
    for (int axis = 0; axis < Dim; ++axis) {
      for (bool upper : {false, true}) fix_face(m, axis, upper, 3, {all.begin(), all.begin() + Dim});
    }
    const auto r = certified_modes<Dim>(m, lowest(20, ModalSolver::lanczos));
    ASSERT_EQ(r.count(), 20);
    for (int k = 0; k < 20; ++k) {
      const double exact = box.eigenvalue[static_cast<std::size_t>(k)];
      EXPECT_NEAR(r.eigenvalue[k], exact, relative * exact) << "mode " << k + 1 << " linear " << box.linear;
    }
  }
  EXPECT_EQ(compared, 2);
}

}  // namespace perimode::test
