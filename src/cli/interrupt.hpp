// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "perimode/io/result_directory.hpp"

namespace perimode::cli {

/// From here on Ctrl-C and SIGTERM end the program within a second, whatever a solver is doing: one line is
/// printed, the unfinished result is removed, exit code 130. @pre prepare_process() has run.
void watch_for_interrupts();

/// What an interrupt removes ({}: nothing), and what it says.
void set_unfinished_result(const UnfinishedResult& unfinished,
                           const std::string& line = "interrupted; nothing was written");

/// From here on a first interrupt only asks: interrupt_requested() turns true, and the run ends itself as
/// soon as it can. A second one ends the program at once with this line, and removes nothing.
void interrupts_only_ask(const std::string& line);

[[nodiscard]] bool interrupt_requested();

}  // namespace perimode::cli
