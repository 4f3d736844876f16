// SPDX-License-Identifier: BSD-3-Clause
// Input that was made to hurt: it is refused with one short line, and soon. (Where a fault would take minutes
// or all memory, the time limit of the test notices.)
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "perimode/core/error.hpp"
#include "perimode/io/case.hpp"

namespace perimode {
namespace {

using testing::HasSubstr;

/// The message of the invalid_input that the text is refused with.
std::string refusal(const std::string& text) {
  try {
    (void)read_case_text(text, "case.yaml");
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
    EXPECT_LE(std::string(error.what()).size(), 600U);
    return error.what();
  }
  return "read";
}

std::string repeated(int times, const std::string& text) {
  std::string out;
  for (int i = 0; i < times; ++i) out += text;
  return out;
}

TEST(HostileCase, ManyKeysAreComparedOnce) {
  std::string text = "{";
  for (int i = 0; i < 95000; ++i) text += fmt::format("k{}: 1,", i);
  EXPECT_THAT(refusal(text + "}"), HasSubstr("choose one of them"));
  EXPECT_THAT(refusal(text + "k7: 2}"), HasSubstr("'k7' again (first in line 1)"));
}

TEST(HostileCase, AFileWithoutEndIsRefused) {
  try {
    (void)read_case("/dev/zero");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
    EXPECT_THAT(error.what(), HasSubstr("at most 4 MB"));
  }
}

TEST(HostileCase, AMessageNamesAFewOfManyBlocks) {
  std::string blocks;
  for (int i = 0; i < 1000; ++i) blocks += fmt::format("b{}: {{ nearest: [0, 0] }}, ", i);
  const std::string text =
      "body: { dimension: 2, particles: { grid: { lower: [0, 0], upper: [1, 1], spacing: 0.1 } },\n"
      "        horizon: { ratio: 3 }, blocks: { " +
      blocks +
      " } }\n"
      "material: { youngs_modulus: 1, density: 1 }\n"
      "boundary: [ { fix: [x], at: { block: b1000 } } ]\n";
  EXPECT_THAT(refusal(text), HasSubstr("b11, ... (1000 in all)), got 'b1000'"));
}

TEST(HostileCase, AliasesOfAliasesAreNotWrittenOut) {
  std::string text = "a: &a0 [x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 12; ++i)
    text += fmt::format("b{}: &a{} [{} x]\n", i, i, repeated(9, fmt::format("*a{}, ", i - 1)));
  EXPECT_THAT(refusal(text), HasSubstr("200000 values"));
}

TEST(HostileCase, DeepNestingIsRefusedInEveryStyle) {
  for (const char* open : {"[", "{a: ", "- ", "? "})
    EXPECT_NE(refusal(repeated(20000, open)), "read") << open;
}

}  // namespace
}  // namespace perimode
