// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "perimode/assembly/body.hpp"
#include "perimode/linalg/operator.hpp"
#include "perimode/linalg/row_product.hpp"

namespace perimode {

/// The three forms of K. stencil: nothing is stored but the body's own alive bits (grids). bonds: one vector
/// sqrt|k_b| n per bond end (any body). blocks: blocked compressed rows (any body). automatic: stencil on
/// grids, bonds on clouds.
enum class StiffnessForm { automatic, stencil, bonds, blocks };

/// R K T over the free dofs (boundary_map.hpp) in one of its forms; all agree to round-off:
///   (K u)_i = sum_b k_b n (n . (u_i - u_j)),  docs/theory/01_bond.md.
/// The stencil reads the body's bonds at every product, so the body has to outlive the operator. Where bonds
/// break, BreakableStiffness (breakable_stiffness.hpp) is K that follows. Throws invalid_input for the
/// stencil of a cloud. Memory: operator_bytes.
template <int Dim>
[[nodiscard]] LinearOperator stiffness_operator(const Body<Dim>& body,
                                                StiffnessForm form = StiffnessForm::automatic);

/// The same product handed out piece by piece (row_product.hpp), to the last bit. The stencil hands rows out
/// as they are summed and leaves x to `take`; so does the bond form where there are supports or walls.
template <int Dim>
[[nodiscard]] RowProduct stiffness_rows(const Body<Dim>& body, StiffnessForm form = StiffnessForm::automatic);

/// Bytes that stiffness_operator takes besides the body.
template <int Dim>
[[nodiscard]] double operator_bytes(const Body<Dim>& body, StiffnessForm form = StiffnessForm::automatic);

/// K u over all particle dofs (N; point-major), fixed ones included, for displacements u of all particle dofs
/// (m); ghosts follow by the affine map of the boundary with its given values. The force the bonds ask of
/// whatever holds a particle in place: K u = f in equilibrium. Bond by bond, in slot order. Cost O(bond
/// ends).
template <int Dim>
[[nodiscard]] Eigen::VectorXd internal_force(const Body<Dim>& body, const Eigen::VectorXd& displacement);

/// The same with another boundary map of the body in place of its own (with_only, at_time).
template <int Dim>
[[nodiscard]] Eigen::VectorXd internal_force(const Body<Dim>& body, const BoundaryMap<Dim>& boundary,
                                             const Eigen::VectorXd& displacement);

/// Dim x Dim diagonal blocks (row-major) of R K T for every particle, ghosts that follow the particle itself
/// included. Cost O(bond ends).
template <int Dim>
[[nodiscard]] std::vector<double> diagonal_blocks(const Body<Dim>& body);

/// diagonal_blocks with |k_b| in place of k_b, D: x^T K x <= 2 x^T D x whatever the signs of the bonds, so D
/// is what smoothers and preconditioners scale by. The same numbers where no k_b is negative.
template <int Dim>
[[nodiscard]] std::vector<double> absolute_blocks(const Body<Dim>& body);

/// Largest absolute row sum of R K T over free rows and columns, N/m: bounds |lambda| of K (Gershgorin).
/// Equals norm_inf of the assembled matrix to round-off where every free row meets a column at most once, and
/// bounds it from above otherwise. Cost O(bond ends).
template <int Dim>
[[nodiscard]] double stiffness_bound(const Body<Dim>& body);

}  // namespace perimode
