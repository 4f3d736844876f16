// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "perimode/assembly/body.hpp"
#include "perimode/linalg/operator.hpp"

namespace perimode {

/// The same body on a grid of twice the spacing, for the coarse levels of multigrid
/// (docs/theory/08_iterative.md): ceil(n/2) cells per axis from the same corner, a particle where one of the
/// up to 2^Dim children is, in the block of most of them. The family keeps its offsets; c is scaled by
/// 2^(-1-Dim), so that k_b = c beta V^2 / |xi| grows by 2^(Dim-2) and elastic moduli stay (micromoduli with
/// negative parts are replaced by a constant of the same energy of dilation, so that coarse levels are
/// definite). A coarse bond is alive where at least half of the chains of two fine bonds it stands for are;
/// the calibration factor, within [1/5, 5], gives a family the mean dilation energy of its children's. A dof
/// is fixed where a child's is; ghosts are reflected as the fine ones. Throws invalid_input for clouds. Cost
/// O(bond ends).
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

/// A V-cycle for R K T of a body on a grid: linear interpolation per axis and its transpose, Chebyshev
/// smoothing of block Jacobi, a Cholesky factor of the coarsest grid. Symmetric positive definite for every
/// symmetric R K T, so fit for conjugate gradients. Bodies are coarsened while every axis has four cells; a
/// coarsest level of more than 200 000 dofs is smoothed only. A singular coarsest matrix (rigid motions) is
/// shifted by 1e-8 of its norm: b without a part in the null space is solved for, the rigid part of x is
/// arbitrary. `body` and `stiffness` (its operator) have to outlive it. Throws invalid_input for clouds.
/// Cost: 2 smoothing products per level and cycle; levels together hold 1 / (2^Dim - 1) of the finest, and
/// three vectors and the block inverses beside the finest.
template <int Dim>
[[nodiscard]] Multigrid multigrid(const Body<Dim>& body, const LinearOperator& stiffness,
                                  const MultigridOptions& options = {});

}  // namespace perimode
