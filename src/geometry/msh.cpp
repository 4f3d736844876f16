// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

#include "core/csv.hpp"
#include "geometry/element.hpp"
#include "perimode/core/error.hpp"
#include "perimode/geometry/mesh.hpp"

namespace perimode {

namespace {

/// Element types of Gmsh that a mesh may hold, by number.
struct MshType {
  int dimension;
  std::optional<Shape> shape;  ///< of those that become particles
};
std::optional<MshType> msh_type(std::int64_t number) {
  static const std::map<std::int64_t, MshType> known = {{15, {0, {}}},
                                                        {1, {1, {}}},
                                                        {8, {1, {}}},
                                                        {26, {1, {}}},
                                                        {27, {1, {}}},
                                                        {28, {1, {}}},
                                                        {9, {2, {}}},
                                                        {10, {2, {}}},
                                                        {16, {2, {}}},
                                                        {20, {2, {}}},
                                                        {21, {2, {}}},
                                                        {22, {2, {}}},
                                                        {23, {2, {}}},
                                                        {24, {2, {}}},
                                                        {25, {2, {}}},
                                                        {36, {2, {}}},
                                                        {37, {2, {}}},
                                                        {6, {3, {}}},
                                                        {7, {3, {}}},
                                                        {11, {3, {}}},
                                                        {12, {3, {}}},
                                                        {13, {3, {}}},
                                                        {14, {3, {}}},
                                                        {17, {3, {}}},
                                                        {18, {3, {}}},
                                                        {19, {3, {}}},
                                                        {29, {3, {}}},
                                                        {30, {3, {}}},
                                                        {31, {3, {}}},
                                                        {92, {3, {}}},
                                                        {93, {3, {}}},
                                                        {2, {2, Shape::triangle}},
                                                        {3, {2, Shape::quadrilateral}},
                                                        {4, {3, Shape::tetrahedron}},
                                                        {5, {3, Shape::hexahedron}}};
  const auto found = known.find(number);
  return found == known.end() ? std::nullopt : std::optional(found->second);
}

class MshReader {
 public:
  MshReader(std::string_view text, const std::filesystem::path& file, int dimension, double section)
      : text_(text), file_(file.string()), section_(section) {
    data_.dimension = dimension;
  }

  CloudData read() {
    if (data_.dimension == 1)
      complain("a body of dimension 2 or 3", "a mesh",
               "give the particles of a bar as a grid or a .csv file");
    next_line();
    if (line_text_ != "$MeshFormat") {
      complain("a Gmsh mesh, which starts with $MeshFormat", quoted(line_text_),
               "save it as Gmsh MSH, version 4.1 or 2.2, ASCII");
    }
    read_format();
    while (next_line()) {
      if (line_text_ == "$PhysicalNames") {
        read_names();
      } else if (line_text_ == "$Entities" && modern_) {
        read_entities();
      } else if (line_text_ == "$Nodes") {
        read_nodes();
      } else if (line_text_ == "$Elements") {
        read_elements();
      } else if (line_text_.starts_with('$')) {
        const std::string end = fmt::format("$End{}", line_text_.substr(1));
        while (need_line(end) != end) {
        }
      } else if (!line_text_.empty()) {
        complain("a section ($Nodes, $Elements, ...)", quoted(line_text_), "save the mesh again");
      }
    }
    finish();
    return std::move(data_);
  }

 private:
  using Key = std::pair<std::int64_t, std::int64_t>;  ///< dimension, tag

  static std::string quoted(std::string_view text) {
    return text.empty() ? "nothing" : fmt::format("'{}'", text.substr(0, 60));
  }

  [[noreturn]] void complain(const std::string& expected, const std::string& got, const std::string& remedy,
                             int line = 0) const {
    invalid_input({expected, got, remedy, {file_, std::max(line > 0 ? line : line_, 1), 1}});
  }

  /// The next line without blanks around it; false at the end of the text.
  bool next_line() {
    if (text_.empty()) {
      line_text_ = {};
      return false;
    }
    line_text_ = next_csv_line(text_);
    ++line_;
    while (!line_text_.empty() && (line_text_.back() == ' ' || line_text_.back() == '\t'))
      line_text_.remove_suffix(1);
    while (!line_text_.empty() && (line_text_.front() == ' ' || line_text_.front() == '\t'))
      line_text_.remove_prefix(1);
    rest_ = line_text_;
    return true;
  }

  std::string_view need_line(std::string_view what) {
    if (!next_line()) complain(std::string(what), "the end of the file", "save the mesh again");
    return line_text_;
  }

  void expect(std::string_view end) {
    if (need_line(end) != end) complain(std::string(end), quoted(line_text_), "save the mesh again");
  }

  std::string_view token() {
    const auto begin = std::min(rest_.find_first_not_of(" \t"), rest_.size());
    rest_.remove_prefix(begin);
    const auto end = std::min(rest_.find_first_of(" \t"), rest_.size());
    const std::string_view word = rest_.substr(0, end);
    rest_.remove_prefix(end);
    return word;
  }

  std::int64_t integer(std::string_view what) {
    const std::string_view word = token();
    std::int64_t value = 0;
    const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (code != std::errc() || end != word.data() + word.size())
      complain(fmt::format("a whole number ({})", what), quoted(word), "save the mesh again");
    return value;
  }

  /// Gmsh gives a group the minus sign where it holds an entity turned round.
  std::int64_t physical_group() {
    const std::int64_t group = integer("physical group");
    if (group == std::numeric_limits<std::int64_t>::min())
      complain("the number of a physical group", fmt::format("{}", group), "save the mesh again");
    return std::abs(group);
  }

  double number(std::string_view what) {
    const std::string_view word = token();
    const auto value = csv_number(word);
    if (!value) complain(fmt::format("a finite number ({})", what), quoted(word), "save the mesh again");
    return *value;
  }

  void read_format() {
    need_line("the format of the mesh");
    const std::string version(token());
    if (version != "4.1" && version != "2.2") {
      complain("format 4.1 or 2.2", quoted(version),
               "save it again, for example gmsh in.msh -save -format msh41 -o out.msh");
    }
    modern_ = version == "4.1";
    if (integer("0: ASCII") != 0) {
      complain("an ASCII mesh", "a binary one",
               "save it with Mesh.Binary = 0, for example gmsh in.msh -save -format msh41 -o out.msh");
    }
    expect("$EndMeshFormat");
  }

  void read_names() {
    need_line("the number of names");
    const std::int64_t count = integer("names");
    for (std::int64_t k = 0; k < count; ++k) {
      need_line("a name");
      const std::int64_t dimension = integer("dimension");
      const std::int64_t tag = integer("physical group");
      const auto begin = rest_.find('"');
      const auto end = rest_.rfind('"');
      if (begin == std::string_view::npos || end <= begin)
        complain("a name in quotes", quoted(rest_), "save the mesh again");
      names_[{dimension, tag}] = std::string(rest_.substr(begin + 1, end - begin - 1));
    }
    expect("$EndPhysicalNames");
  }

  void read_entities() {
    need_line("the numbers of entities");
    std::array<std::int64_t, 4> count = {};
    for (auto& n : count) n = integer("entities");
    for (std::int64_t dimension = 0; dimension < 4; ++dimension) {
      for (std::int64_t k = 0; k < count[static_cast<std::size_t>(dimension)]; ++k) {
        need_line("an entity");
        const std::int64_t tag = integer("entity");
        for (int c = 0; c < (dimension == 0 ? 3 : 6); ++c) (void)number("bounding box");
        if (integer("physical groups") > 0) group_[{dimension, tag}] = physical_group();
      }
    }
    expect("$EndEntities");
  }

  void add_node(std::int64_t tag) {
    Point<3> x;
    for (int a = 0; a < 3; ++a) x[a] = number("coordinate");
    if (!nodes_.emplace(tag, x).second)
      complain("every node once", fmt::format("node {} again", tag), "save the mesh again");
  }

  void read_nodes() {
    need_line("the number of nodes");
    const std::int64_t blocks = integer("nodes");
    if (!modern_) {
      for (std::int64_t k = 0; k < blocks; ++k) {
        need_line("a node");
        add_node(integer("node"));
      }
    }
    std::vector<std::int64_t> tags;
    for (std::int64_t b = 0; modern_ && b < blocks; ++b) {
      need_line("a block of nodes");
      (void)integer("dimension");
      (void)integer("entity");
      (void)integer("parametric");
      const std::int64_t count = integer("nodes");
      tags.clear();
      for (std::int64_t k = 0; k < count; ++k) {
        need_line("the number of a node");
        tags.push_back(integer("node"));
      }
      for (const std::int64_t tag : tags) {
        need_line("coordinates");
        add_node(tag);
      }
    }
    expect("$EndNodes");
  }

  void read_elements() {
    need_line("the number of elements");
    const std::int64_t blocks = integer("elements");
    if (!modern_) {
      for (std::int64_t k = 0; k < blocks; ++k) {
        need_line("an element");
        const std::int64_t tag = integer("element");
        const std::int64_t type = integer("type");
        const std::int64_t tags = integer("number of tags");
        std::int64_t group = 0;
        for (std::int64_t t = 0; t < tags; ++t) {
          if (t == 0) {
            group = physical_group();
          } else {
            (void)integer("tag");
          }
        }
        add_element(tag, type, group);
      }
    }
    for (std::int64_t b = 0; modern_ && b < blocks; ++b) {
      need_line("a block of elements");
      const std::int64_t dimension = integer("dimension");
      const std::int64_t entity = integer("entity");
      const std::int64_t type = integer("type");
      const std::int64_t count = integer("elements");
      const auto group = group_.find({dimension, entity});
      for (std::int64_t k = 0; k < count; ++k) {
        need_line("an element");
        add_element(integer("element"), type, group == group_.end() ? 0 : group->second);
      }
    }
    expect("$EndElements");
  }

  void add_element(std::int64_t tag, std::int64_t number, std::int64_t group) {
    const auto type = msh_type(number);
    if (type && type->dimension < data_.dimension) return;
    if (!type || !type->shape || type->dimension != data_.dimension) {
      complain(data_.dimension == 2 ? "triangles and quadrilaterals of the first order in a 2D body"
                                    : "tetrahedra and hexahedra of the first order in a 3D body",
               fmt::format("element {} of Gmsh type {}", tag, number),
               "mesh with Mesh.ElementOrder = 1, and without prisms and pyramids");
    }
    corner_.clear();
    for (int c = 0; c < nodes_of(*type->shape); ++c) {
      const std::int64_t node = integer("node");
      const auto at = nodes_.find(node);
      if (at == nodes_.end())
        complain("nodes that the mesh has", fmt::format("node {} of element {}", node, tag), "save it again");
      corner_.push_back(at->second);
    }
    if (!token().empty())
      complain(fmt::format("{} nodes of element {}", corner_.size(), tag), "more", "save the mesh again");
    if (data_.dimension == 2 && !is_plane(corner_)) {
      complain("elements in a plane of constant z in a 2D body", fmt::format("element {}", tag),
               "mesh the body in the plane x, y, or set body.dimension: 3");
    }
    const ElementSize size = element_size(*type->shape, corner_);
    const double volume = data_.dimension == 2 ? size.volume * section_ : size.volume;
    if (!(volume > 0.0) || !std::isfinite(volume) || !size.centroid.allFinite()) {
      complain("elements of positive volume", fmt::format("element {}, inverted or without volume", tag),
               "mend the mesh: turn the element (or its surface) round, or remove it");
    }
    if (data_.count() >= static_cast<std::size_t>(std::numeric_limits<Index>::max()))
      complain("fewer than 2^31 elements", "more", "use a coarser mesh");
    for (int a = 0; a < data_.dimension; ++a) data_.position.push_back(size.centroid[a]);
    data_.volume.push_back(volume);
    data_.block.push_back(name_of(group));
    element_.emplace_back(tag, line_);
  }

  std::string name_of(std::int64_t group) const {
    if (group == 0) return {};
    const auto named = names_.find({data_.dimension, group});
    return named == names_.end() ? fmt::format("physical_{}", group) : named->second;
  }

  void finish() const {
    if (data_.count() == 0) {
      complain(fmt::format("elements of dimension {}", data_.dimension), "none",
               data_.dimension == 2 ? "mesh the surfaces, and add them to a physical group if there are any"
                                    : "mesh the volumes, and add them to a physical group if there are any");
    }
    const auto [first, second] = twin_points(data_);
    if (first < 0) return;
    const auto& [tag, line] = element_[static_cast<std::size_t>(second)];
    complain(
        "every element at a place of its own",
        fmt::format("element {} in that of element {}", tag, element_[static_cast<std::size_t>(first)].first),
        "remove one of the two; an element belongs to one physical group", line);
  }

  std::string_view text_, line_text_, rest_;
  std::string file_;
  double section_;
  int line_ = 0;
  bool modern_ = true;
  CloudData data_;
  std::map<Key, std::string> names_;
  std::map<Key, std::int64_t> group_;
  std::unordered_map<std::int64_t, Point<3>> nodes_;
  std::vector<Point<3>> corner_;
  std::vector<std::pair<std::int64_t, int>> element_;  ///< tag and line of each
};

}  // namespace

CloudData read_msh_text(std::string_view text, const std::filesystem::path& file, int dimension,
                        double section) {
  return MshReader(text, file, dimension, section).read();
}

}  // namespace perimode
