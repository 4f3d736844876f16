// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace perimode {

/// A complete, commented case of a modal analysis, as `perimode new modal` prints it.
[[nodiscard]] std::string_view modal_template();

}  // namespace perimode
