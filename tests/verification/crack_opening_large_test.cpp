// SPDX-License-Identifier: BSD-3-Clause
#include "verification/crack_opening.hpp"

namespace perimode {
namespace {

TEST(CrackOpeningLarge, GriffithLoadConvergesToLinearElasticFractureMechanics) {
  test::expect_griffith(60, 80);
}

}  // namespace
}  // namespace perimode
