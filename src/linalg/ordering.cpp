// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstddef>
#include <numeric>

#include "cholmod_workspace.hpp"
#include "perimode/linalg/factor.hpp"

namespace perimode {
namespace {

/// The graph of the nodes: the pattern with the dofs of a node merged, upper triangle by columns.
struct NodeGraph {
  std::vector<Index> first_dof;  ///< nodes + 1
  std::vector<int> start, row;
};

NodeGraph node_graph(const Csr& pattern, std::span<const Index> node_of_dof) {
  NodeGraph graph;
  std::vector<Index> node(pattern.rows);
  for (Index i = 0; i < pattern.rows; ++i) {
    const bool fresh = i == 0 || node_of_dof.empty() || node_of_dof[i] != node_of_dof[i - 1];
    if (fresh) graph.first_dof.push_back(i);
    node[i] = static_cast<Index>(graph.first_dof.size()) - 1;
  }
  const auto nodes = static_cast<Index>(graph.first_dof.size());
  graph.first_dof.push_back(pattern.rows);

  graph.start.assign(1, 0);
  std::vector<Index> seen(nodes, -1);
  for (Index k = 0; k < nodes; ++k) {
    for (Index dof = graph.first_dof[k]; dof < graph.first_dof[k + 1]; ++dof)
      for (Offset e = pattern.row_start[dof]; e < pattern.row_start[dof + 1]; ++e) {
        const Index other = node[pattern.column[e]];
        if (other > k) break;  // columns ascend within a row
        if (seen[other] == k) continue;
        seen[other] = k;
        graph.row.push_back(other);
      }
    graph.start.push_back(static_cast<int>(graph.row.size()));
  }
  return graph;
}

}  // namespace

std::vector<Index> fill_reducing_order(const Csr& pattern, std::span<const Index> node_of_dof) {
  NodeGraph graph = node_graph(pattern, node_of_dof);
  const std::size_t nodes = graph.first_dof.size() - 1;
  CholmodWorkspace workspace;
  cholmod_sparse view = {};
  view.nrow = view.ncol = nodes;
  view.nzmax = graph.row.size();
  view.p = graph.start.data();
  view.i = graph.row.data();
  view.stype = 1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_PATTERN;
  view.packed = 1;
  std::vector<int> node_order(nodes);
  if (nodes > 1)
    workspace.check(cholmod_metis(&view, nullptr, 0, 1, node_order.data(), workspace.get()) != 0, "ordering");

  std::vector<Index> order;
  order.reserve(pattern.rows);
  for (const int k : node_order)
    for (Index dof = graph.first_dof[k]; dof < graph.first_dof[k + 1]; ++dof) order.push_back(dof);
  return order;
}

}  // namespace perimode
