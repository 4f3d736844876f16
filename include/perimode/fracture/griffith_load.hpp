// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "perimode/assembly/body.hpp"
#include "perimode/fracture/griffith.hpp"
#include "perimode/fracture/quasistatic.hpp"

namespace perimode {

/// The Griffith load of a body as it is, under the loads of `options` (event control) or, where there are
/// none, its given motion: equilibrium at load factor 1 with the bonds that cross `increment` and without
/// them. Throws as run_quasistatic before its first solution, and invalid_input: dead loads, or given motion
/// beside loads (energies are then no squares of the load factor), an increment that cuts nothing, one that
/// is not solved or releases no energy. Cost: a copy of the body, a factor, two solutions.
template <int Dim>
[[nodiscard]] GriffithLoad griffith_load(const Body<Dim>& body, const QuasistaticOptions& options,
                                         const Crack<Dim>& increment, double fracture_energy);

}  // namespace perimode
