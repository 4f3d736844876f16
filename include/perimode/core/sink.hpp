// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string_view>

namespace perimode {

/// Where a long calculation reports to. The library itself never prints; an empty function is
/// simply not called.
struct Sink {
  std::function<void(std::string_view)> info;
  std::function<void(std::string_view)> warning;
  /// Stage and, where known, the fraction done in [0, 1] (negative: unknown).
  std::function<void(std::string_view stage, double fraction)> progress;

  void inform(std::string_view text) const {
    if (info) info(text);
  }
  void warn(std::string_view text) const {
    if (warning) warning(text);
  }
  void report(std::string_view stage, double fraction = -1.0) const {
    if (progress) progress(stage, fraction);
  }
};

}  // namespace perimode
