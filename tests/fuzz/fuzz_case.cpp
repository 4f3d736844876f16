// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as a case file: they are read, or refused with invalid_input. Lines that begin with "#set " are
// overrides, as after --set. A small cloud, a table of time and an initial field lie beside the case.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "perimode/core/error.hpp"
#include "perimode/io/case.hpp"

namespace {

std::filesystem::path case_file() {
  const auto folder = std::filesystem::temp_directory_path() / "perimode_fuzz";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "cloud.csv") << "x,y,volume,block\n0,0,0.5,core\n1,0,0.5,\n0,1,0.5,core\n";
  std::ofstream(folder / "a.csv") << "time,value\n0,0\n1,1\n";
  std::ofstream(folder / "u0.csv") << "x,y\n";
  return folder / "case.yaml";
}

std::vector<std::string> overrides_in(std::string_view text) {
  constexpr std::string_view mark = "#set ";
  std::vector<std::string> out;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    if (line.starts_with(mark)) out.emplace_back(line.substr(mark.size()));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
  }
  return out;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path file = case_file();
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    (void)perimode::read_case_text(text, file, overrides_in(text));
  } catch (const perimode::Error& error) {
    if (error.kind() != perimode::ErrorKind::invalid_input) throw;
  }
  return 0;
}
