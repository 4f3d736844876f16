// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/exodus_mesh.hpp"

#include <exodusII.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "geometry/element.hpp"
#include "perimode/core/error.hpp"

namespace perimode {

namespace {

/// An open file, closed at the end.
class ExodusFile {
 public:
  explicit ExodusFile(const std::filesystem::path& file) : name_(file.string()) {
    ex_opts(EX_DEFAULT);  // report errors by code, print nothing
    int word = sizeof(double), stored = 0;
    float version = 0.0F;
    id_ = ex_open(name_.c_str(), EX_READ, &word, &stored, &version);
    if (id_ < 0) complain("a readable Exodus mesh", "none", "check the path and the format");
    ex_set_int64_status(id_, EX_ALL_INT64_API);
    ex_set_max_name_length(id_, static_cast<int>(longest_name));
  }
  ~ExodusFile() {
    if (id_ >= 0) ex_close(id_);
  }
  ExodusFile(const ExodusFile&) = delete;
  ExodusFile& operator=(const ExodusFile&) = delete;

  static constexpr std::size_t longest_name = 255;

  [[nodiscard]] int id() const { return id_; }
  void check(int status) const {
    if (status < 0) complain("a whole Exodus mesh", "a file that breaks off or is damaged", "write it again");
  }
  [[noreturn]] void complain(const std::string& expected, const std::string& got,
                             const std::string& remedy) const {
    invalid_input({expected, got, remedy, {name_}});
  }

 private:
  std::string name_;
  int id_ = -1;
};

/// Dimension of the elements of a block, and their shape where they become particles.
struct BlockShape {
  int dimension = 3;
  std::optional<Shape> shape;
};
BlockShape block_shape(std::string topology, std::int64_t nodes) {
  for (char& c : topology) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  const auto is = [&](const char* name) { return topology.starts_with(name); };
  if (is("SPHERE") || is("POINT") || is("CIRCLE") || is("NODE")) return {0, {}};
  if (is("BAR") || is("BEAM") || is("TRUSS") || is("EDGE") || is("LINE")) return {1, {}};
  if (is("TRI")) return {2, nodes == 3 ? std::optional(Shape::triangle) : std::nullopt};
  if (is("QUAD")) return {2, nodes == 4 ? std::optional(Shape::quadrilateral) : std::nullopt};
  if (is("SHELL")) return {2, {}};
  if (is("TET")) return {3, nodes == 4 ? std::optional(Shape::tetrahedron) : std::nullopt};
  if (is("HEX")) return {3, nodes == 8 ? std::optional(Shape::hexahedron) : std::nullopt};
  return {3, {}};
}

}  // namespace

CloudData read_exodus_mesh(const std::filesystem::path& path, int dimension, double section) {
  const ExodusFile file(path);
  if (dimension == 1) {
    file.complain("a body of dimension 2 or 3 for a mesh", "dimension 1",
                  "give the particles of a bar as a grid or a .csv file");
  }
  ex_init_params mesh = {};
  file.check(ex_get_init_ext(file.id(), &mesh));
  if (mesh.num_dim < dimension) {
    file.complain(fmt::format("a mesh of dimension {}", dimension), fmt::format("{}", mesh.num_dim),
                  "change body.dimension");
  }
  const auto count = static_cast<std::size_t>(std::max<std::int64_t>(mesh.num_nodes, 0));
  std::array<std::vector<double>, 3> x;
  for (auto& component : x) component.assign(count, 0.0);
  if (count > 0)
    file.check(ex_get_coord(file.id(), x[0].data(), x[1].data(), mesh.num_dim > 2 ? x[2].data() : nullptr));
  std::vector<std::int64_t> number(static_cast<std::size_t>(std::max<std::int64_t>(mesh.num_elem, 0)));
  if (!number.empty()) file.check(ex_get_id_map(file.id(), EX_ELEM_MAP, number.data()));
  std::vector<std::int64_t> block_id(static_cast<std::size_t>(std::max<std::int64_t>(mesh.num_elem_blk, 0)));
  if (!block_id.empty()) file.check(ex_get_ids(file.id(), EX_ELEM_BLOCK, block_id.data()));

  CloudData cloud;
  cloud.dimension = dimension;
  std::vector<std::int64_t> particle;  // element of each
  std::vector<std::int64_t> node;
  std::vector<Point<3>> corner;
  std::size_t first = 0;  // element of the block
  for (const std::int64_t id : block_id) {
    ex_block block = {};
    block.id = id;
    block.type = EX_ELEM_BLOCK;
    file.check(ex_get_block_param(file.id(), &block));
    const std::string topology(block.topology, strnlen(block.topology, sizeof(block.topology)));
    const auto [of_dimension, shape] = block_shape(topology, block.num_nodes_per_entry);
    const auto elements = static_cast<std::size_t>(std::max<std::int64_t>(block.num_entry, 0));
    const std::size_t start = first;
    first += elements;
    if (elements == 0 || of_dimension < dimension) continue;
    if (first > number.size()) file.check(-1);
    std::array<char, ExodusFile::longest_name + 1> name = {};
    file.check(ex_get_name(file.id(), EX_ELEM_BLOCK, id, name.data()));
    const std::string label = name[0] == '\0' ? fmt::format("block_{}", id) : std::string(name.data());
    if (!shape || of_dimension != dimension) {
      file.complain(
          dimension == 2 ? "TRI3 and QUAD4 elements in a 2D body" : "TETRA4 and HEX8 elements in a 3D body",
          fmt::format("block '{}' of {} with {} nodes", label, topology, block.num_nodes_per_entry),
          "mesh with elements of the first order");
    }
    const auto nodes = static_cast<std::size_t>(nodes_of(*shape));
    node.resize(elements * nodes);
    file.check(ex_get_conn(file.id(), EX_ELEM_BLOCK, id, node.data(), nullptr, nullptr));
    for (std::size_t e = 0; e < elements; ++e) {
      const std::int64_t tag = number[start + e];
      corner.clear();
      for (std::size_t c = 0; c < nodes; ++c) {
        const std::int64_t n = node[e * nodes + c];
        if (n < 1 || n > mesh.num_nodes)
          file.complain("nodes that the mesh has", fmt::format("node {} of element {}", n, tag),
                        "write it again");
        const auto at = static_cast<std::size_t>(n - 1);
        corner.emplace_back(x[0][at], x[1][at], x[2][at]);
      }
      if (dimension == 2 && !is_plane(corner)) {
        file.complain("elements in a plane of constant z in a 2D body", fmt::format("element {}", tag),
                      "mesh the body in the plane x, y, or set body.dimension: 3");
      }
      const ElementSize size = element_size(*shape, corner);
      const double volume = dimension == 2 ? size.volume * section : size.volume;
      if (!(volume > 0.0) || !std::isfinite(volume) || !size.centroid.allFinite()) {
        file.complain("elements of positive volume",
                      fmt::format("element {} of block '{}', inverted or without volume", tag, label),
                      "mend the mesh: turn the element round, or remove it");
      }
      if (cloud.count() >= static_cast<std::size_t>(std::numeric_limits<Index>::max()))
        file.complain("fewer than 2^31 elements", "more", "use a coarser mesh");
      for (int a = 0; a < dimension; ++a) cloud.position.push_back(size.centroid[a]);
      cloud.volume.push_back(volume);
      cloud.block.push_back(label);
      particle.push_back(tag);
    }
  }
  if (cloud.count() == 0)
    file.complain(fmt::format("elements of dimension {}", dimension), "none",
                  "mesh the body, not its boundary");
  const auto [one, other] = twin_points(cloud);
  if (one >= 0) {
    file.complain("every element at a place of its own",
                  fmt::format("element {} in that of element {}", particle[static_cast<std::size_t>(other)],
                              particle[static_cast<std::size_t>(one)]),
                  "remove one of the two");
  }
  return cloud;
}

}  // namespace perimode
