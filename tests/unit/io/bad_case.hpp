// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>
#include <vector>

#include "perimode/io/case.hpp"
#include "unit/io/sample_cases.hpp"
#include "unit/io/temporary_folder.hpp"

namespace perimode::test {

/// A good case in which the line that begins with `word` is replaced by `line`. The mark ^ (which is
/// taken out) stands where the error must point.
struct BadCase {
  const char* name;
  const char* base;
  const char* word;
  const char* line;
  std::vector<const char*> says;  ///< parts of the message
};

inline void PrintTo(const BadCase& bad, std::ostream* out) { *out << bad.name; }

inline std::string replace_line(const std::string& text, const std::string& word, const std::string& line) {
  std::size_t at = 0;
  while (text.compare(text.find_first_not_of(' ', at), word.size(), word) != 0) at = text.find('\n', at) + 1;
  return text.substr(0, at) + line + text.substr(text.find('\n', at));
}

/// Reads the case: one error of kind invalid_input, at the mark, in one line, with a remedy.
inline void expect_complaint(const BadCase& bad) {
  std::string text = replace_line(sample_cases().at(bad.base), bad.word, bad.line);
  const std::size_t mark = text.find('^');
  ASSERT_NE(mark, std::string::npos);
  text.erase(mark, 1);
  const auto before = text.substr(0, mark);
  const int line = 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n'));
  const int column = static_cast<int>(mark - (before.rfind('\n') + 1)) + 1;

  const TemporaryFolder folder;
  (void)folder.write("cloud.csv", sample_cloud());
  const auto file = folder.write("case.yaml", text);
  try {
    (void)read_case(file);
    FAIL() << "read without an error:\n" << text;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
    EXPECT_EQ(error.where().line, line) << error.what();
    EXPECT_EQ(error.where().column, column) << error.what();
    EXPECT_THAT(error.what(), testing::StartsWith(file.string() + ":" + std::to_string(line) + ":"));
    EXPECT_THAT(error.what(), testing::HasSubstr("; "));  // the remedy
    EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n")));
    for (const char* part : bad.says) EXPECT_THAT(error.what(), testing::HasSubstr(part));
  }
}

inline std::string name_of(const testing::TestParamInfo<BadCase>& info) { return info.param.name; }

}  // namespace perimode::test
