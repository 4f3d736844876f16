// SPDX-License-Identifier: BSD-3-Clause
#include "interrupt.hpp"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <mutex>
#include <thread>

namespace perimode::cli {

namespace {

std::mutex guard;
UnfinishedResult unfinished_result;
std::string last_line;
bool only_ask = false;
std::atomic<bool> requested = false;

void wait_for_signal() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  int number = 0;
  while (sigwait(&signals, &number) != 0) {
  }
}

[[noreturn]] void end_program() {
  remove_unfinished(unfinished_result);
  const bool terminal = isatty(STDERR_FILENO) == 1;
  const std::string line = "perimode: " + last_line + "\n";
  if (terminal) [[maybe_unused]]
    const auto cleared = write(STDERR_FILENO, "\r\033[K", 4);
  [[maybe_unused]] const auto written = write(STDERR_FILENO, line.data(), line.size());
  std::_Exit(130);
}

void take_signals() {
  while (true) {
    wait_for_signal();
    const std::scoped_lock lock(guard);
    if (!only_ask || requested) end_program();
    requested = true;
  }
}

}  // namespace

void watch_for_interrupts() {
  set_unfinished_result({});
  std::thread(take_signals).detach();
}

void set_unfinished_result(const UnfinishedResult& unfinished, const std::string& line) {
  const std::scoped_lock lock(guard);
  unfinished_result = unfinished;
  if (!only_ask) last_line = line;
}

void interrupts_only_ask(const std::string& line) {
  const std::scoped_lock lock(guard);
  unfinished_result = {};
  last_line = line;
  only_ask = true;
}

bool interrupt_requested() { return requested; }

}  // namespace perimode::cli
