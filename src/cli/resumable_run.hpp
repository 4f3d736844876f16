// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "commands.hpp"
#include "core/stopwatch.hpp"
#include "fields_file.hpp"
#include "io/output_file.hpp"
#include "perimode/io/case.hpp"
#include "perimode/io/checkpoint.hpp"
#include "perimode/io/result_directory.hpp"
#include "summary.hpp"

namespace perimode::cli {

/// A run that can be interrupted and resumed: its folder, the files that grow while it lasts, its
/// checkpoints. A resumed run finds its files as they were at the checkpoint.
class ResumableRun {
 public:
  struct Kind {
    std::string analysis;                   ///< "transient"
    std::string counted;                    ///< what checkpoints count: "step"
    std::vector<std::string> globals = {};  ///< global variables of fields.exo
  };

  /// Opens the result folder and, for --resume, the last checkpoint. Throws invalid_input as
  /// ResultDirectory and read_checkpoint, and for files of the case that are not there.
  ResumableRun(const Case& input, const Arguments& arguments, Kind kind, Console& console);

  /// Where to go on; null: at the start.
  [[nodiscard]] const IntegratorState* resumed() const { return from_ ? &from_->state : nullptr; }

  /// A text file of the result, after what stands of it; a new one begins with `header`. Valid while the
  /// run lasts.
  [[nodiscard]] OutputFile& text(const std::string& name, std::string_view header);
  [[nodiscard]] FieldsFile& fields() { return fields_; }

  /// A checkpoint that counts on what it says of the other files: they reach the disk before it does.
  void save(const IntegratorState& state);
  /// Whether the user wants the run to end. From the first time on, an interrupt only asks; other programs
  /// see the files, up to the last second.
  [[nodiscard]] bool asked_to_stop();

  /// Runs `write` and counts its time as output.
  template <class Write>
  void timed(const Write& write) {
    const auto start = Clock::now();
    write();
    seconds_ += seconds_since(start);
  }
  [[nodiscard]] double output_seconds() const { return seconds_; }

  /// Says how to go on after "interrupted <where>"; the exit code.
  [[nodiscard]] int end_interrupted(const std::string& where);
  /// Throws `error`, with how to go on for one of the environment.
  [[noreturn]] void fail(const Error& error) const;
  /// Ends the files, before a summary counts on them.
  void close();
  /// Writes the summary and puts the result in its place, without checkpoints.
  void finish(const nlohmann::ordered_json& summary);
  [[nodiscard]] const std::filesystem::path& target() const { return folder_.target(); }

 private:
  [[nodiscard]] std::string resume_command() const;

  const Arguments* arguments_;
  Kind kind_;
  Console* console_;
  ResultDirectory folder_;
  std::string digest_;
  std::optional<Checkpoint> from_;
  std::map<std::string, std::unique_ptr<OutputFile>> texts_;
  FieldsFile fields_;
  std::int64_t last_checkpoint_ = -1;  ///< its step; -1: none
  bool asks_ = false;                  ///< interrupts only ask
  double seconds_ = 0.0;
  Clock::time_point shown_ = {};  ///< when other programs last could see all
};

}  // namespace perimode::cli
