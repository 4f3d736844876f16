// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "io/case_node.hpp"

namespace perimode::case_file {

namespace {

std::vector<std::string> split_path(const std::string& path) {
  std::vector<std::string> parts(1);
  for (char c : path) {
    if (c == '.') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

std::optional<std::size_t> list_index(const std::string& part) {
  std::size_t index = 0;
  const auto [end, code] = std::from_chars(part.data(), part.data() + part.size(), index);
  if (code != std::errc() || end != part.data() + part.size()) return std::nullopt;
  return index;
}

CaseNode& child_of_list(CaseNode& list, const std::string& part, const Where& where) {
  const std::optional<std::size_t> index = list_index(part);
  const std::size_t size = list.children.size();
  if (!index || *index > size) {
    invalid_input(
        {fmt::format("a number from 0 to {} for an item of the list (of {}; {} appends)", size, size, size),
         fmt::format("'{}'", part), "count from 0", where});
  }
  if (*index == size) list.children.push_back({.where = where});
  return list.children[*index];
}

CaseNode& child_of_map(CaseNode& map, const std::string& part, const Where& where) {
  for (CaseNode& child : map.children) {
    if (child.key == part) return child;
  }
  map.children.push_back({.where = where, .key = part, .key_where = where});
  return map.children.back();
}

}  // namespace

void apply_override(CaseNode& root, const std::string& key_value) {
  const Where where{"--set " + key_value};
  const std::size_t equals = key_value.find('=');
  if (equals == std::string::npos || equals == 0) {
    invalid_input(
        {"key=value", fmt::format("'{}'", key_value), "write for example body.horizon.ratio=4", where});
  }
  CaseNode* node = &root;
  std::string walked;
  for (const std::string& part : split_path(key_value.substr(0, equals))) {
    if (part.empty()) {
      invalid_input({"a dotted path of keys", fmt::format("'{}'", key_value.substr(0, equals)),
                     "write for example body.horizon.ratio=4", where});
    }
    if (node->kind == CaseNode::Kind::scalar) {
      invalid_input({fmt::format("{} to be a map or a list", walked), describe(*node),
                     fmt::format("set {} itself", walked), where});
    }
    if (node->kind == CaseNode::Kind::null) {
      node->kind = part == "0" ? CaseNode::Kind::sequence : CaseNode::Kind::map;
    }
    const bool list = node->kind == CaseNode::Kind::sequence;
    node = list ? &child_of_list(*node, part, where) : &child_of_map(*node, part, where);
    walked += (walked.empty() ? "" : ".") + part;
  }
  CaseNode value = parse_case_text(key_value.substr(equals + 1), where);
  value.key = node->key;
  value.key_where = where;
  *node = std::move(value);
}

}  // namespace perimode::case_file
