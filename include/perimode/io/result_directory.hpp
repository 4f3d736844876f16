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

/// A result folder that appears whole or not at all. Files are written into a temporary sibling
/// folder "<target>.part-<process id>"; commit() renames it to the target. Without a commit the
/// destructor removes the temporary folder.
class ResultDirectory {
 public:
  /// Creates parents and the temporary folder. Throws invalid_input if the target is a file, or a
  /// folder that is not empty and `force` is false; with `force` only an earlier result (a folder
  /// that holds summary.json) may be replaced. Throws environment where nothing can be written.
  ResultDirectory(const std::filesystem::path& target, bool force);
  ~ResultDirectory();
  ResultDirectory(ResultDirectory&& other) noexcept;
  ResultDirectory& operator=(ResultDirectory&&) = delete;
  ResultDirectory(const ResultDirectory&) = delete;
  ResultDirectory& operator=(const ResultDirectory&) = delete;

  /// Where to write until commit(); what an interrupted program has to remove.
  [[nodiscard]] const std::filesystem::path& temporary() const { return unfinished_.temporary; }
  [[nodiscard]] const UnfinishedResult& unfinished() const { return unfinished_; }
  [[nodiscard]] const std::filesystem::path& target() const { return target_; }

  /// Puts the result in its place. An earlier result is moved aside first and removed last, and
  /// moved back if the new one cannot take its place. Throws environment.
  void commit();

 private:
  std::filesystem::path target_;
  UnfinishedResult unfinished_;
};

}  // namespace perimode
