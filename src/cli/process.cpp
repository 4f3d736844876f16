// SPDX-License-Identifier: BSD-3-Clause
#include "process.hpp"

#include <cblas.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <string_view>

namespace perimode::cli {

namespace {

constexpr const char* mark = "PERIMODE_PREPARED";

bool lacks_avx512_kernels() {
  __builtin_cpu_init();
  const std::string_view core = openblas_get_corename();
  return (core == "Haswell" || core == "Zen") && __builtin_cpu_supports("avx512f") &&
         __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512vl");
}

}  // namespace

void prepare_process(char** argv) {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  sigprocmask(SIG_BLOCK, &signals, nullptr);
  if (std::getenv(mark) != nullptr) {
    unsetenv(mark);  // not for programs that are started from here
    return;
  }
  constexpr int keep_users = 0;
  setenv(mark, "1", 1);
  setenv("OMP_WAIT_POLICY", "passive", keep_users);
  if (lacks_avx512_kernels()) setenv("OPENBLAS_CORETYPE", "SkylakeX", keep_users);
  execv("/proc/self/exe", argv);
  unsetenv(mark);  // no second start: slower and less sure to stop, but right
}

}  // namespace perimode::cli
