// SPDX-License-Identifier: BSD-3-Clause
#include "io/number_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>

#include "core/csv.hpp"

namespace perimode {

namespace {

std::string content_of(const std::filesystem::path& file) {
  std::error_code code;
  std::ifstream stream(file, std::ios::binary);
  if (!std::filesystem::is_regular_file(file, code) || !stream) {
    invalid_input({"a readable CSV file of numbers", "none", "check the path", {file.string()}});
  }
  std::ostringstream content;
  content << stream.rdbuf();
  return std::move(content).str();
}

}  // namespace

NumberTable read_number_table(const std::filesystem::path& file, const std::vector<std::string>& headers) {
  const std::string content = content_of(file);
  std::string_view text = content;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  std::vector<std::string_view> given;
  for (const CsvField& field : csv_fields(next_csv_line(text))) given.push_back(field.text);
  const std::string first = fmt::format("{}", fmt::join(given, ","));
  const auto chosen = std::find(headers.begin(), headers.end(), first);
  if (chosen == headers.end()) {
    invalid_input({fmt::format("the header {}", fmt::join(headers, " or ")),
                   fmt::format("'{}'", first.substr(0, 60)),
                   "change the first line",
                   {file.string(), 1, 1}});
  }
  const std::string& header = *chosen;
  const std::vector<CsvField> names = csv_fields(header);
  NumberTable table;
  table.column.resize(names.size());
  for (int line = 2; !text.empty(); ++line) {
    const std::string_view row = next_csv_line(text);
    if (row.find_first_not_of(" \t") == std::string_view::npos) continue;
    const std::vector<CsvField> fields = csv_fields(row);
    if (fields.size() != names.size()) {
      const int column = fields[std::min(fields.size() - 1, names.size())].column;
      invalid_input({fmt::format("{} fields ({})", names.size(), header),
                     fmt::format("{}", fields.size()),
                     "separate fields by commas",
                     {file.string(), line, column}});
    }
    for (std::size_t k = 0; k < fields.size(); ++k) {
      const std::optional<double> value = csv_number(fields[k].text);
      if (!value) {
        invalid_input({fmt::format("a finite number for {}", names[k].text),
                       fmt::format("'{}'", fields[k].text.substr(0, 60)),
                       "write a plain SI number with a decimal point",
                       {file.string(), line, fields[k].column}});
      }
      table.column[k].push_back(*value);
    }
    table.line.push_back(line);
  }
  if (table.rows() == 0) {
    invalid_input({"at least one line of numbers",
                   "none",
                   fmt::format("write them below {}", header),
                   {file.string(), 1, 1}});
  }
  return table;
}

}  // namespace perimode
