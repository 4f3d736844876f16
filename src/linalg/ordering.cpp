// SPDX-License-Identifier: BSD-3-Clause
#include "cholmod_workspace.hpp"
#include "node_graph.hpp"
#include "perimode/linalg/factor.hpp"

namespace perimode {

std::vector<Index> fill_reducing_order(const Csr& pattern, std::span<const Index> node_of_dof) {
  NodeGraph graph = node_graph(pattern, node_of_dof, NodeGraphPart::upper);
  const Index nodes = graph.nodes();
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
  return dof_order(graph, node_order);
}

}  // namespace perimode
