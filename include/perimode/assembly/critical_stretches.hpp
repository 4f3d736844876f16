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

}  // namespace perimode
