// SPDX-License-Identifier: BSD-3-Clause
#include "console.hpp"

#include <fmt/format.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string_view>

namespace perimode::cli {

namespace {

/// A piped run that ends sooner says nothing on its way.
constexpr double quick_seconds = 1.0;
/// How much of a stage lies between its lines in a pipe.
constexpr double piped_share = 0.1;

double seconds_between(std::chrono::steady_clock::time_point a, std::chrono::steady_clock::time_point b) {
  return std::chrono::duration<double>(b - a).count();
}

/// The name of a stage without the number in it.
std::string_view kind_of(std::string_view name) { return name.substr(0, name.find_first_of("0123456789")); }

std::string duration_text(double seconds) {
  if (seconds < 100.0) return fmt::format("{:.0f} s", seconds);
  if (seconds < 6000.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

}  // namespace

Console::Console(bool quiet)
    : quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      stage_start_(start_),
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

std::string Console::share_text() const {
  if (last_fraction_ < 0.0) return {};
  std::string text = fmt::format(" {:3.0f} %", 100.0 * last_fraction_);
  const double done = last_fraction_ - stage_start_fraction_;
  const double seconds = seconds_between(stage_start_, Clock::now());
  if (done > 0.0 && last_fraction_ < 1.0 && seconds >= quick_seconds)
    text += fmt::format(", {} left", duration_text(seconds * (1.0 - last_fraction_) / done));
  return text;
}

void Console::show_stage() {
  const double seconds = seconds_between(start_, Clock::now());
  if (terminal_) {
    std::fputs(fmt::format("\r\033[K{:6.1f} s  {}{}", seconds, last_stage_, share_text()).c_str(), stderr);
    std::fflush(stderr);
    line_shown_ = true;
  } else if (!stage_shown_ && seconds >= quick_seconds) {
    log_->info("{:6.1f} s  {}{}", seconds, last_stage_, share_text());
    stage_shown_ = true;
    shown_fraction_ = last_fraction_;
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

void Console::say(const std::string& text) {
  const std::scoped_lock lock(mutex_);
  erase_line();
  log_->error("perimode: {}", text);
}

void Console::stage(const std::string& name, double fraction) {
  if (quiet_) return;
  const std::scoped_lock lock(mutex_);
  if (kind_of(name) != kind_of(last_stage_)) {
    stage_shown_ = false;
    stage_start_ = Clock::now();
    stage_start_fraction_ = std::max(0.0, fraction);
  } else if (fraction >= shown_fraction_ + piped_share) {
    stage_shown_ = false;
  }
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
