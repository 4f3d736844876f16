// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/core/error.hpp"

#include <gtest/gtest.h>

namespace perimode {
namespace {

TEST(Error, SaysWhereWhatWasExpectedWhatCameAndHowToMend) {
  const Error e(ErrorKind::invalid_input, {"a horizon > 0", "-3", "give {ratio: 3}", {"plate.yaml", 4, 7}});
  EXPECT_STREQ(e.what(), "plate.yaml:4:7: expected a horizon > 0, got -3; give {ratio: 3}");
  EXPECT_EQ(e.where().line, 4);
}

TEST(Error, LeavesOutWhatIsUnknown) {
  const Error e(ErrorKind::invalid_input, Complaint{"a number", "", "", {}});
  EXPECT_STREQ(e.what(), "expected a number");
}

TEST(Where, WithoutALineIsTheFile) { EXPECT_EQ((Where{"case.yaml", 0, 0}.text()), "case.yaml"); }

}  // namespace
}  // namespace perimode
