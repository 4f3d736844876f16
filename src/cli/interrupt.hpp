// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace perimode::cli {

/// From here on Ctrl-C and SIGTERM end the program within a second, whatever a solver is doing: one line is
/// printed, the unfinished result is removed, exit code 130. Call once, first thing.
void watch_for_interrupts();

/// The folder an interrupt removes; empty: none.
void set_unfinished_result(const std::filesystem::path& folder);

}  // namespace perimode::cli
