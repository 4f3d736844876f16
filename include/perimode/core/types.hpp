// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>

namespace perimode {

/// Particle and column numbers. A body holds fewer than 2^31 particles (docs/adr/0001).
using Index = std::int32_t;
/// Counts and offsets of bonds and nonzeros.
using Offset = std::int64_t;

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// A position, displacement or direction in `Dim` dimensions (m where it is a length).
template <int Dim>
using Point = Eigen::Matrix<double, Dim, 1>;

}  // namespace perimode
