// SPDX-License-Identifier: BSD-3-Clause
#include "node_graph.hpp"

namespace perimode {

NodeGraph node_graph(const Csr& pattern, std::span<const Index> node_of_dof, NodeGraphPart part) {
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
    const Index last = part == NodeGraphPart::upper ? k : nodes;
    for (Index dof = graph.first_dof[k]; dof < graph.first_dof[k + 1]; ++dof)
      for (Offset e = pattern.row_start[dof]; e < pattern.row_start[dof + 1]; ++e) {
        const Index other = node[pattern.column[e]];
        if (other > last) break;  // columns ascend within a row
        if (seen[other] == k) continue;
        seen[other] = k;
        graph.row.push_back(other);
      }
    graph.start.push_back(static_cast<int>(graph.row.size()));
  }
  return graph;
}

std::vector<Index> dof_order(const NodeGraph& graph, std::span<const int> node_order) {
  std::vector<Index> order;
  order.reserve(graph.first_dof.back());
  for (const int k : node_order)
    for (Index dof = graph.first_dof[k]; dof < graph.first_dof[k + 1]; ++dof) order.push_back(dof);
  return order;
}

}  // namespace perimode
