// SPDX-License-Identifier: BSD-3-Clause
#include "io/case_node.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

namespace perimode::case_file {

namespace {

constexpr int deepest = 64;  ///< levels of nesting; deeper is an anchor in itself
constexpr std::size_t most_nodes = 200000;
constexpr std::size_t most_bytes = 4U << 20U;

Where place(const YAML::Mark& mark, const Where& base) {
  if (base.line == 0 || mark.is_null()) return {base.file, 0, 0};
  return {base.file, mark.line + 1, mark.column + 1};
}

/// The YAML library closes an open quotation at the end of the file without a word.
void require_closed_quote(const std::string& text, const YAML::Mark& mark, const Where& where) {
  const auto start = static_cast<std::size_t>(mark.pos);
  if (mark.pos < 0 || start >= text.size()) return;
  const char quote = text[start];
  if (quote != '"' && quote != '\'') return;
  for (std::size_t i = start + 1; i < text.size(); ++i) {
    if (quote == '"' && text[i] == '\\') {
      ++i;
    } else if (text[i] == quote) {
      if (quote == '"' || i + 1 == text.size() || text[i + 1] != quote) return;
      ++i;  // '' stands for one quote
    }
  }
  invalid_input({fmt::format("a closing {}", quote), "the end of the file",
                 "close the quotation that starts here", where});
}

class Converter {
 public:
  Converter(const std::string& text, Where base) : text_(text), base_(std::move(base)) {}

  CaseNode convert(const YAML::Node& yaml, int depth = 0) {
    CaseNode node;
    node.where = place(yaml.Mark(), base_);
    if (depth > deepest || ++nodes_ > most_nodes) {
      invalid_input({fmt::format("at most {} levels and {} values", deepest, most_nodes), "more",
                     "look for an anchor that contains itself", node.where});
    }
    switch (yaml.Type()) {
      case YAML::NodeType::Undefined:
      case YAML::NodeType::Null:
        break;
      case YAML::NodeType::Scalar:
        node.kind = CaseNode::Kind::scalar;
        node.text = yaml.Scalar();
        if (yaml.Tag() == "!") require_closed_quote(text_, yaml.Mark(), node.where);
        break;
      case YAML::NodeType::Sequence:
        node.kind = CaseNode::Kind::sequence;
        for (const auto& item : yaml) node.children.push_back(convert(item, depth + 1));
        break;
      case YAML::NodeType::Map:
        node.kind = CaseNode::Kind::map;
        convert_map(yaml, depth, node);
        break;
    }
    return node;
  }

 private:
  void convert_map(const YAML::Node& yaml, int depth, CaseNode& node) {
    std::map<std::string, Where> seen;
    for (const auto& pair : yaml) {
      const CaseNode key = convert(pair.first, depth + 1);
      if (key.kind != CaseNode::Kind::scalar) {
        invalid_input({"a key (a word)", describe(key), "write `key: value`", key.where});
      }
      const auto [earlier, fresh] = seen.emplace(key.text, key.where);
      if (!fresh) {
        const int line = earlier->second.line;
        const std::string first = line > 0 ? fmt::format(" (first in line {})", line) : std::string();
        invalid_input(
            {"every key once", fmt::format("'{}' again{}", key.text, first), "keep one of them", key.where});
      }
      CaseNode value = convert(pair.second, depth + 1);
      if (value.kind == CaseNode::Kind::null) value.where = key.where;  // an empty value has no place
      value.key = key.text;
      value.key_where = key.where;
      node.children.push_back(std::move(value));
    }
  }

  const std::string& text_;
  Where base_;
  std::size_t nodes_ = 0;
};

/// Byte number of the first byte that text in UTF-8 cannot hold, or npos.
std::size_t first_bad_byte(const std::string& text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (byte < 0x20 && byte != '\t' && byte != '\n' && byte != '\r') return i;
    if (byte == 0x7F) return i;
    const std::size_t more = byte < 0x80 ? 0 : byte >= 0xF0 ? 3 : byte >= 0xE0 ? 2 : 1;
    if ((byte >= 0x80 && byte < 0xC2) || byte > 0xF4) return i;
    for (std::size_t k = 1; k <= more; ++k) {
      if (i + k >= text.size() || (static_cast<unsigned char>(text[i + k]) & 0xC0U) != 0x80U) return i;
    }
    i += more + 1;
  }
  return std::string::npos;
}

void require_text(const std::string& text, const Where& base) {
  const std::size_t bad = first_bad_byte(text);
  if (bad == std::string::npos) return;
  Where where = base;
  for (std::size_t i = 0; i < bad; ++i) {
    ++where.column;
    if (text[i] == '\n') where = {base.file, where.line + 1, 1};
  }
  invalid_input({"text in UTF-8", fmt::format("the byte 0x{:02X}", static_cast<unsigned char>(text[bad])),
                 "give a YAML or JSON file", where});
}

/// Notes where documents begin.
class DocumentStarts : public YAML::EventHandler {
 public:
  std::vector<YAML::Mark> marks;

  void OnDocumentStart(const YAML::Mark& mark) override { marks.push_back(mark); }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t, const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
  }
  void OnMapEnd() override {}
};

/// What follows the first document would be read by nobody: a second document, or text that ends
/// the first one too early.
void require_one_document(const std::string& text, const Where& where) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  DocumentStarts starts;
  while (starts.marks.size() < 2 && parser.HandleNextDocument(starts)) {
  }
  if (starts.marks.size() < 2) return;
  const Where second = place(starts.marks[1], where);
  const std::string rest = text.substr(std::min(static_cast<std::size_t>(starts.marks[1].pos), text.size()));
  if (rest.starts_with("---")) {
    invalid_input({"one YAML document", "a second one", "remove the line `---`", second});
  }
  invalid_input({"the end of the YAML text", fmt::format("'{}'", rest.substr(0, 1)),
                 "remove it, or check brackets and indentation before it", second});
}

}  // namespace

const CaseNode* CaseNode::find(std::string_view name) const {
  for (const CaseNode& child : children) {
    if (kind == Kind::map && child.key == name) return &child;
  }
  return nullptr;
}

std::string describe(const CaseNode& node) {
  switch (node.kind) {
    case CaseNode::Kind::null:
      return "nothing";
    case CaseNode::Kind::scalar:
      return node.text.size() <= 60 ? fmt::format("'{}'", node.text)
                                    : fmt::format("'{}...'", node.text.substr(0, 57));
    case CaseNode::Kind::sequence:
      return fmt::format("a list of {}", node.children.size());
    case CaseNode::Kind::map:
      break;
  }
  return "a map";
}

CaseNode parse_case_text(const std::string& text, const Where& where) {
  require_text(text, where);
  try {
    require_one_document(text, where);
    return Converter(text, where).convert(YAML::Load(text));
  } catch (const YAML::Exception& error) {
    invalid_input({"YAML", fmt::format("a syntax error ({})", error.msg),
                   "check indentation (spaces, no tabs), brackets, quotes and the space after ':' near here",
                   place(error.mark, where)});
  }
}

std::string read_case_bytes(const std::filesystem::path& file) {
  const Where where{file.string()};
  std::error_code code;
  const auto status = std::filesystem::status(file, code);
  if (!std::filesystem::exists(status)) {
    invalid_input({"a case file", "no such file", "check the path", where});
  }
  if (std::filesystem::is_directory(status)) {
    invalid_input({"a case file", "a directory", "name the .yaml or .json file in it", where});
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    invalid_input({"a readable case file", "one that cannot be opened", "check its permissions", where});
  }
  std::string text(most_bytes + 1, '\0');  // whatever the file says of its size: it may be a device or a pipe
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > most_bytes) {
    invalid_input({"a case file of at most 4 MB", "more", "particles belong into a CSV file", where});
  }
  return text;
}

CaseNode parse_case_tree(std::string_view text, const std::filesystem::path& file) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const Where start{file.string(), 1, 1};
  CaseNode root = parse_case_text(std::string(text), start);
  if (root.kind == CaseNode::Kind::null) {
    invalid_input({"a case", "an empty file", "start from the text that `perimode new modal` prints", start});
  }
  return root;
}

}  // namespace perimode::case_file
