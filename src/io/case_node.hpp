// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "perimode/core/error.hpp"

namespace perimode::case_file {

/// One value of a case file with the place it stands at. Anchors are resolved, and no map holds a
/// key twice.
struct CaseNode {
  enum class Kind { null, scalar, sequence, map };
  Kind kind = Kind::null;
  std::string text = {};  ///< scalar
  Where where = {};
  std::vector<CaseNode> children = {};  ///< sequence and map, in file order
  std::string key = {};                 ///< of a map's child
  Where key_where = {};

  /// The child of a map, or null.
  [[nodiscard]] const CaseNode* find(std::string_view name) const;
};

/// The bytes of a case file. Throws invalid_input: no file, an unreadable one, more than 4 MB.
[[nodiscard]] std::string read_case_bytes(const std::filesystem::path& file);

/// Reads a whole case in YAML (JSON is a part of it). Throws invalid_input: no text, syntax errors, several
/// documents, duplicate or non-text keys, anchors that contain themselves. Cost O(bytes log keys).
[[nodiscard]] CaseNode parse_case_tree(std::string_view text, const std::filesystem::path& file);

/// The value of YAML text; every place of it is `where` where that has no line.
[[nodiscard]] CaseNode parse_case_text(const std::string& text, const Where& where);

/// Sets the value at a dotted path from "key=value", creating what is missing on the way.
void apply_override(CaseNode& root, const std::string& key_value);

/// The value as JSON in one line: scalars as text, maps in file order.
[[nodiscard]] std::string json_text(const CaseNode& node);

/// "'210 GPa'", "a list of 2", "a map", "nothing".
[[nodiscard]] std::string describe(const CaseNode& node);

}  // namespace perimode::case_file
