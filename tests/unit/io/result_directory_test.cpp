// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/io/result_directory.hpp"

#include <gtest/gtest.h>

#include "perimode/core/error.hpp"
#include "unit/io/temporary_folder.hpp"

namespace perimode {
namespace {

namespace fs = std::filesystem;
using test::content;
using test::TemporaryFolder;

void put(const fs::path& file, const char* text) { std::ofstream(file) << text; }

std::size_t entries(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

ErrorKind kind_of_refusal(const fs::path& target, bool force) {
  try {
    const ResultDirectory result(target, force);
  } catch (const Error& error) {
    return error.kind();
  }
  ADD_FAILURE() << "not refused: " << target;
  return ErrorKind::solver_failure;
}

TEST(ResultDirectory, AppearsWholeAtCommitWithItsParents) {
  const TemporaryFolder folder;
  const fs::path target = folder.path() / "a" / "b";
  ResultDirectory result(target, false);
  put(result.temporary() / "summary.json", "{}");
  EXPECT_FALSE(fs::exists(target));
  result.commit();
  EXPECT_EQ(content(target / "summary.json"), "{}");
  EXPECT_EQ(entries(target.parent_path()), 1U);
}

TEST(ResultDirectory, LeavesNothingWithoutCommit) {
  const TemporaryFolder folder;
  {
    const ResultDirectory result(folder.path() / "out", false);
    put(result.temporary() / "modes.csv", "1");
  }
  EXPECT_EQ(entries(folder.path()), 0U);
}

TEST(ResultDirectory, KeepsOneOwnerWhenMoved) {
  const TemporaryFolder folder;
  ResultDirectory first(folder.path() / "out", false);
  {
    ResultDirectory second = std::move(first);
    EXPECT_TRUE(fs::exists(second.temporary()));
    second.commit();
  }
  EXPECT_TRUE(fs::exists(folder.path() / "out"));
}

TEST(ResultDirectory, AcceptsAnEmptyFolderAndATrailingSlash) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "out");
  ResultDirectory result(folder.path() / "out/", false);
  put(result.temporary() / "summary.json", "{}");
  result.commit();
  EXPECT_TRUE(fs::exists(folder.path() / "out" / "summary.json"));
}

TEST(ResultDirectory, RefusesAnExistingResultWithoutForce) {
  const TemporaryFolder folder;
  put(folder.path() / "summary.json", "old");
  EXPECT_EQ(kind_of_refusal(folder.path(), false), ErrorKind::invalid_input);
  EXPECT_EQ(content(folder.path() / "summary.json"), "old");
}

TEST(ResultDirectory, ForceReplacesAResultAtCommitOnly) {
  const TemporaryFolder folder;
  const fs::path target = folder.path() / "out";
  fs::create_directory(target);
  put(target / "summary.json", "old");
  put(target / "more.csv", "old");
  ResultDirectory result(target, true);
  put(result.temporary() / "summary.json", "new");
  EXPECT_EQ(content(target / "summary.json"), "old");
  result.commit();
  EXPECT_EQ(content(target / "summary.json"), "new");
  EXPECT_EQ(entries(target), 1U);
  EXPECT_EQ(entries(folder.path()), 1U);
}

TEST(ResultDirectory, ForceDoesNotRemoveWhatIsNoResult) {
  const TemporaryFolder folder;
  put(folder.path() / "thesis.tex", "years");
  EXPECT_EQ(kind_of_refusal(folder.path(), true), ErrorKind::invalid_input);
  EXPECT_EQ(content(folder.path() / "thesis.tex"), "years");
}

TEST(ResultDirectory, RefusesAFile) {
  const TemporaryFolder folder;
  EXPECT_EQ(kind_of_refusal(folder.write("out", "text"), true), ErrorKind::invalid_input);
}

TEST(ResultDirectory, FolderThatCannotBeMadeIsAnErrorOfTheEnvironment) {
  EXPECT_EQ(kind_of_refusal("/proc/none/out", false), ErrorKind::environment);
}

ErrorKind kind_of_refusal(const fs::path& target, bool force, Beginning beginning) {
  try {
    const ResultDirectory result(target, force, beginning);
  } catch (const Error& error) {
    return error.kind();
  }
  ADD_FAILURE() << "not refused: " << target;
  return ErrorKind::solver_failure;
}

TEST(ResumableResult, StaysOnceItIsKeptAndIsFoundAgain) {
  const TemporaryFolder folder;
  const fs::path target = folder.path() / "a" / "out";
  {
    ResultDirectory result(target, false, Beginning::new_run);
    EXPECT_EQ(result.temporary().filename(), "out.unfinished");
    EXPECT_EQ(result.unfinished().temporary, result.temporary());
    put(result.temporary() / "checkpoint.h5", "state");
    result.keep();
    EXPECT_TRUE(result.unfinished().temporary.empty());
  }
  EXPECT_EQ(content(folder.path() / "a/out.unfinished/checkpoint.h5"), "state");
  EXPECT_EQ(kind_of_refusal(target, false, Beginning::new_run), ErrorKind::invalid_input);
  ResultDirectory resumed(target, false, Beginning::resumed);
  EXPECT_EQ(content(resumed.temporary() / "checkpoint.h5"), "state");
  resumed.commit();
  EXPECT_EQ(content(target / "checkpoint.h5"), "state");
  EXPECT_EQ(entries(target.parent_path()), 1U);
}

TEST(ResumableResult, LeavesNothingUnlessItIsKept) {
  const TemporaryFolder folder;
  { const ResultDirectory result(folder.path() / "a" / "out", false, Beginning::new_run); }
  EXPECT_EQ(entries(folder.path()), 0U);
}

TEST(ResumableResult, ForceAndFoldersWithoutACheckpointBeginEmpty) {
  const TemporaryFolder folder;
  const fs::path unfinished = folder.path() / "out.unfinished";
  fs::create_directory(unfinished);
  put(unfinished / "history.csv", "old");
  { const ResultDirectory result(folder.path() / "out", false, Beginning::new_run); }
  EXPECT_FALSE(fs::exists(unfinished));
  fs::create_directory(unfinished);
  put(unfinished / "checkpoint.previous.h5", "old");
  const ResultDirectory result(folder.path() / "out", true, Beginning::new_run);
  EXPECT_EQ(entries(unfinished), 0U);
}

TEST(ResumableResult, RefusesToResumeNothing) {
  const TemporaryFolder folder;
  EXPECT_EQ(kind_of_refusal(folder.path() / "out", false, Beginning::resumed), ErrorKind::invalid_input);
  fs::create_directory(folder.path() / "out.unfinished");
  EXPECT_EQ(kind_of_refusal(folder.path() / "out", true, Beginning::resumed), ErrorKind::invalid_input);
}

TEST(ResumableResult, RefusesASecondRunAtWork) {
  const TemporaryFolder folder;
  const ResultDirectory first(folder.path() / "out", false, Beginning::new_run);
  put(first.temporary() / "history.csv", "mine");
  EXPECT_EQ(kind_of_refusal(folder.path() / "out", true, Beginning::new_run), ErrorKind::invalid_input);
  EXPECT_EQ(content(first.temporary() / "history.csv"), "mine");
}

TEST(ResumableResult, RefusesAnExistingResultWithoutForce) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "out");
  put(folder.path() / "out" / "summary.json", "old");
  EXPECT_EQ(kind_of_refusal(folder.path() / "out", false, Beginning::new_run), ErrorKind::invalid_input);
  ResultDirectory result(folder.path() / "out", true, Beginning::new_run);
  put(result.temporary() / "summary.json", "new");
  result.commit();
  EXPECT_EQ(content(folder.path() / "out" / "summary.json"), "new");
  EXPECT_EQ(entries(folder.path()), 1U);
}

}  // namespace
}  // namespace perimode
