// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/geometry/cloud.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <string_view>

#include "core/csv.hpp"
#include "geometry/element.hpp"

namespace perimode {

namespace {

class CloudReader {
 public:
  CloudReader(const std::filesystem::path& file, int dimension) : file_(file.string()) {
    data_.dimension = dimension;
  }

  CloudData read(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    while (!text.empty()) {
      ++line_;
      const std::string_view line = next_csv_line(text);
      if (line_ == 1) {
        read_header(line);
      } else if (line.find_first_not_of(" \t") != std::string_view::npos) {
        read_particle(line);
      }
    }
    if (data_.count() == 0) {
      complain("at least one particle", line_ == 0 ? "an empty file" : "none",
               "the first line is " + header(false), {line_, 1});
    }
    require_distinct();
    return std::move(data_);
  }

 private:
  struct Place {
    int line, column;
  };

  [[noreturn]] void complain(const std::string& expected, const std::string& got, const std::string& remedy,
                             Place place) const {
    invalid_input({expected, got, remedy, {file_, std::max(place.line, 1), place.column}});
  }

  [[nodiscard]] std::string header(bool with_block) const {
    return std::string("x,y,z").substr(0, 2 * data_.dimension - 1) +
           (with_block ? ",volume,block" : ",volume");
  }

  void read_header(std::string_view line) {
    std::vector<std::string_view> names;
    for (const CsvField& field : csv_fields(line)) names.push_back(field.text);
    const std::string given = fmt::format("{}", fmt::join(names, ","));
    with_block_ = given == header(true);
    if (!with_block_ && given != header(false)) {
      complain(fmt::format("the header {} or {} of a body of dimension {}", header(false), header(true),
                           data_.dimension),
               fmt::format("'{}'", given.substr(0, 60)), "change the first line", {1, 1});
    }
  }

  [[nodiscard]] double number(const CsvField& field, std::string_view name) const {
    const std::optional<double> value = csv_number(field.text);
    if (!value) {
      complain(fmt::format("a finite number for {}", name), fmt::format("'{}'", field.text.substr(0, 60)),
               "write a plain SI number with a decimal point", {line_, field.column});
    }
    return *value;
  }

  void read_particle(std::string_view line) {
    const std::vector<CsvField> fields = csv_fields(line);
    const auto dimension = static_cast<std::size_t>(data_.dimension);
    const std::size_t wanted = dimension + 1 + (with_block_ ? 1 : 0);
    if (fields.size() != wanted) {
      complain(fmt::format("{} fields ({})", wanted, header(with_block_)), fmt::format("{}", fields.size()),
               "separate fields by commas", {line_, fields[std::min(fields.size() - 1, wanted)].column});
    }
    if (data_.count() >= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
      complain("fewer than 2^31 particles", "more", "use fewer", {line_, 1});
    }
    for (std::size_t a = 0; a < dimension; ++a)
      data_.position.push_back(number(fields[a], std::string_view("xyz").substr(a, 1)));
    const double volume = number(fields[dimension], "volume");
    if (!(volume > 0.0)) {
      complain("a volume > 0 in m3", fmt::format("{}", volume),
               "give the particle's cell volume, thickness or area included",
               {line_, fields[dimension].column});
    }
    data_.volume.push_back(volume);
    if (with_block_) data_.block.emplace_back(fields.back().text);
    line_of_.push_back(line_);
  }

  void require_distinct() const {
    const auto [first, second] = twin_points(data_);
    if (first < 0) return;
    complain("every particle at a point of its own",
             fmt::format("the point of line {} again", line_of_[static_cast<std::size_t>(first)]),
             "remove one of the two", {line_of_[static_cast<std::size_t>(second)], 1});
  }

  std::string file_;
  CloudData data_;
  bool with_block_ = false;
  int line_ = 0;
  std::vector<int> line_of_;
};

}  // namespace

CloudData read_cloud(const std::filesystem::path& file, int dimension) {
  std::error_code code;
  std::ifstream stream(file, std::ios::binary);
  if (!std::filesystem::is_regular_file(file, code) || !stream) {
    invalid_input({"a readable CSV file of particles", "none", "check the path", {file.string()}});
  }
  std::ostringstream content;
  content << stream.rdbuf();
  return read_cloud_text(std::move(content).str(), file, dimension);
}

CloudData read_cloud_text(std::string_view text, const std::filesystem::path& file, int dimension) {
  return CloudReader(file, dimension).read(text);
}

}  // namespace perimode
