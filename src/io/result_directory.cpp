// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/io/result_directory.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "perimode/core/error.hpp"
#include "perimode/io/checkpoint.hpp"

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

fs::path full_path(const fs::path& target) {
  if (target.empty())
    invalid_input({"a folder for the result", "an empty name", "give for example out/plate", {}});
  const fs::path full = fs::weakly_canonical(fs::absolute(target));
  return full.has_filename() ? full : full.parent_path();
}

std::vector<fs::path> missing_parents(const fs::path& target) {
  std::vector<fs::path> missing;
  for (fs::path p = target.parent_path(); !p.empty() && !fs::exists(p); p = p.parent_path())
    missing.insert(missing.begin(), p);
  return missing;
}

/// Whether a run may begin with the folder of an unfinished one as it is.
void require_beginning(const fs::path& folder, bool force, Beginning beginning) {
  const Where where{folder.string()};
  if (fs::exists(folder) && !fs::is_directory(folder)) {
    invalid_input(
        {"a folder for the unfinished result", "a file of that name", "give another --output", where});
  }
  const bool there = has_checkpoint(folder);
  if (beginning == Beginning::resumed && !there) {
    invalid_input({"a checkpoint to go on from",
                   fs::exists(folder) ? "a folder without one" : "no unfinished run",
                   "start the run without --resume", where});
  }
  if (beginning == Beginning::new_run && there && !force) {
    invalid_input({"no unfinished run of this result", "one with a checkpoint",
                   "go on with --resume, or start anew with --force", where});
  }
}

/// Descriptor of the folder, locked until it is closed or the program ends, however it ends. -1: not a file
/// system that can lock.
int locked(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0 || ::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
  const bool busy = errno == EWOULDBLOCK;
  (void)::close(descriptor);
  if (busy) {
    invalid_input({"a folder no other run is at work in",
                   "one that is in use",
                   "wait for that run, or give another --output",
                   {folder.string()}});
  }
  return -1;
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
  try {
    target_ = full_path(target);
    require_replaceable(target_, force);
    unfinished_.parents = missing_parents(target_);
    fs::create_directories(target_.parent_path());
    temporary_ = fmt::format("{}.part-{}", target_.string(), ::getpid());
    fs::remove_all(temporary_);  // left by a killed run that had this process id
    fs::create_directory(temporary_);
    unfinished_.temporary = temporary_;
  } catch (const fs::filesystem_error& error) {
    fail("to create the folder of the result", error);
  }
}

ResultDirectory::ResultDirectory(const fs::path& target, bool force, Beginning beginning) {
  try {
    target_ = full_path(target);
    temporary_ = target_.string() + ".unfinished";
    require_beginning(temporary_, force, beginning);
    require_replaceable(target_, force);
    const std::vector<fs::path> parents = missing_parents(target_);
    fs::create_directories(temporary_);
    lock_ = locked(temporary_);
    if (beginning == Beginning::resumed) return;
    for (const auto& entry : fs::directory_iterator(temporary_)) fs::remove_all(entry.path());
    unfinished_ = {temporary_, parents};
  } catch (const fs::filesystem_error& error) {
    if (lock_ >= 0) (void)::close(lock_);
    fail("to create the folder of the result", error);
  }
}

ResultDirectory::~ResultDirectory() {
  remove_unfinished(unfinished_);
  if (lock_ >= 0) (void)::close(lock_);
}

ResultDirectory::ResultDirectory(ResultDirectory&& other) noexcept
    : target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, {})),
      unfinished_(std::exchange(other.unfinished_, {})),
      lock_(std::exchange(other.lock_, -1)) {}

void ResultDirectory::commit() {
  const fs::path old = fmt::format("{}.old-{}", target_.string(), ::getpid());
  bool moved_aside = false;
  try {
    if (fs::exists(target_) && !fs::is_empty(target_)) {
      fs::remove_all(old);
      fs::rename(target_, old);
      moved_aside = true;
    }
    fs::rename(temporary_, target_);
    temporary_.clear();
    unfinished_ = {};
    fs::remove_all(old);
  } catch (const fs::filesystem_error& error) {
    std::error_code ignored;
    if (moved_aside && !temporary_.empty()) fs::rename(old, target_, ignored);
    fail("to put the result in its place", error);
  }
}

}  // namespace perimode
