// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

namespace perimode {

/// What a run that did not end has made: a temporary folder and parents that were not there before.
struct UnfinishedResult {
  std::filesystem::path temporary;             ///< empty: nothing to remove
  std::vector<std::filesystem::path> parents;  ///< created for it, outermost first
};
/// Removes the folder, then those parents that are empty. Throws nothing.
void remove_unfinished(const UnfinishedResult& unfinished) noexcept;

/// How a run that can be resumed begins.
enum class Beginning { new_run, resumed };

/// A result folder that appears whole or not at all. Files are written into a temporary sibling
/// folder "<target>.part-<process id>"; commit() renames it to the target. Without a commit the
/// destructor removes the temporary folder. The folder of a run that can be resumed is
/// "<target>.unfinished": the next run finds it, and it stays once keep() was called.
class ResultDirectory {
 public:
  /// Creates parents and the temporary folder. Throws invalid_input if the target is a file, or a
  /// folder that is not empty and `force` is false; with `force` only an earlier result (a folder
  /// that holds summary.json) may be replaced. Throws environment where nothing can be written.
  ResultDirectory(const std::filesystem::path& target, bool force);
  /// Of a run that can be resumed; the folder is locked against a second run while this lasts. Throws
  /// besides invalid_input: a resumed run without a checkpoint, a new one over a checkpoint without `force`,
  /// a folder another run is at work in. What a new run finds in its folder is removed.
  ResultDirectory(const std::filesystem::path& target, bool force, Beginning beginning);
  ~ResultDirectory();
  ResultDirectory(ResultDirectory&& other) noexcept;
  ResultDirectory& operator=(ResultDirectory&&) = delete;
  ResultDirectory(const ResultDirectory&) = delete;
  ResultDirectory& operator=(const ResultDirectory&) = delete;

  /// Where to write until commit().
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }
  /// What an interrupted program has to remove.
  [[nodiscard]] const UnfinishedResult& unfinished() const { return unfinished_; }
  /// From here on the folder stays without a commit: it holds a checkpoint.
  void keep() { unfinished_ = {}; }
  [[nodiscard]] const std::filesystem::path& target() const { return target_; }

  /// Puts the result in its place. An earlier result is moved aside first and removed last, and
  /// moved back if the new one cannot take its place. Throws environment.
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path temporary_;  ///< empty: committed
  UnfinishedResult unfinished_;
  int lock_ = -1;  ///< file descriptor of the locked folder
};

}  // namespace perimode
