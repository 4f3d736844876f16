// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "perimode/io/table.hpp"
#include "studies/common/results.hpp"

namespace perimode::studies {

inline constexpr double cloud_pulse_width = 0.1;  // m

/// The pulse of width 0.1 in a bar of the file's tetrahedra, each a particle with a horizon that holds its 30
/// nearest: adds, under the body "tetrahedra" and at = `level` of splitting, particles, radius_ratio, peak
/// (top of a parabola fitted by volume to the displacements within half a width of the highest slice, when a
/// classical wave has gone 0.7), height of that top, and scatter, the root mean square of displacements about
/// their means in slices. Rows (curve, time, x, u) of these means go to `profiles`.
void add_cloud(const std::filesystem::path& file, int level, Results& results, Table& profiles);

}  // namespace perimode::studies
