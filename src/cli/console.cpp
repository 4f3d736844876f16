// SPDX-License-Identifier: BSD-3-Clause
#include "console.hpp"

#include <fmt/format.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cstdio>

namespace perimode::cli {

namespace {

/// A piped run that ends sooner says nothing on its way.
constexpr double quick_seconds = 1.0;

}  // namespace

Console::Console(bool quiet)
    : quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()),
      log_(std::make_shared<spdlog::logger>("perimode", std::make_shared<spdlog::sinks::stderr_sink_mt>())) {
  log_->set_pattern("%v");
  if (!quiet_) clock_ = std::jthread([this](const std::stop_token& stop) { tick(stop); });
}

void Console::tick(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (
      !stopping_.wait_for(lock, stop, std::chrono::seconds(1), [&stop] { return stop.stop_requested(); })) {
    if (terminal_ ? line_shown_ : !stage_shown_) show_stage();
  }
}

void Console::show_stage() {
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  if (terminal_) {
    const std::string share =
        last_fraction_ >= 0.0 ? fmt::format(" {:3.0f} %", 100.0 * last_fraction_) : std::string();
    std::fputs(fmt::format("\r\033[K{:6.1f} s  {}{}", seconds, last_stage_, share).c_str(), stderr);
    std::fflush(stderr);
    line_shown_ = true;
  } else if (!stage_shown_ && seconds >= quick_seconds) {
    log_->info("{:6.1f} s  {}", seconds, last_stage_);
    stage_shown_ = true;
  }
}

void Console::erase_line() {
  if (line_shown_) std::fputs("\r\033[K", stderr);
  line_shown_ = false;
}

void Console::info(const std::string& text) {
  if (quiet_) return;
  const std::scoped_lock lock(mutex_);
  erase_line();
  log_->info(text);
}

void Console::warning(const std::string& text) {
  if (quiet_) return;
  const std::scoped_lock lock(mutex_);
  erase_line();
  log_->warn("perimode: warning: {}", text);
}

void Console::error(const std::string& text) {
  const std::scoped_lock lock(mutex_);
  erase_line();
  log_->error("perimode: error: {}", text);
}

void Console::stage(const std::string& name, double fraction) {
  if (quiet_) return;
  const std::scoped_lock lock(mutex_);
  if (name != last_stage_) stage_shown_ = false;
  last_stage_ = name;
  last_fraction_ = fraction;
  show_stage();
}

void Console::clear_progress() {
  const std::scoped_lock lock(mutex_);
  erase_line();
  stage_shown_ = true;
  std::fflush(stderr);
}

Sink Console::sink() {
  Sink sink;
  sink.info = [this](std::string_view text) { info(std::string(text)); };
  sink.warning = [this](std::string_view text) { warning(std::string(text)); };
  sink.progress = [this](std::string_view name, double fraction) { stage(std::string(name), fraction); };
  return sink;
}

}  // namespace perimode::cli
