// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "perimode/core/types.hpp"

namespace perimode {

/// The inverse of a block-diagonal matrix over the kept dofs of nodes, symmetric positive definite. Runs of
/// nodes with equal blocks (all but the surface of a uniform lattice) share one, so that it costs next to no
/// memory traffic. Nodes without a kept dof are left out.
struct BlockInverse {
  int block = 1;
  std::vector<Index> which;     ///< per node: number of its inverse
  std::vector<Index> start;     ///< first dof of each node, nodes + 1; empty: `block` dofs each
  std::vector<double> inverse;  ///< block x block each; of a node with n < block dofs, n x n of them

  [[nodiscard]] Index nodes() const { return static_cast<Index>(which.size()); }
  [[nodiscard]] Index first_dof(Index node) const { return start.empty() ? node * block : start[node]; }
  [[nodiscard]] Index size() const { return first_dof(nodes()); }
  [[nodiscard]] double bytes() const;
};

/// See block_jacobi. Throws invalid_input for shapes that do not belong together.
[[nodiscard]] BlockInverse invert_blocks(const std::vector<double>& blocks, int block,
                                         std::span<const Index> dof_number);

/// y = D^-1 x
void apply(const BlockInverse& inverse, const double* x, double* y);

/// One step of a Chebyshev iteration from the product q = A x, in one pass:
///   d = momentum d + gain D^-1 (b - q),  x += d.
void chebyshev_step(const BlockInverse& inverse, double momentum, double gain, const double* b,
                    const double* q, double* d, double* x);

/// The first step from x = 0: d = x = gain D^-1 b.
void chebyshev_start(const BlockInverse& inverse, double gain, const double* b, double* d, double* x);

}  // namespace perimode
