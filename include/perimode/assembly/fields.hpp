// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "perimode/assembly/body.hpp"

namespace perimode {

// Fields of a body for given displacements of all particle dofs (m, point-major). Every particle sums over
// its own bonds in slot order, ghosts follow by the boundary's map, so the bits do not depend on the number
// of threads. Cost O(bond ends) each. docs/theory/09_static.md.

/// Symmetric tensors per particle in Voigt order without factors of 2: 1D xx; 2D xx, yy, xy;
/// 3D xx, yy, zz, xy, xz, yz.
template <int Dim>
constexpr int tensor_components = Dim * (Dim + 1) / 2;

/// Strain per particle: the symmetric part of the gradient H that fits its alive bonds best,
///   min_H sum_b w_b |eta - H xi|^2,  w_b = beta V_j, eta = u_j - u_i.
/// Exact for uniform H at complete and incomplete families alike. Where the bonds of a particle do not span
/// space, components outside their span are zero. Shape (components, particles).
template <int Dim>
[[nodiscard]] Eigen::MatrixXd strain(const Body<Dim>& body, const Eigen::VectorXd& displacement);

/// Stress per particle that its alive bonds carry, Pa:
///   sigma = 1/(2 V_i) sum_b f_b (n (x) xi),  f_b = k_b n . eta the bond's force.
/// Uniform strain in the bulk gives the lattice's own Hooke's law; near a free face, where half the family is
/// missing, less than the true stress. Shape (components, particles).
template <int Dim>
[[nodiscard]] Eigen::MatrixXd stress(const Body<Dim>& body, const Eigen::VectorXd& displacement);

/// Damage per particle: 1 - (weight of alive bonds) / (weight of all bonds present), weight beta V_j;
/// bonds cut by pre-cracks count as broken. 0 for a particle without bonds.
template <int Dim>
[[nodiscard]] Eigen::VectorXd damage(const Body<Dim>& body);

/// Strain energy density per particle, J/m3: half of each bond's energy / V_i. A bond to a ghost of mirror or
/// antimirror walls is one half of a pair of images, so half of its energy counts too; one to a ghost of
/// another wall counts u_i . (its force on i) / 2, as in bond_energy. The sum of density times volume is
/// bond_energy.
template <int Dim>
[[nodiscard]] Eigen::VectorXd energy_density(const Body<Dim>& body, const Eigen::VectorXd& displacement);

}  // namespace perimode
