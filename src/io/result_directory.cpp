// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/io/result_directory.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <utility>

#include "perimode/core/error.hpp"

namespace perimode {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const char* expected, const fs::filesystem_error& error) {
  throw Error(ErrorKind::environment, Complaint{expected,
                                                error.code().message(),
                                                "check the path, the free space and the permissions",
                                                {error.path1().string()}});
}

void require_replaceable(const fs::path& target, bool force) {
  const Where where{target.string()};
  if (!fs::exists(target)) return;
  if (!fs::is_directory(target)) {
    invalid_input({"a folder for the result", "a file of that name", "give another --output", where});
  }
  if (fs::is_empty(target)) return;
  if (!force) {
    invalid_input({"a new or empty folder for the result", "a folder that holds files",
                   "use --force to replace it, or another --output", where});
  }
  if (!fs::exists(target / "summary.json")) {
    invalid_input({"an earlier result (a folder with summary.json) to replace", "a folder with other files",
                   "give another --output: --force removes results only", where});
  }
}

std::vector<fs::path> missing_parents(const fs::path& target) {
  std::vector<fs::path> missing;
  for (fs::path p = target.parent_path(); !p.empty() && !fs::exists(p); p = p.parent_path())
    missing.insert(missing.begin(), p);
  return missing;
}

}  // namespace

void remove_unfinished(const UnfinishedResult& unfinished) noexcept {
  if (unfinished.temporary.empty()) return;
  std::error_code ignored;
  fs::remove_all(unfinished.temporary, ignored);
  for (auto p = unfinished.parents.rbegin(); p != unfinished.parents.rend(); ++p) {
    if (fs::is_empty(*p, ignored)) fs::remove(*p, ignored);
  }
}

ResultDirectory::ResultDirectory(const fs::path& target, bool force) {
  if (target.empty())
    invalid_input({"a folder for the result", "an empty name", "give for example out/plate", {}});
  try {
    target_ = fs::weakly_canonical(fs::absolute(target));
    if (!target_.has_filename()) target_ = target_.parent_path();
    require_replaceable(target_, force);
    unfinished_.parents = missing_parents(target_);
    fs::create_directories(target_.parent_path());
    const fs::path temporary = fmt::format("{}.part-{}", target_.string(), ::getpid());
    fs::remove_all(temporary);  // left by a killed run that had this process id
    fs::create_directory(temporary);
    unfinished_.temporary = temporary;
  } catch (const fs::filesystem_error& error) {
    fail("to create the folder of the result", error);
  }
}

ResultDirectory::~ResultDirectory() { remove_unfinished(unfinished_); }

ResultDirectory::ResultDirectory(ResultDirectory&& other) noexcept
    : target_(std::move(other.target_)), unfinished_(std::exchange(other.unfinished_, {})) {}

void ResultDirectory::commit() {
  const fs::path old = fmt::format("{}.old-{}", target_.string(), ::getpid());
  bool moved_aside = false;
  try {
    if (fs::exists(target_) && !fs::is_empty(target_)) {
      fs::remove_all(old);
      fs::rename(target_, old);
      moved_aside = true;
    }
    fs::rename(unfinished_.temporary, target_);
    unfinished_ = {};
    fs::remove_all(old);
  } catch (const fs::filesystem_error& error) {
    std::error_code ignored;
    if (moved_aside && !unfinished_.temporary.empty()) fs::rename(old, target_, ignored);
    fail("to put the result in its place", error);
  }
}

}  // namespace perimode
