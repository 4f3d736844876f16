// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "perimode/core/sink.hpp"

namespace spdlog {
class logger;
}

namespace perimode::cli {

/// The program's voice on standard error: log lines, and one progress line that is rewritten on a
/// terminal and becomes plain lines when piped. Its clock runs on while a stage lasts. Stages whose names
/// differ from the first digit on alone ("step 12 of 40") are one: it tells the time left and, piped, makes a
/// line for every tenth done. Results go to standard output, elsewhere.
class Console {
 public:
  explicit Console(bool quiet);

  void info(const std::string& text);
  void warning(const std::string& text);
  void error(const std::string& text);  ///< never silenced
  void say(const std::string& text);    ///< neither
  void stage(const std::string& name, double fraction);
  void clear_progress();

  /// Sinks for the library that end here.
  [[nodiscard]] Sink sink();

 private:
  using Clock = std::chrono::steady_clock;

  void erase_line();
  void show_stage();
  [[nodiscard]] std::string share_text() const;
  void tick(const std::stop_token& stop);

  bool quiet_;
  bool terminal_;
  bool line_shown_ = false;
  bool stage_shown_ = true;  // piped: its line is written
  std::string last_stage_;
  double last_fraction_ = -1.0;
  double shown_fraction_ = -1.0;  // piped: of the last line
  Clock::time_point start_;
  Clock::time_point stage_start_;
  double stage_start_fraction_ = 0.0;
  std::shared_ptr<spdlog::logger> log_;
  std::mutex mutex_;
  std::condition_variable_any stopping_;
  std::jthread clock_;  // last: it uses all of the above
};

}  // namespace perimode::cli
