// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "perimode/assembly/body.hpp"
#include "perimode/linalg/sparse.hpp"

namespace perimode {

/// Pattern of the stiffness of a body over its particles: block row i holds i and every particle that
/// an alive bond of i meets, directly or through a ghost. Values are zero. Rows in parallel.
/// Cost O(bond ends), times log(family) for rows that meet ghosts or periodic images.
template <int Dim>
[[nodiscard]] BlockCsr stiffness_pattern(const Body<Dim>& body);

/// Values of R K T over all particle dofs (fixed ones not struck out), N/m: row i gets, for every alive
/// bond, k_b n n^T on its diagonal and -k_b n n^T diag(coefficient) in the column the partner follows.
/// Each row is summed in slot order by one thread, so the bits do not depend on the number of threads.
/// Symmetric, positive semi-definite and K * translation = 0 where no wall acts. docs/theory/01_bond.md.
/// @pre `matrix` is stiffness_pattern(body). Cost O(bond ends).
template <int Dim>
void fill_stiffness(const Body<Dim>& body, BlockCsr& matrix);

/// Pattern and values.
template <int Dim>
[[nodiscard]] BlockCsr assemble_stiffness(const Body<Dim>& body);

/// Lumped masses rho V of the free dofs, kg.
template <int Dim>
[[nodiscard]] Eigen::VectorXd lumped_mass(const Body<Dim>& body);

/// Particle of every free dof, ascending.
template <int Dim>
[[nodiscard]] std::vector<Index> particle_of_free_dof(const Body<Dim>& body);

/// Places of the particles, m (Dim x particles), for dissection_order.
template <int Dim>
[[nodiscard]] Eigen::MatrixXd particle_positions(const Body<Dim>& body);

/// Strain energies of displacements of all particle dofs (dofs x fields, m) summed bond by bond,
///   U = 1/2 sum_b k_b (n . (u_j - u_i))^2, J,
/// bonds to ghosts counted as u_i . (their force on i) / 2. All terms between particles are positive, so the
/// relative error stays near round-off where x^T K x loses digits. The same bits for any number of threads.
/// Cost O(bonds * fields).
template <int Dim>
[[nodiscard]] Eigen::VectorXd bond_energy(const Body<Dim>& body, const Eigen::MatrixXd& displacement);

}  // namespace perimode
