// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "perimode/assembly/model.hpp"
#include "perimode/dispersion/medium.hpp"
#include "perimode/dispersion/symbol.hpp"

namespace perimode {

/// The endless lattice that the particles of a grid form far from any surface.
template <int Dim>
struct Lattice {
  Medium medium;
  Family<Dim> family;
  std::vector<double> rates;  ///< bond_rates: bond stiffness over particle mass, 1/s2; equal in an orbit
};

/// The lattice of a model's `material` (blocks, holes, pre-cracks and boundaries left aside), calibrated as
/// the model says: with complete families `discrete` and `discrete_cut` are the same. Throws invalid_input,
/// pointing at the place in the case: a cloud, a dimension that is not Dim, or what build_body refuses of
/// grid, section, horizon and material (require_lattice_kernel_fits). Cost O((2 delta/spacing + 2)^Dim).
template <int Dim>
[[nodiscard]] Lattice<Dim> make_lattice(const Model& model);

}  // namespace perimode
