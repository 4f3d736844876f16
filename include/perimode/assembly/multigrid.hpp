// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "perimode/assembly/body.hpp"
#include "perimode/linalg/operator.hpp"

namespace perimode {

/// The same body on a grid of twice the spacing, for the coarse levels of multigrid (docs/theory): a coarse
/// particle stands for the up to 2^Dim particles in its cell; it has the family's offsets, a coarse bond
/// is alive where at least half of the pairs of successive fine bonds it stands for are; its calibration
/// factor gives its family the dilation energy of its children. A coarse dof is fixed where a child's is.
/// @pre a grid. Cost O(bond ends).
template <int Dim>
[[nodiscard]] Body<Dim> coarsen(const Body<Dim>& body);

struct MultigridOptions {
  int smoothing = 2;           ///< degree of the Chebyshev smoother before and after
  Index coarsest_dofs = 3000;  ///< factored directly at or below this
};

struct Multigrid {
  LinearOperator preconditioner;  ///< one symmetric V-cycle over the free dofs
  std::vector<Index> dofs;        ///< free dofs of each level, finest first
  double bytes = 0.0;             ///< taken by all levels
  double seconds = 0.0;           ///< to set up
};

/// A V-cycle for R K T of a body on a grid: bilinear transfer, Chebyshev smoothing of block Jacobi,
/// a Cholesky factor on the coarsest grid. Symmetric positive definite, so fit for conjugate gradients.
/// `body` and `stiffness` (its operator) have to outlive it.
/// Throws invalid_input for clouds.
template <int Dim>
[[nodiscard]] Multigrid multigrid(const Body<Dim>& body, const LinearOperator& stiffness,
                                  const MultigridOptions& options = {});

}  // namespace perimode
