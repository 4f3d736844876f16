// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "perimode/assembly/body.hpp"

namespace perimode {

/// Critical stretch of the bonds of every block: its material's own, or that of its fracture energy at the
/// horizon (critical_stretch.hpp; where the horizon varies, at the mean over the block's bonds); infinity
/// where the material has neither. Throws invalid_input: a critical stretch or fracture energy that is not
/// > 0. Cost O(bond ends) on a cloud.
template <int Dim>
[[nodiscard]] std::vector<double> critical_stretches(const Model& model, const Body<Dim>& body);

/// Horizon that a fracture energy of a block is taken at: that of a grid, on a cloud the mean over the
/// block's bond ends, m; 0 without bonds. Cost O(bond ends) on a cloud.
template <int Dim>
[[nodiscard]] double mean_horizon(const Body<Dim>& body, int block);

}  // namespace perimode
