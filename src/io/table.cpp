// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/io/table.hpp"

#include <cmath>
#include <iterator>
#include <string_view>

#include "io/output_file.hpp"

namespace perimode {

namespace {

void append_text(fmt::memory_buffer& out, std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
    out.append(text);
    return;
  }
  out.push_back('"');
  for (char c : text) {
    if (c == '"') out.push_back('"');
    out.push_back(c);
  }
  out.push_back('"');
}

void append_cell(fmt::memory_buffer& out, const TableCell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) {
    append_text(out, *text);
  } else if (const auto* count = std::get_if<Offset>(&cell)) {
    fmt::format_to(std::back_inserter(out), "{}", *count);
  } else if (const double value = std::get<double>(cell); !std::isnan(value)) {
    fmt::format_to(std::back_inserter(out), "{:.17g}", value);
  }
}

}  // namespace

void write_csv(const std::filesystem::path& file, const Table& table) {
  OutputFile output(file);
  fmt::memory_buffer& out = output.buffer();
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (i > 0) out.push_back(',');
    append_text(out, table.columns[i]);
  }
  out.push_back('\n');
  for (const std::vector<TableCell>& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i > 0) out.push_back(',');
      append_cell(out, row[i]);
    }
    out.push_back('\n');
    output.flush_if_full();
  }
  output.close();
}

}  // namespace perimode
