// SPDX-License-Identifier: BSD-3-Clause
#include "machine.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <fstream>

#include "perimode/core/error.hpp"

namespace perimode::cli {

namespace {

double first_number(const char* file) {
  std::ifstream in(file);
  double value = 0.0;
  return in >> value ? value : 0.0;  // "max" leaves 0
}

}  // namespace

double available_memory() {
  double available = 0.0;
  std::ifstream in("/proc/meminfo");
  std::string key;
  double kib = 0.0;
  std::string rest;
  while (in >> key >> kib && std::getline(in, rest)) {
    if (key == "MemAvailable:") available = 1024.0 * kib;
  }
  const double limit = first_number("/sys/fs/cgroup/memory.max");
  if (limit > 0.0) {
    const double left = std::max(0.0, limit - first_number("/sys/fs/cgroup/memory.current"));
    available = available > 0.0 ? std::min(available, left) : left;
  }
  return available;
}

double peak_memory() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

std::string bytes_text(double bytes) {
  const double gib = bytes / (1024.0 * 1024.0 * 1024.0);
  return gib >= 1.0 ? fmt::format("{:.1f} GiB", gib) : fmt::format("{:.0f} MiB", std::max(1.0, gib * 1024.0));
}

void refuse_if_too_large(double needed, const char* what) {
  const double available = available_memory();
  if (available <= 0.0 || needed <= 0.95 * available) return;
  throw Error(ErrorKind::environment,
              Complaint{fmt::format("memory for {}: about {}", what, bytes_text(needed)),
                        fmt::format("{} available", bytes_text(available)),
                        "use a larger spacing, a smaller horizon, or a larger machine",
                        {}});
}

}  // namespace perimode::cli
