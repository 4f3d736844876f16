// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "perimode/geometry/cloud.hpp"

namespace perimode {

/// read_particles of an Exodus mesh.
[[nodiscard]] CloudData read_exodus_mesh(const std::filesystem::path& file, int dimension, double section);

}  // namespace perimode
