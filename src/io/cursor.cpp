// SPDX-License-Identifier: BSD-3-Clause
#include "io/cursor.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace perimode::case_file {

namespace {

std::optional<double> parse_number(std::string_view text, bool& out_of_range) {
  const auto first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return std::nullopt;
  text = text.substr(first, text.find_last_not_of(' ') - first + 1);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  out_of_range = code == std::errc::result_out_of_range;
  if (end != text.data() + text.size() || code != std::errc()) return std::nullopt;
  return value;
}

/// Begins like a number, goes on like a unit: "210 GPa", "5mm".
bool looks_like_unit(std::string_view text) {
  double value = 0.0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  std::string_view rest(end, static_cast<std::size_t>(text.data() + text.size() - end));
  while (rest.starts_with(' ')) rest.remove_prefix(1);
  return code == std::errc() && std::isfinite(value) && !rest.empty() &&
         std::isalpha(static_cast<unsigned char>(rest.front())) != 0;
}

std::string wanted(const Quantity& quantity) {
  std::string text = quantity.sign == Sign::positive       ? "a number > 0"
                     : quantity.sign == Sign::non_negative ? "a number >= 0"
                                                           : "a number";
  if (*quantity.unit != '\0') text += fmt::format(" in {}", quantity.unit);
  return text;
}

int edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<int>> d(a.size() + 1, std::vector<int>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = static_cast<int>(i + j);
        continue;
      }
      const int change = a[i - 1] == b[j - 1] ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
      }
    }
  }
  return d[a.size()][b.size()];
}

std::string of_path(const std::string& path) { return path.empty() ? "the case" : path; }

}  // namespace

std::string_view nearest_word(std::string_view name, const std::vector<std::string_view>& words) {
  const std::string_view start = name.substr(0, 80);
  std::string_view nearest;
  int least = std::numeric_limits<int>::max();
  for (const std::string_view word : words) {
    const int distance = edit_distance(start, word);
    const bool alike = 2 * distance < static_cast<int>(std::max(start.size(), word.size())) ||
                       (start.size() > 1 && word.starts_with(start));
    if (!alike || distance >= least) continue;
    nearest = word;
    least = distance;
  }
  return nearest;
}

void Cursor::complain(const std::string& expected, const std::string& remedy) const {
  invalid_input({path_.empty() ? expected : path_ + ": " + expected, describe(*node_), remedy, where()});
}

void Cursor::not_one_of(const std::vector<std::string_view>& words) const {
  std::string remedy = "choose one of them";
  if (node_->kind == CaseNode::Kind::scalar) {
    const std::string_view nearest = nearest_word(node_->text, words);
    if (!nearest.empty()) remedy = fmt::format("the nearest is {}", nearest);
  }
  complain(fmt::format("one of {}", fmt::join(words, ", ")), remedy);
}

bool Cursor::is_number() const {
  bool out_of_range = false;
  return node_->kind == CaseNode::Kind::scalar &&
         (parse_number(node_->text, out_of_range).has_value() || out_of_range);
}

double Cursor::number(const Quantity& quantity) const {
  const std::string show = fmt::format("for example {}", quantity.example);
  if (node_->kind != CaseNode::Kind::scalar) complain(wanted(quantity), show);
  bool out_of_range = false;
  const std::optional<double> value = parse_number(node_->text, out_of_range);
  if (out_of_range) complain(wanted(quantity), "it must fit a double, about 1e-307 to 1e+308");
  if (!value && looks_like_unit(node_->text)) {
    const std::string unit = *quantity.unit != '\0' ? fmt::format(" in {}", quantity.unit) : "";
    complain(wanted(quantity),
             fmt::format("units are not read: write the plain SI number{}, {}", unit, show));
  }
  if (!value) complain(wanted(quantity), show);
  if (!std::isfinite(*value)) complain(wanted(quantity), "it must be finite, " + show);
  const bool good =
      quantity.sign == Sign::any || (quantity.sign == Sign::non_negative && *value >= 0.0) || *value > 0.0;
  if (!good) complain(wanted(quantity), show);
  return *value;
}

int Cursor::integer(int lowest, const char* example) const {
  const std::string expected = fmt::format("a whole number >= {}", lowest);
  const std::string show = fmt::format("for example {}", example);
  if (node_->kind != CaseNode::Kind::scalar) complain(expected, show);
  bool out_of_range = false;
  const std::optional<double> value = parse_number(node_->text, out_of_range);
  if (!value || !(*value >= lowest) || *value != std::floor(*value)) complain(expected, show);
  if (*value > std::numeric_limits<int>::max()) complain(expected + " and below 2^31", show);
  return static_cast<int>(*value);
}

bool Cursor::boolean() const { return choice<bool>({{"true", true}, {"false", false}}); }

std::string Cursor::text(const char* example) const {
  if (node_->kind != CaseNode::Kind::scalar || node_->text.empty()) {
    complain("text", fmt::format("for example {}", example));
  }
  return node_->text;
}

std::vector<Cursor> Cursor::items(const char* example) const {
  if (node_->kind != CaseNode::Kind::sequence) complain("a list", fmt::format("for example {}", example));
  std::vector<Cursor> result;
  for (std::size_t i = 0; i < node_->children.size(); ++i) {
    result.emplace_back(node_->children[i], fmt::format("{}.{}", path_, i));
  }
  return result;
}

std::vector<Cursor> Cursor::entries(const char* example) const {
  if (node_->kind != CaseNode::Kind::map) complain("a map", fmt::format("for example {}", example));
  std::vector<Cursor> result;
  result.reserve(node_->children.size());
  for (const CaseNode& child : node_->children) result.emplace_back(child, path_ + "." + child.key);
  return result;
}

Coordinates Cursor::point(int dimension, const char* unit) const {
  const char* examples[] = {"[0.5]", "[0.5, 0.25]", "[0.5, 0.25, 0.1]"};
  const char* example = examples[dimension - 1];
  const std::string expected =
      fmt::format("a list of {} number{} in {}", dimension, dimension == 1 ? "" : "s", unit);
  if (node_->kind != CaseNode::Kind::sequence ||
      node_->children.size() != static_cast<std::size_t>(dimension)) {
    complain(expected, fmt::format("the body has dimension {}: for example {}", dimension, example));
  }
  Coordinates result;
  for (const Cursor& item : items(example)) result.push_back(item.number({unit, "0.5", Sign::any}));
  return result;
}

Section::Section(const Cursor& cursor, std::initializer_list<std::string_view> keys) : cursor_(cursor) {
  const std::vector<std::string_view> valid(keys);
  if (cursor.node().kind != CaseNode::Kind::map) {
    cursor.complain("a map", fmt::format("its keys are {}", fmt::join(valid, ", ")));
  }
  for (const CaseNode& child : cursor.node().children) {
    if (std::find(valid.begin(), valid.end(), child.key) != valid.end()) continue;
    const std::string_view nearest = nearest_word(child.key, valid);
    std::string remedy =
        nearest.empty() ? "choose one of them" : fmt::format("the nearest valid key is {}", nearest);
    if (child.key.find(':') != std::string::npos) remedy += " (a space must follow the ':')";
    if (child.key == "<<") remedy = "merge keys are not read: use an anchor for a whole value";
    invalid_input({fmt::format("a key of {} ({})", of_path(cursor.path()), fmt::join(valid, ", ")),
                   fmt::format("'{}'", child.key), remedy, child.key_where});
  }
}

const Where& Section::place() const {
  const Where& key = cursor_.node().key_where;
  return key.file.empty() ? where() : key;
}

bool Section::has(std::string_view key) const { return cursor_.node().find(key) != nullptr; }

std::optional<Cursor> Section::find(std::string_view key) const {
  const CaseNode* child = cursor_.node().find(key);
  if (child == nullptr) return std::nullopt;
  const std::string prefix = cursor_.path().empty() ? "" : cursor_.path() + ".";
  return Cursor(*child, prefix + std::string(key));
}

Cursor Section::need(std::string_view key, const char* example) const {
  std::optional<Cursor> found = find(key);
  if (!found) {
    invalid_input({fmt::format("the key '{}' in {}", key, of_path(cursor_.path())), "none",
                   fmt::format("add for example `{}: {}`", key, example), place()});
  }
  return *found;
}

std::string_view Section::at_most_one(std::initializer_list<std::string_view> keys) const {
  std::string_view chosen;
  for (const CaseNode& child : cursor_.node().children) {
    const auto* key = std::find(keys.begin(), keys.end(), child.key);
    if (key == keys.end()) continue;
    if (!chosen.empty()) {
      invalid_input({fmt::format("one of {} in {}", fmt::join(keys, ", "), of_path(cursor_.path())),
                     fmt::format("both '{}' and '{}'", chosen, child.key), "keep one of them",
                     child.key_where});
    }
    chosen = *key;
  }
  return chosen;
}

std::string_view Section::exactly_one(std::initializer_list<std::string_view> keys) const {
  const std::string_view chosen = at_most_one(keys);
  if (chosen.empty()) {
    invalid_input({fmt::format("one of {} in {}", fmt::join(keys, ", "), of_path(cursor_.path())), "none",
                   "give one of them", place()});
  }
  return chosen;
}

void Section::refuse(std::string_view key, const std::string& expected, const std::string& remedy) const {
  const CaseNode* child = cursor_.node().find(key);
  if (child == nullptr) return;
  invalid_input({expected, fmt::format("the key '{}'", key), remedy, child->key_where});
}

}  // namespace perimode::case_file
