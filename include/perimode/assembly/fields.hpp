// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "perimode/assembly/body.hpp"

namespace perimode {

/// Symmetric tensors per particle in Voigt order without factors of 2: 1D xx; 2D xx, yy, xy;
/// 3D xx, yy, zz, xy, xz, yz.
template <int Dim>
constexpr int tensor_components = Dim * (Dim + 1) / 2;

/// Strain per particle: the symmetric part of the gradient H that fits its alive bonds best,
///   min_H sum_b w_b |eta - H xi|^2,  w_b = beta V_j, eta = u_j - u_i.
/// Exact for uniform H at complete and incomplete families alike. Particles whose bonds do not span the space
/// get zero in what is undetermined. Shape (components, particles). `displacement`: all particle dofs, m.
template <int Dim>
[[nodiscard]] Eigen::MatrixXd strain(const Body<Dim>& body, const Eigen::VectorXd& displacement);

/// Stress per particle that its alive bonds carry, Pa:
///   sigma = 1/(2 V_i) sum_b f_b (n (x) xi),  f_b = k_b n . eta the bond's force.
/// Uniform strain in the bulk gives the lattice's own Hooke's law; near a free face, where half the family is
/// missing, less than the true stress (docs/theory). Shape (components, particles).
template <int Dim>
[[nodiscard]] Eigen::MatrixXd stress(const Body<Dim>& body, const Eigen::VectorXd& displacement);

/// Damage per particle: 1 - (weight of alive bonds) / (weight of all bonds present), weight beta V_j;
/// bonds cut by pre-cracks count as broken. 0 for a particle without bonds.
template <int Dim>
[[nodiscard]] Eigen::VectorXd damage(const Body<Dim>& body);

/// Strain energy density per particle, J/m3: half of each bond's energy / V_i; the energy of a bond to a
/// ghost counts as in bond_energy, so that the sum over particles times volumes is the strain energy.
template <int Dim>
[[nodiscard]] Eigen::VectorXd energy_density(const Body<Dim>& body, const Eigen::VectorXd& displacement);

}  // namespace perimode
