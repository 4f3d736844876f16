// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/case_node.hpp"
#include "perimode/geometry/region.hpp"

namespace perimode::case_file {

enum class Sign { any, non_negative, positive };

/// What a number means: told in every complaint about it.
struct Quantity {
  const char* unit = "";      ///< "Pa"; empty for pure numbers
  const char* example = "1";  ///< a value that would be read
  Sign sign = Sign::positive;
};

/// A value of the case and its path ("body.horizon.ratio"). Reads it as what is asked for or
/// throws invalid_input. Refers to a tree that outlives it.
class Cursor {
 public:
  Cursor(const CaseNode& node, std::string path) : node_(&node), path_(std::move(path)) {}

  [[nodiscard]] const CaseNode& node() const { return *node_; }
  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] const Where& where() const { return node_->where; }

  /// Whether the value is written as a number, whatever its size.
  [[nodiscard]] bool is_number() const;
  [[nodiscard]] double number(const Quantity& quantity) const;
  [[nodiscard]] int integer(int lowest, const char* example) const;
  [[nodiscard]] bool boolean() const;
  [[nodiscard]] std::string text(const char* example) const;
  [[nodiscard]] std::vector<Cursor> items(const char* example) const;
  /// The values of a map whose keys are free names (node().key).
  [[nodiscard]] std::vector<Cursor> entries(const char* example) const;
  /// A list of `dimension` finite numbers, m or another unit.
  [[nodiscard]] Coordinates point(int dimension, const char* unit = "m") const;

  /// One of some words.
  template <class T>
  [[nodiscard]] T choice(std::initializer_list<std::pair<std::string_view, T>> choices) const {
    std::vector<std::string_view> words;
    for (const auto& [word, value] : choices) {
      if (node_->kind == CaseNode::Kind::scalar && node_->text == word) return value;
      words.push_back(word);
    }
    not_one_of(words);
  }

  /// "expected <path>: <expected>, got <the value>; <remedy>".
  [[noreturn]] void complain(const std::string& expected, const std::string& remedy) const;

 private:
  [[noreturn]] void not_one_of(const std::vector<std::string_view>& words) const;

  const CaseNode* node_;
  std::string path_;
};

/// A map whose keys have been checked against a list.
class Section {
 public:
  /// Throws invalid_input if the value is no map or holds a key that is not listed.
  Section(const Cursor& cursor, std::initializer_list<std::string_view> keys);

  [[nodiscard]] const Cursor& cursor() const { return cursor_; }
  [[nodiscard]] const Where& where() const { return cursor_.where(); }
  [[nodiscard]] bool has(std::string_view key) const;
  /// The value of a key that may be absent.
  [[nodiscard]] std::optional<Cursor> find(std::string_view key) const;
  /// The value of a key that must be there; `example` shows how to write it.
  [[nodiscard]] Cursor need(std::string_view key, const char* example) const;
  /// The one key of several alternatives that is there; none or two throw.
  [[nodiscard]] std::string_view exactly_one(std::initializer_list<std::string_view> keys) const;
  /// As exactly_one, or empty where none is there.
  [[nodiscard]] std::string_view at_most_one(std::initializer_list<std::string_view> keys) const;
  /// Throws if the key is there.
  void refuse(std::string_view key, const std::string& expected, const std::string& remedy) const;

 private:
  /// Where what is missing is missed: the key of the section, if it has one.
  [[nodiscard]] const Where& place() const;

  Cursor cursor_;
};

/// The word with the least edit distance to `name` (insert, delete, replace, swap neighbours), among those it
/// begins or whose distance is less than half their length; empty where none is that near.
[[nodiscard]] std::string_view nearest_word(std::string_view name,
                                            const std::vector<std::string_view>& words);

}  // namespace perimode::case_file
