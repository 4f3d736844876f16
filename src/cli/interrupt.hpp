// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "perimode/io/result_directory.hpp"

namespace perimode::cli {

/// From here on Ctrl-C and SIGTERM end the program within a second, whatever a solver is doing: one line is
/// printed, the unfinished result is removed, exit code 130. @pre prepare_process() has run.
void watch_for_interrupts();

/// What an interrupt removes; {}: nothing.
void set_unfinished_result(const UnfinishedResult& unfinished);

}  // namespace perimode::cli
