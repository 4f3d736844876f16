// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/geometry/cloud.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/io/temporary_folder.hpp"

namespace perimode {
namespace {

using test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;

CloudData read_text(const std::string& text, int dimension = 2) {
  const TemporaryFolder folder;
  return read_cloud(folder.write("cloud.csv", text), dimension);
}

std::string message_of(const std::string& text, int dimension = 2) {
  try {
    (void)read_text(text, dimension);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
    return error.what();
  }
  return "no error";
}

TEST(Cloud, ReadsPositionsVolumesAndBlocks) {
  const CloudData cloud = read_text("x,y,volume,block\n0,0.5,0.25,core\n1,-2e-3,+0.5,\n2,2,1,shell\n");
  EXPECT_EQ(cloud.count(), 3U);
  EXPECT_THAT(cloud.position, ElementsAre(0, 0.5, 1, -2e-3, 2, 2));
  EXPECT_THAT(cloud.volume, ElementsAre(0.25, 0.5, 1));
  EXPECT_THAT(cloud.block, ElementsAre("core", "", "shell"));
}

TEST(Cloud, ReadsEveryDimensionWithoutBlocks) {
  EXPECT_THAT(read_text("x,volume\n1,2\n", 1).position, ElementsAre(1));
  EXPECT_THAT(read_text("x,y,z,volume\n1,2,3,4\n", 3).position, ElementsAre(1, 2, 3));
  EXPECT_TRUE(read_text("x,volume\n1,2\n", 1).block.empty());
}

TEST(Cloud, AcceptsWindowsLineEndsByteOrderMarkBlanksAndNoFinalNewline) {
  const CloudData cloud = read_text("\xEF\xBB\xBFx, y, volume\r\n0, 1,\t2 \r\n3,4,5\r\n\r\n6,7,8");
  EXPECT_THAT(cloud.position, ElementsAre(0, 1, 3, 4, 6, 7));
  EXPECT_THAT(cloud.volume, ElementsAre(2, 5, 8));
}

TEST(Cloud, ErrorsNameLineAndColumn) {
  EXPECT_THAT(message_of(""), HasSubstr("cloud.csv:1:1: expected at least one particle, got an empty file"));
  EXPECT_THAT(message_of("x,y,volume\n"), HasSubstr("cloud.csv:1:1: expected at least one particle"));
  EXPECT_THAT(message_of("a,b,c\n1,2,3\n"), HasSubstr("cloud.csv:1:1: expected the header x,y,volume"));
  EXPECT_THAT(message_of("0,0,1\n"), HasSubstr("cloud.csv:1:1"));
  EXPECT_THAT(message_of("x,y,volume\n0,0,1\n", 3), HasSubstr("dimension 3"));
  EXPECT_THAT(message_of("x,y,volume\n0,0,1\n1,1\n"), HasSubstr("cloud.csv:3:3: expected 3 fields"));
  EXPECT_THAT(message_of("x,y,volume\n0,0,1,5\n"), HasSubstr("cloud.csv:2:7: expected 3 fields"));
  EXPECT_THAT(message_of("x,y,volume\n0, zero,1\n"),
              HasSubstr("cloud.csv:2:4: expected a finite number for y, got 'zero'"));
  EXPECT_THAT(message_of("x,y,volume\n0,0,1 m3\n"),
              HasSubstr("cloud.csv:2:5: expected a finite number for volume"));
  EXPECT_THAT(message_of("x,y,volume\n,0,1\n"), HasSubstr("cloud.csv:2:1"));
  EXPECT_THAT(message_of("x,y,volume\nnan,0,1\n"), HasSubstr("a finite number for x, got 'nan'"));
  EXPECT_THAT(message_of("x,y,volume\n0,inf,1\n"), HasSubstr("cloud.csv:2:3"));
  EXPECT_THAT(message_of("x,y,volume\n0,0,0\n"), HasSubstr("cloud.csv:2:5: expected a volume > 0"));
  EXPECT_THAT(message_of("x,y,volume\n0,0,-1\n"), HasSubstr("cloud.csv:2:5: expected a volume > 0"));
}

TEST(Cloud, TwoParticlesAtOnePointAreRefused) {
  EXPECT_THAT(
      message_of("x,y,volume\n0,1,1\n5,5,1\n-0.0,1,2\n"),
      HasSubstr(
          "cloud.csv:4:1: expected every particle at a point of its own, got the point of line 2 again"));
}

TEST(Cloud, MissingFileSaysItsPath) {
  try {
    (void)read_cloud("/nowhere/cloud.csv", 2);
    FAIL() << "read a file that is not there";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("/nowhere/cloud.csv: expected"));
  }
}

}  // namespace
}  // namespace perimode
