// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <map>

#include "studies/common/crack_opening.hpp"

namespace perimode::test {

/// The patch of studies/common/crack_opening.hpp, normalised constants, horizon of 3 spacings, pulled open.
inline QuasistaticResult open_crack(int cells, const std::function<void(QuasistaticOptions&)>& change) {
  const Model model = studies::crack_opening_patch(cells, 3.0, Calibration::discrete);
  Body<2> body = build_body<2>(model);
  QuasistaticOptions options = studies::crack_opening_run(model, body);
  change(options);
  return run_quasistatic<2>(body, options);
}

/// Loads of the Griffith criterion by compliance over LEFM in the middle of the increment; they converge.
inline const std::map<int, double> griffith_ratios = {
    {24, .967065}, {40, .980675}, {60, .987912}, {80, .991660}};

/// Those of two spacings, and where they tend to.
inline void expect_griffith(int coarse, int fine) {
  std::map<int, double> found;
  for (const int cells : {coarse, fine}) {
    const GriffithLoad r =
        studies::crack_opening_griffith(studies::crack_opening_patch(cells, 3.0, Calibration::discrete));
    EXPECT_EQ(r.cut, 18);  // sum of the rows that bonds span, over all bonds within the horizon
    EXPECT_NEAR(r.fracture_energy, 0.358, 1e-12);
    found[cells] = studies::griffith_ratio(r, cells);
    EXPECT_NEAR(found[cells], griffith_ratios.at(cells), 1e-4);
  }
  const double slope = (found[coarse] - found[fine]) / (1.0 / coarse - 1.0 / fine);
  EXPECT_NEAR(found[fine] - slope / fine, 1.0, 0.01);
}

}  // namespace perimode::test
