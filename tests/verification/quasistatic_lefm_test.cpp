// SPDX-License-Identifier: BSD-3-Clause
// The crack opening of [ganzenmueller2013] with our parameters against numbers of an independent NumPy
// computation, and against linear elastic fracture mechanics.
#include <gtest/gtest.h>

#include <map>

#include "studies/common/crack_opening.hpp"

namespace perimode {
namespace {

using studies::crack_opening_patch;
using studies::crack_opening_run;
using studies::crack_opening_stress;
using studies::opening_crack;

QuasistaticResult open_crack(int cells, const std::function<void(QuasistaticOptions&)>& change) {
  const Model model = crack_opening_patch(cells, 3.0, Calibration::discrete);
  Body<2> body = build_body<2>(model);
  QuasistaticOptions options = crack_opening_run(model, body);
  change(options);
  return run_quasistatic<2>(body, options);
}

TEST(CrackOpening, ReferenceStressIsThatOfTada) {
  EXPECT_NEAR(crack_opening_stress(opening_crack), 146.9066802, 5e-8);
}

TEST(CrackOpening, FirstFailureAndPeakAreThoseOfTheIndependentComputation) {
  struct Row {
    int cells;
    double first, peak;
  };
  for (const Row& row : {Row{24, 1.0576494685, 1.1325}, Row{40, 1.0656408346, 1.1572}}) {
    const QuasistaticResult r = open_crack(row.cells, [](QuasistaticOptions& o) { o.stop.load_drop = 0.3; });
    EXPECT_EQ(r.status, QuasistaticStatus::load_drop);
    const double lefm = crack_opening_stress(opening_crack);
    EXPECT_NEAR(r.first_load / lefm, row.first, 1e-6 * row.first);
    EXPECT_NEAR(r.peak_load / lefm, row.peak, 5e-5);  // digits given
    EXPECT_LE(r.worst_balance, 1e-10);
  }
}

/// Loads of the Griffith criterion by compliance over LEFM in the middle of the increment; they converge.
const std::map<int, double> griffith = {{24, .967065}, {40, .980675}, {60, .987912}, {80, .991660}};

void expect_griffith(int coarse, int fine) {
  std::map<int, double> found;
  for (const int cells : {coarse, fine}) {
    const QuasistaticResult r = open_crack(cells, [](QuasistaticOptions& o) {
      o.griffith = true;
      o.stop.events = 1;
    });
    ASSERT_TRUE(r.griffith.has_value());
    EXPECT_EQ(r.griffith->cut, 18);  // sum of the rows that bonds span, over all bonds within the horizon
    EXPECT_NEAR(r.griffith->fracture_energy, 0.358, 1e-12);
    found[cells] = studies::griffith_ratio(*r.griffith, cells);
    EXPECT_NEAR(found[cells], griffith.at(cells), 1e-4);
  }
  const double slope = (found[coarse] - found[fine]) / (1.0 / coarse - 1.0 / fine);
  EXPECT_NEAR(found[fine] - slope / fine, 1.0, 0.01);
}

TEST(CrackOpening, GriffithLoadConvergesToLinearElasticFractureMechanics) { expect_griffith(24, 40); }

TEST(CrackOpeningLarge, GriffithLoadConvergesToLinearElasticFractureMechanics) { expect_griffith(60, 80); }

}  // namespace
}  // namespace perimode
