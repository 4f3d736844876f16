// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "perimode/linalg/sparse.hpp"

namespace perimode {

/// The graph of the nodes: the pattern with the dofs of a node merged, compressed by nodes.
struct NodeGraph {
  std::vector<Index> first_dof;  ///< nodes + 1
  std::vector<int> start, row;   ///< neighbours of k: row[start[k] .. start[k+1]]

  [[nodiscard]] Index nodes() const { return static_cast<Index>(first_dof.size()) - 1; }
};

/// Neighbours up to the node itself (upper), or all of them (whole).
enum class NodeGraphPart { upper, whole };

/// Consecutive dofs with equal node_of_dof make a node (empty: each its own). Cost O(nonzeros).
[[nodiscard]] NodeGraph node_graph(const Csr& pattern, std::span<const Index> node_of_dof,
                                   NodeGraphPart part);

/// The order of the dofs that belongs to an order of the nodes.
[[nodiscard]] std::vector<Index> dof_order(const NodeGraph& graph, std::span<const int> node_order);

}  // namespace perimode
