// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <iterator>

#include "io/case_node.hpp"

namespace perimode::case_file {

namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) < 0x20) {
      fmt::format_to(std::back_inserter(out), "\\u{:04x}", static_cast<int>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

}  // namespace

std::string json_text(const CaseNode& node) {
  switch (node.kind) {
    case CaseNode::Kind::null:
      return "null";
    case CaseNode::Kind::scalar:
      return quoted(node.text);
    case CaseNode::Kind::sequence:
    case CaseNode::Kind::map:
      break;
  }
  const bool map = node.kind == CaseNode::Kind::map;
  std::string out(1, map ? '{' : '[');
  for (const CaseNode& child : node.children) {
    if (out.size() > 1) out += ',';
    if (map) out += quoted(child.key) + ':';
    out += json_text(child);
  }
  return out + (map ? '}' : ']');
}

}  // namespace perimode::case_file
