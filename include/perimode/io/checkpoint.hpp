// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "perimode/core/sink.hpp"
#include "perimode/dynamics/motion.hpp"

namespace perimode {

/// A run at a step, and how much of its output files belongs to it.
struct Checkpoint {
  std::string case_digest;  ///< of everything the run's numbers depend on
  IntegratorState state;
  std::map<std::string, std::int64_t> bytes = {};  ///< of its text files, by name
  std::int64_t frames = 0;                         ///< of fields.exo
};

/// What tells one run from another, 32 hexadecimal digits: of the analysis ("transient"), the canonical text
/// of the case, the contents of the files it names and the format of checkpoints. Throws environment for a
/// file that cannot be read.
[[nodiscard]] std::string case_digest(const std::string& analysis, const std::string& canonical,
                                      const std::vector<std::filesystem::path>& files);

/// Writes `checkpoint.h5` (HDF5, with a checksum over all bytes) in a folder: into a file aside, synced,
/// then renamed; the checkpoint before becomes `checkpoint.previous.h5`. Throws environment (full disk), with
/// both earlier files as they were. Memory: twice the state.
/// @pre no name in it holds a '/'.
void write_checkpoint(const std::filesystem::path& folder, const Checkpoint& checkpoint);

/// The latest checkpoint of the folder that is whole and of this case. One that is truncated or damaged is
/// named in a warning and put aside as `checkpoint.damaged.h5`, and the one before is taken. None at all:
/// empty. Throws invalid_input for one of another case or another format (with what to do), and where there
/// are checkpoints but none is whole.
[[nodiscard]] std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& folder,
                                                        const std::string& case_digest,
                                                        const Sink& sink = {});

/// Whether a folder holds a checkpoint, whole or not.
[[nodiscard]] bool has_checkpoint(const std::filesystem::path& folder);

/// Removes what write_checkpoint and read_checkpoint leave in a folder. Throws nothing.
void remove_checkpoints(const std::filesystem::path& folder) noexcept;

}  // namespace perimode
