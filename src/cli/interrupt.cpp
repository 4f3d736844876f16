// SPDX-License-Identifier: BSD-3-Clause
#include "interrupt.hpp"

#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <mutex>
#include <thread>

namespace perimode::cli {

namespace {

// A handler may only write to a pipe; a thread that waits at its other end does the rest. A pipe rather than
// sigwait, because threads of the BLAS library run before main and would not have the signals blocked.
std::array<int, 2> wake = {-1, -1};
std::mutex guard;
std::filesystem::path unfinished;  // NOLINT(cert-err58-cpp): an empty path does not throw

extern "C" void on_signal(int) {
  const char byte = 1;
  [[maybe_unused]] const auto written = write(wake[1], &byte, 1);
}

void wait_for_signal() {
  char byte = 0;
  while (read(wake[0], &byte, 1) != 1) {
  }
  const char* line = "\nperimode: interrupted; nothing was written\n";
  for (const char* c = line; *c != '\0'; ++c) [[maybe_unused]]
    const auto written = write(STDERR_FILENO, c, 1);
  {
    const std::scoped_lock lock(guard);
    std::error_code ignored;
    if (!unfinished.empty()) std::filesystem::remove_all(unfinished, ignored);
  }
  std::_Exit(130);
}

}  // namespace

void watch_for_interrupts() {
  if (pipe(wake.data()) != 0) return;  // without a pipe the default action ends the program
  std::thread(wait_for_signal).detach();
  struct sigaction action = {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

void set_unfinished_result(const std::filesystem::path& folder) {
  const std::scoped_lock lock(guard);
  unfinished = folder;
}

}  // namespace perimode::cli
