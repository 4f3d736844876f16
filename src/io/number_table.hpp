// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "perimode/core/error.hpp"

namespace perimode {

/// A file of numbers in columns.
struct NumberTable {
  std::vector<std::vector<double>> column;
  std::vector<int> line;  ///< of every row in the file, from 1

  [[nodiscard]] std::size_t rows() const { return line.size(); }
};

/// Reads comma-separated numbers under exactly one of the headers given ("time,value"). Windows line ends, a
/// byte order mark, blanks around fields and empty lines are accepted. Throws invalid_input with
/// file:line:column: an unreadable file, another header, a wrong number of fields, what is no finite number,
/// no row.
[[nodiscard]] NumberTable read_number_table(const std::filesystem::path& file,
                                            const std::vector<std::string>& headers);

}  // namespace perimode
