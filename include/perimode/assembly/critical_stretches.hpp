// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "perimode/assembly/body.hpp"

namespace perimode {

/// Critical stretch of the bonds of every block: its material's own, or that of its fracture energy at the
/// horizon (critical_stretch.hpp; where the horizon varies, at the mean over the block's bonds); infinity
/// where the material has neither. Throws invalid_input, at the material: a critical stretch or fracture
/// energy that is not > 0; a material that may break while some of its micromodulus is negative and
/// Material::break_negative is not set (a bond that breaks stretched takes its energy with it; if that is
/// negative the body gains energy [alebrahim2021] 7.2). Cost O(bond ends) on a cloud.
template <int Dim>
[[nodiscard]] std::vector<double> critical_stretches(const Model& model, const Body<Dim>& body);

/// Fracture energy of a material at a critical stretch, J/m2: of the continuum (fracture_energy) at the
/// block's horizon; shells: of the grid (lattice_fracture_energy). @pre a horizon > 0.
template <int Dim>
[[nodiscard]] double fracture_energy_at(const Material& material, const Body<Dim>& body, int block,
                                        double critical_stretch, const Continuum& continuum);

/// Whether bonds of negative micromodulus may break: some stretch is finite in a block that has such bonds.
template <int Dim>
[[nodiscard]] bool negative_bonds_may_break(const Body<Dim>& body, const std::vector<double>& stretches);

/// What a plan says of such bonds.
[[nodiscard]] std::string warning_of_negative_breaks();

/// Horizon that a fracture energy of a block is taken at: that of a grid, on a cloud the mean over the
/// block's bond ends, m; 0 without bonds. Cost O(bond ends) on a cloud.
template <int Dim>
[[nodiscard]] double mean_horizon(const Body<Dim>& body, int block);

}  // namespace perimode
