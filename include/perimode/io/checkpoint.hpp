// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "perimode/core/sink.hpp"
#include "perimode/dynamics/motion.hpp"

namespace perimode {

/// A transient run at a step, and how much of its output files belongs to it.
struct Checkpoint {
  std::string case_digest;  ///< of everything the run's numbers depend on
  IntegratorState state;
  std::int64_t history_bytes = 0;  ///< of history.csv
  std::int64_t frames = 0;         ///< of fields.exo
  Energies last_energies;          ///< of the last history row
};

/// Writes `checkpoint.h5` (HDF5, with a checksum over all numbers) in a folder: into a file aside, synced,
/// then renamed; the checkpoint before becomes `checkpoint.previous.h5`. Throws environment (full disk), with
/// both earlier files as they were.
void write_checkpoint(const std::filesystem::path& folder, const Checkpoint& checkpoint);

/// The latest checkpoint of the folder that is whole and of this case. One that is truncated or damaged is
/// named in a warning, and the one before is taken. None at all: empty. Throws invalid_input for one of
/// another case (with what to do), and where there are checkpoints but none is whole.
[[nodiscard]] std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& folder,
                                                        const std::string& case_digest,
                                                        const Sink& sink = {});

}  // namespace perimode
