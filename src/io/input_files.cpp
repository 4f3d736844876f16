// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "io/case_sections.hpp"

namespace perimode::case_file {

std::filesystem::path InputFiles::add(const Cursor& cursor, const char* example, bool from_a_run) {
  std::filesystem::path file = directory / cursor.text(example);
  std::error_code code;
  if (!from_a_run && !std::filesystem::is_regular_file(file, code)) {
    cursor.complain("an existing file",
                    fmt::format("looked for {}; paths are relative to the case file", file.string()));
  }
  if (std::find(found.begin(), found.end(), file) == found.end()) found.push_back(file);
  return file;
}

}  // namespace perimode::case_file
