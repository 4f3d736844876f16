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
/// terminal and becomes plain lines when piped. Its clock runs on while a stage lasts. Results go to standard
/// output, elsewhere.
class Console {
 public:
  explicit Console(bool quiet);

  void info(const std::string& text);
  void warning(const std::string& text);
  void error(const std::string& text);  ///< never silenced
  void stage(const std::string& name, double fraction);
  void clear_progress();

  /// Sinks for the library that end here.
  [[nodiscard]] Sink sink();

 private:
  void erase_line();
  void show_stage();
  void tick(const std::stop_token& stop);

  bool quiet_;
  bool terminal_;
  bool line_shown_ = false;
  bool stage_shown_ = true;  // piped: its line is written
  std::string last_stage_;
  double last_fraction_ = -1.0;
  std::chrono::steady_clock::time_point start_;
  std::shared_ptr<spdlog::logger> log_;
  std::mutex mutex_;
  std::condition_variable_any stopping_;
  std::jthread clock_;  // last: it uses all of the above
};

}  // namespace perimode::cli
