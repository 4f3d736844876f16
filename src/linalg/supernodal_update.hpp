// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cholmod.h>

#include <span>
#include <vector>

#include "perimode/linalg/factor.hpp"

namespace perimode {

/// The elimination tree of a supernodal factor: the parent of a supernode holds its first row below the
/// diagonal block. CHOLMOD numbers supernodes so that parents come after their children.
struct SupernodeTree {
  std::vector<int> node_of_column;  ///< supernode, per column of L
  std::vector<int> parent;          ///< per supernode; -1: a root
  std::vector<int> column_of_dof;   ///< inverse of the order of elimination
};
[[nodiscard]] SupernodeTree supernode_tree(const cholmod_factor& factor);

/// The supernodes on the paths from some columns of L to the roots, ascending. Cost O(supernodes).
[[nodiscard]] std::vector<int> paths_to_root(const SupernodeTree& tree, std::span<const int> columns);

/// CholeskyFactor::update. `diagonal` is that of the matrix in the order of its dofs; `work` is zero between
/// calls and grows to 8 numbers a row.
[[nodiscard]] UpdateResult supernodal_update(cholmod_factor& factor, const SupernodeTree& tree,
                                             const SparseColumns& added, const SparseColumns& removed,
                                             std::span<const double> diagonal, std::vector<double>& work);

}  // namespace perimode
