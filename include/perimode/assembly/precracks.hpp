// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "perimode/assembly/model.hpp"
#include "perimode/geometry/crack.hpp"

namespace perimode {

/// The pre-cracks of a model, as given, none joined. Throws invalid_input: another number of corners than the
/// dimension asks for, no length, a polygon that is not plane.
template <int Dim>
[[nodiscard]] std::vector<Crack<Dim>> precracks(const Model& model);

}  // namespace perimode
