// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace perimode {

/// A field of a line of comma-separated values.
struct CsvField {
  std::string_view text;  ///< without blanks around it
  int column;             ///< from 1
};

/// The fields of a line; quotes have no meaning.
[[nodiscard]] std::vector<CsvField> csv_fields(std::string_view line);

/// The next line without its end (Windows ends too), taken off the text.
[[nodiscard]] std::string_view next_csv_line(std::string_view& text);

/// A finite number, a sign + allowed; empty for anything else.
[[nodiscard]] std::optional<double> csv_number(std::string_view field);

}  // namespace perimode
