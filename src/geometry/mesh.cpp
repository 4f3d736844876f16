// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/geometry/mesh.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "geometry/exodus_mesh.hpp"
#include "perimode/core/error.hpp"

namespace perimode {

CloudData read_particles(const std::filesystem::path& file, int dimension, double section) {
  const std::string extension = file.extension().string();
  if (extension == ".exo") return read_exodus_mesh(file, dimension, section);
  if (extension != ".msh") return read_cloud(file, dimension);
  std::error_code code;
  std::ifstream stream(file, std::ios::binary);
  if (!std::filesystem::is_regular_file(file, code) || !stream)
    invalid_input({"a readable Gmsh mesh", "none", "check the path", {file.string()}});
  std::ostringstream content;
  content << stream.rdbuf();
  return read_msh_text(std::move(content).str(), file, dimension, section);
}

}  // namespace perimode
