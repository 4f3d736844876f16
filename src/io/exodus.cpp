// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/io/exodus.hpp"

#include <exodusII.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <initializer_list>
#include <utility>

#include "io/exodus_fields.hpp"
#include "io/output_file.hpp"
#include "perimode/core/error.hpp"

namespace perimode {

namespace {

constexpr std::size_t usual_name = 32;  ///< readers of old expect no longer ones

/// The library takes names as char**, which it does not change.
std::vector<char*> pointers(std::vector<std::string>& names) {
  std::vector<char*> result;
  result.reserve(names.size());
  for (std::string& name : names) result.push_back(name.data());
  return result;
}

std::vector<std::string> cut(std::vector<std::string> texts, std::size_t longest) {
  for (std::string& text : texts) text = text.substr(0, longest);
  return texts;
}

/// Node numbers (from 1) of each block that is not empty.
struct SphereBlock {
  std::string name;
  std::vector<int> nodes;
};

std::vector<SphereBlock> sphere_blocks(const ExodusMesh& mesh) {
  std::vector<SphereBlock> blocks;
  blocks.reserve(mesh.block_names.size());
  for (const std::string& name : mesh.block_names) blocks.push_back({name.empty() ? "body" : name, {}});
  for (std::size_t i = 0; i < mesh.block.size(); ++i)
    blocks[mesh.block[i]].nodes.push_back(static_cast<int>(i) + 1);
  std::erase_if(blocks, [](const SphereBlock& block) { return block.nodes.empty(); });
  return blocks;
}

int name_length(std::initializer_list<const std::vector<std::string>*> lists) {
  std::size_t length = usual_name;
  for (const auto* names : lists) {
    for (const std::string& name : *names) length = std::max(length, name.size());
  }
  return static_cast<int>(std::min(length, longest_name));
}

}  // namespace

template <int Dim>
ExodusMesh exodus_mesh(const Particles<Dim>& particles) {
  ExodusMesh mesh;
  for (const Point<Dim>& point : particles.position) {
    mesh.x.push_back(point[0]);
    mesh.y.push_back(Dim > 1 ? point[Dim > 1 ? 1 : 0] : 0.0);
    mesh.z.push_back(Dim > 2 ? point[Dim - 1] : 0.0);
  }
  mesh.block = particles.block;
  mesh.block_names = particles.block_names;
  return mesh;
}

std::vector<std::vector<double>> three_components(std::span<const double> vectors, int dimension) {
  const std::size_t n = vectors.size() / dimension;
  std::vector<std::vector<double>> result(3, std::vector<double>(n, 0.0));
  for (std::size_t i = 0; i < n; ++i) {
    for (int a = 0; a < dimension; ++a) result[a][i] = vectors[i * dimension + a];
  }
  return result;
}

ExodusWriter::ExodusWriter(const std::filesystem::path& file, const ExodusMesh& mesh,
                           const std::vector<std::string>& global_names,
                           const std::vector<std::string>& nodal_names)
    : file_(file) {
  ex_opts(EX_DEFAULT);  // report errors by code, print nothing
  int word = sizeof(double);
  int stored = sizeof(double);
  id_ = ex_create(file.c_str(), EX_CLOBBER | EX_LARGE_MODEL, &word, &stored);
  if (id_ < 0) check(id_, "create");
  try {
    check(ex_set_option(id_, EX_OPT_MAX_NAME_LENGTH,
                        name_length({&mesh.block_names, &global_names, &nodal_names})),
          "set up");
    write_mesh(mesh);
    declare(EX_GLOBAL, global_names);
    declare(EX_NODAL, nodal_names);
  } catch (...) {
    (void)ex_close(id_);
    throw;
  }
}

ExodusWriter::ExodusWriter(const std::filesystem::path& file, int steps) : file_(file), steps_(steps) {
  ex_opts(EX_DEFAULT);
  int word = sizeof(double);
  int stored = 0;
  float library = 0.0F;
  id_ = ex_open(file.c_str(), EX_WRITE, &word, &stored, &library);
  if (id_ < 0) check(id_, "open");
  const std::int64_t there = ex_inquire_int(id_, EX_INQ_TIME);
  if (there >= steps) return;
  (void)ex_close(id_);
  invalid_input({fmt::format("{} steps, as the checkpoint says", steps),
                 fmt::format("{}", there),
                 "start anew with --force",
                 {file.string()}});
}

ExodusWriter::~ExodusWriter() {
  if (id_ >= 0) (void)ex_close(id_);
}

ExodusWriter::ExodusWriter(ExodusWriter&& other) noexcept
    : file_(std::move(other.file_)), id_(std::exchange(other.id_, -1)), steps_(other.steps_) {}

void ExodusWriter::check(int code, const char* what) const {
  if (code >= 0) return;
  throw Error(ErrorKind::environment, Complaint{fmt::format("to {} the Exodus file", what),
                                                fmt::format("error {}", code),
                                                "check the path, the free space and the permissions",
                                                {file_.string()}});
}

void ExodusWriter::write_mesh(const ExodusMesh& mesh) {
  const std::vector<SphereBlock> blocks = sphere_blocks(mesh);
  ex_init_params init = {};
  std::strncpy(init.title, mesh.title.c_str(), MAX_LINE_LENGTH);
  init.num_dim = 3;
  init.num_nodes = init.num_elem = static_cast<std::int64_t>(mesh.x.size());
  init.num_elem_blk = static_cast<std::int64_t>(blocks.size());
  check(ex_put_init_ext(id_, &init), "begin");

  std::vector<std::string> info = cut(mesh.info, MAX_LINE_LENGTH);
  if (!info.empty())
    check(ex_put_info(id_, static_cast<int>(info.size()), pointers(info).data()), "write information to");
  std::vector<std::string> axes = {"x", "y", "z"};
  check(ex_put_coord_names(id_, pointers(axes).data()), "write coordinates to");
  check(ex_put_coord(id_, mesh.x.data(), mesh.y.data(), mesh.z.data()), "write coordinates to");

  std::vector<std::string> names;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const auto id = static_cast<std::int64_t>(b) + 1;
    check(ex_put_block(id_, EX_ELEM_BLOCK, id, "SPHERE", static_cast<std::int64_t>(blocks[b].nodes.size()), 1,
                       0, 0, 0),
          "write blocks to");
    check(ex_put_conn(id_, EX_ELEM_BLOCK, id, blocks[b].nodes.data(), nullptr, nullptr), "write blocks to");
    names.push_back(blocks[b].name.substr(0, longest_name));
  }
  check(ex_put_names(id_, EX_ELEM_BLOCK, pointers(names).data()), "write blocks to");
}

void ExodusWriter::declare(int kind, const std::vector<std::string>& names) {
  if (names.empty()) return;
  std::vector<std::string> writable = cut(names, longest_name);
  const auto type = static_cast<ex_entity_type>(kind);
  const int count = static_cast<int>(names.size());
  check(ex_put_variable_param(id_, type, count), "declare variables in");
  check(ex_put_variable_names(id_, type, count, pointers(writable).data()), "declare variables in");
}

void ExodusWriter::write(const ExodusStep& step) {
  ++steps_;
  check(ex_put_time(id_, steps_, &step.time), "write a step to");
  if (!step.globals.empty()) {
    check(ex_put_var(id_, steps_, EX_GLOBAL, 1, 0, static_cast<std::int64_t>(step.globals.size()),
                     step.globals.data()),
          "write a step to");
  }
  for (std::size_t v = 0; v < step.nodal.size(); ++v) {
    check(ex_put_var(id_, steps_, EX_NODAL, static_cast<int>(v) + 1, 1,
                     static_cast<std::int64_t>(step.nodal[v].size()), step.nodal[v].data()),
          "write a step to");
  }
}

void ExodusWriter::sync() {
  check(ex_update(id_), "write");
  sync_file(file_);
}

void ExodusWriter::close() {
  if (id_ < 0) return;
  check(ex_close(std::exchange(id_, -1)), "finish");
}

template ExodusMesh exodus_mesh<1>(const Particles<1>&);
template ExodusMesh exodus_mesh<2>(const Particles<2>&);
template ExodusMesh exodus_mesh<3>(const Particles<3>&);

}  // namespace perimode
