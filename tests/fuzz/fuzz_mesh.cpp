// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as a Gmsh mesh: they are read, or refused with invalid_input. What is read can be
// used: as many finite numbers as particles need, positive volumes.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "perimode/core/error.hpp"
#include "perimode/geometry/mesh.hpp"

namespace {

bool usable(const perimode::CloudData& cloud, int dimension) {
  const auto finite = [](double x) { return std::isfinite(x); };
  return cloud.dimension == dimension && cloud.count() > 0 &&
         cloud.position.size() == cloud.count() * static_cast<std::size_t>(dimension) &&
         (cloud.block.empty() || cloud.block.size() == cloud.count()) &&
         std::all_of(cloud.position.begin(), cloud.position.end(), finite) &&
         std::all_of(cloud.volume.begin(), cloud.volume.end(),
                     [&](double v) { return finite(v) && v > 0.0; });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  for (const int dimension : {2, 3}) {
    try {
      if (!usable(perimode::read_msh_text(text, "mesh.msh", dimension, 0.5), dimension)) std::abort();
    } catch (const perimode::Error& error) {
      if (error.kind() != perimode::ErrorKind::invalid_input) throw;
    }
  }
  return 0;
}
