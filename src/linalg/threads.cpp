// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/linalg/threads.hpp"

#include <omp.h>

#include <string>

#include "perimode/core/error.hpp"

extern "C" void openblas_set_num_threads(int);

namespace perimode {

void set_threads(int count) {
  if (count < 1)
    invalid_input({.expected = "a thread count of at least 1",
                   .got = std::to_string(count),
                   .remedy = "give 1 for a serial run"});
  omp_set_num_threads(count);
  openblas_set_num_threads(count);
}

int threads() { return omp_get_max_threads(); }

}  // namespace perimode
