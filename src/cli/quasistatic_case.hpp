// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "perimode/assembly/body.hpp"
#include "perimode/fracture/quasistatic.hpp"
#include "perimode/io/case.hpp"

namespace perimode::cli {

/// Options of a case's quasi-static run, with what the body says of it: critical stretches, the scale of
/// crack areas. Throws invalid_input: kinematics other than linear, pre-cracks that cut no bond, a Griffith
/// load of loads and given motion at once.
template <int Dim>
[[nodiscard]] QuasistaticOptions quasistatic_options(const Case& input, const Body<Dim>& body);

}  // namespace perimode::cli
