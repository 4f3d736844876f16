// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string_view>

#include "perimode/geometry/cloud.hpp"

namespace perimode {

/// Particles of a file, by its extension: .csv (read_cloud), .msh (Gmsh, ASCII, format 4.1 or 2.2) or .exo
/// (Exodus). Of a mesh every element of the body's dimension becomes a particle, in the order of the file: 3D
/// tetrahedra and hexahedra, 2D triangles and quadrilaterals, of straight edges. Its position is the
/// centroid, its volume the element's volume, in 2D the area times `section` (the thickness, m). Blocks are
/// named after the physical group (without a name: physical_<number>; without a group: none) or the element
/// block (block_<id>). Elements of lower dimension are passed over.
/// Throws invalid_input, naming file, line where there is one, and element: another extension or format, a
/// binary .msh, elements of other shapes or of higher order, an element that is inverted or without volume,
/// nodes that are not there, two elements with one centroid, no element. Cost O(n log n).
[[nodiscard]] CloudData read_particles(const std::filesystem::path& file, int dimension, double section);

/// The same of a Gmsh mesh at hand; errors name it `file`.
[[nodiscard]] CloudData read_msh_text(std::string_view text, const std::filesystem::path& file, int dimension,
                                      double section);

}  // namespace perimode
