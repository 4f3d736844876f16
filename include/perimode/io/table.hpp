// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "perimode/core/types.hpp"

namespace perimode {

/// NaN stands for "unknown".
using TableCell = std::variant<double, Offset, std::string>;

struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<TableCell>> rows;  ///< as long as columns
};

/// Comma-separated values: a header, then one line per row. Numbers have 17 significant digits,
/// unknown ones are empty; texts with commas, quotes or line ends are quoted.
/// @pre every row is as long as columns. Throws environment when it cannot be written whole.
void write_csv(const std::filesystem::path& file, const Table& table);

}  // namespace perimode
