// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "perimode/assembly/body.hpp"
#include "perimode/linalg/operator.hpp"

namespace perimode {

/// Rigid motions the supports, walls and periods of a body leave free, piece by piece: all combinations of
/// a piece's translations and linearised rotations with K q = 0 on the free dofs. Columns are M-orthonormal,
/// shape (free dofs x rigid modes); periodic bodies give their 1 to 3 translations. `stiffness` is R K T.
/// Free is what |D^-1 K q| <= 1e-9 |q| holds for, D the stiffness of every particle's own bonds.
/// Cost: 1, 3 or 6 products. docs/theory/04_modal.md.
template <int Dim>
[[nodiscard]] Eigen::MatrixXd rigid_modes(const Body<Dim>& body, const LinearOperator& stiffness,
                                          const Eigen::VectorXd& mass);

}  // namespace perimode
