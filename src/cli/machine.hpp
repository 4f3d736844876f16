// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace perimode::cli {

/// Memory this process can still take, bytes: what the kernel calls available, and no more than the
/// control group leaves. 0 when neither can be read.
[[nodiscard]] double available_memory();

/// Largest resident size of this process so far, bytes.
[[nodiscard]] double peak_memory();

/// "3.1 GiB", "12 MiB".
[[nodiscard]] std::string bytes_text(double bytes);

/// Throws Error(environment) when `needed` bytes exceed 95 % of what is available.
void refuse_if_too_large(double needed, const char* what);

}  // namespace perimode::cli
