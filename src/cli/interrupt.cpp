// SPDX-License-Identifier: BSD-3-Clause
#include "interrupt.hpp"

#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <mutex>
#include <string_view>
#include <thread>

namespace perimode::cli {

namespace {

std::mutex guard;
UnfinishedResult unfinished_result;

void wait_for_signal() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  int number = 0;
  while (sigwait(&signals, &number) != 0) {
  }
  {
    const std::scoped_lock lock(guard);
    remove_unfinished(unfinished_result);
  }
  const bool terminal = isatty(STDERR_FILENO) == 1;
  const std::string_view line = "perimode: interrupted; nothing was written\n";
  if (terminal) [[maybe_unused]]
    const auto cleared = write(STDERR_FILENO, "\r\033[K", 4);
  [[maybe_unused]] const auto written = write(STDERR_FILENO, line.data(), line.size());
  std::_Exit(130);
}

}  // namespace

void watch_for_interrupts() { std::thread(wait_for_signal).detach(); }

void set_unfinished_result(const UnfinishedResult& unfinished) {
  const std::scoped_lock lock(guard);
  unfinished_result = unfinished;
}

}  // namespace perimode::cli
