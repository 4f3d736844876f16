// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/output_file.hpp"
#include "perimode/assembly/body.hpp"
#include "perimode/dynamics/transient.hpp"
#include "perimode/io/exodus.hpp"

namespace perimode::cli {

/// history.csv of a run, a line per row, numbers with 17 significant digits.
class HistoryFile {
 public:
  /// `bytes`: of an earlier part of the run that stand; 0 begins anew.
  HistoryFile(const std::filesystem::path& file, std::int64_t bytes, const std::vector<std::string>& probes,
              bool boundary_work);

  void add(const HistoryRow& row);
  /// Lets other programs see what there is, once a second at most.
  void show_now_and_then();
  void sync() { file_.sync(); }
  [[nodiscard]] std::int64_t bytes() const { return file_.bytes(); }
  void close() { file_.close(); }

 private:
  OutputFile file_;
  bool boundary_work_;
  double shown_ = 0.0;  // seconds of the steady clock
};

/// fields.exo of a run, made with its first frame.
template <int Dim>
class FramesFile {
 public:
  /// `frames`: of an earlier part of the run that stand; 0 begins anew.
  FramesFile(std::filesystem::path file, std::string title, std::vector<std::string> fields,
             std::int64_t frames);

  void add(const TransientFrame<Dim>& frame);
  void sync();
  [[nodiscard]] std::int64_t frames() const { return frames_; }
  void close();

 private:
  std::filesystem::path file_;
  std::string title_;
  std::vector<std::string> fields_;
  std::int64_t frames_;
  std::optional<ExodusWriter> writer_;
};

/// |balance| over the energy that went through: the largest of initial, external work and what the body holds
/// and has lost. 0 for a body nothing happens to.
[[nodiscard]] double relative_balance(const Energies& energies);

/// The report a person reads: before the first step, and at the end.
template <int Dim>
[[nodiscard]] std::string transient_start_text(const Body<Dim>& body, const TransientPlan& plan);
[[nodiscard]] std::string transient_text(const TransientResult& result);

/// What `perimode check` says of a transient analysis.
template <int Dim>
[[nodiscard]] std::string transient_plan_text(const Body<Dim>& body, const TransientPlan& plan);

}  // namespace perimode::cli
