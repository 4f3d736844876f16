// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace perimode {

/// A complete, commented case of a modal analysis, as `perimode new modal` prints it.
[[nodiscard]] std::string_view modal_template();

/// A complete, commented case of a static analysis, as `perimode new static` prints it.
[[nodiscard]] std::string_view static_template();

/// A complete, commented case of a transient analysis, as `perimode new transient` prints it.
[[nodiscard]] std::string_view transient_template();

/// A complete, commented case of a quasi-static analysis, as `perimode new quasistatic` prints it.
[[nodiscard]] std::string_view quasistatic_template();

/// A complete, commented case of a dispersion analysis, as `perimode new dispersion` prints it.
[[nodiscard]] std::string_view dispersion_template();

}  // namespace perimode
