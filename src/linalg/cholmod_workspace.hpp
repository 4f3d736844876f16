// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cholmod.h>

#include "perimode/core/error.hpp"

namespace perimode {

/// CHOLMOD's workspace and settings; silent, and its failures become our errors.
class CholmodWorkspace {
 public:
  CholmodWorkspace() {
    cholmod_start(&common_);
    common_.print = 0;
    common_.error_handler = nullptr;
  }
  ~CholmodWorkspace() { cholmod_finish(&common_); }
  CholmodWorkspace(const CholmodWorkspace&) = delete;
  CholmodWorkspace& operator=(const CholmodWorkspace&) = delete;

  [[nodiscard]] cholmod_common* get() { return &common_; }

  /// Throws unless `fine` and CHOLMOD reports no error (warnings pass).
  void check(bool fine, const char* stage) const {
    if (fine && common_.status >= 0) return;
    const std::string what = std::string("Cholesky ") + stage;
    if (common_.status == CHOLMOD_OUT_OF_MEMORY)
      throw Error(ErrorKind::environment,
                  what + ": out of memory; take fewer particles or a smaller horizon");
    if (common_.status == CHOLMOD_TOO_LARGE)
      throw Error(ErrorKind::environment,
                  what + ": the factor has more than 2^31 entries; take fewer particles");
    throw Error(ErrorKind::solver_failure,
                what + " failed with CHOLMOD code " + std::to_string(common_.status));
  }

 private:
  cholmod_common common_ = {};
};

}  // namespace perimode
