// SPDX-License-Identifier: BSD-3-Clause
// The crack opening of [ganzenmueller2013] with our parameters against numbers of an independent NumPy
// computation, and against linear elastic fracture mechanics.
#include "verification/crack_opening.hpp"

namespace perimode {
namespace {

using studies::crack_opening_stress;
using studies::opening_crack;
using test::expect_griffith;
using test::open_crack;

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

TEST(CrackOpening, GriffithLoadConvergesToLinearElasticFractureMechanics) { expect_griffith(24, 40); }

}  // namespace
}  // namespace perimode
