// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

#include "node_graph.hpp"
#include "perimode/linalg/factor.hpp"

namespace perimode {
namespace {

/// Parts of at most this many nodes keep their order: their fill hardly depends on it.
constexpr std::size_t leaf_nodes = 32;
/// No half of a cut holds more of the nodes of its part than this.
constexpr double largest_half = 0.6;
/// Planes tried across a part. Layers of a grid fall into bins of their own.
constexpr std::size_t most_bins = 512;

/// Orders the nodes in place, part by part: [first half | second half | separator], the halves likewise.
class Dissection {
 public:
  Dissection(const NodeGraph& graph, Eigen::MatrixXd position)
      : graph_(graph),
        position_(std::move(position)),
        part_(graph.nodes(), 0),
        bin_(graph.nodes()),
        lowest_(graph.nodes()),
        highest_(graph.nodes()) {}

  void dissect(std::span<int> nodes) {
    if (nodes.size() <= leaf_nodes) return;
    ++parts_;
    for (const int k : nodes) part_[k] = parts_;

    Eigen::VectorXd lower = position_.col(nodes[0]), upper = lower;
    for (const int k : nodes) {
      lower = lower.cwiseMin(position_.col(k));
      upper = upper.cwiseMax(position_.col(k));
    }
    Eigen::VectorXd extent = upper - lower;
    Cut cut;
    while (!cut.found()) {  // across the longest side that can be cut
      int axis = 0;
      if (!(extent.maxCoeff(&axis) > 0.0)) return;
      cut = cut_across(nodes, axis, lower[axis], extent[axis]);
      extent[axis] = 0.0;
    }

    const auto separates = [&](int k) {
      return cut.of_first ? bin_[k] < cut.plane && highest_[k] >= cut.plane
                          : bin_[k] >= cut.plane && lowest_[k] < cut.plane;
    };
    const auto end = std::stable_partition(nodes.begin(), nodes.end(), [&](int k) { return !separates(k); });
    const auto middle = std::stable_partition(nodes.begin(), end, [&](int k) { return bin_[k] < cut.plane; });
    dissect({nodes.begin(), middle});
    dissect({middle, end});
  }

 private:
  /// Nodes in bins below `plane` are the first half; the separator is those of one half with a
  /// neighbour in the other.
  struct Cut {
    int plane = 0;
    bool of_first = true;  ///< which half gives the separator
    double cost = std::numeric_limits<double>::infinity();
    [[nodiscard]] bool found() const { return std::isfinite(cost); }
  };

  /// Sorts the nodes of the current part into bins along an axis and notes how far their neighbours reach;
  /// from that the separators of all planes between bins are counted in one sweep. Takes the least, with a
  /// preference for even halves that decides between planes that cut nothing.
  Cut cut_across(std::span<const int> nodes, int axis, double lower, double extent) {
    const auto bins = static_cast<int>(std::min(most_bins, nodes.size()));
    const double scale = (1.0 - 1e-9) * bins / extent;
    for (const int k : nodes) bin_[k] = static_cast<int>(scale * (position_(axis, k) - lower));

    // Differences from plane to plane, then their sums.
    std::vector<int> below(bins + 2, 0);                         // nodes under the plane
    std::array<std::vector<int>, 2> separator = {below, below};  // of the second half, of the first
    for (const int k : nodes) {
      const int bin = bin_[k];
      int lowest = bin, highest = bin;
      for (int e = graph_.start[k]; e < graph_.start[k + 1]; ++e) {
        const int other = graph_.row[e];
        if (part_[other] != parts_) continue;
        lowest = std::min(lowest, bin_[other]);
        highest = std::max(highest, bin_[other]);
      }
      lowest_[k] = lowest;
      highest_[k] = highest;
      ++below[bin + 1];
      ++separator[0][lowest + 1];
      --separator[0][bin + 1];
      ++separator[1][bin + 1];
      --separator[1][highest + 1];
    }
    std::partial_sum(below.begin(), below.end(), below.begin());
    for (auto& count : separator) std::partial_sum(count.begin(), count.end(), count.begin());

    Cut best;
    const auto all = static_cast<double>(nodes.size());
    for (int plane = 1; plane < bins; ++plane)
      for (const bool of_first : {true, false}) {
        const int cut = separator[of_first ? 1 : 0][plane];
        const double first = below[plane] - (of_first ? cut : 0), second = all - cut - first;
        if (first <= 0.0 || second <= 0.0 || std::max(first, second) > largest_half * all) continue;
        const double cost = cut * (1.0 + std::abs(first - second) / all) + std::abs(first - second) * 1e-6;
        if (cost < best.cost) best = {plane, of_first, cost};
      }
    return best;
  }

  const NodeGraph& graph_;
  Eigen::MatrixXd position_;
  int parts_ = 0;
  std::vector<int> part_;              // the part a node was last seen in
  std::vector<int> bin_;               // its bin there,
  std::vector<int> lowest_, highest_;  // and the outermost of its neighbours' bins
};

}  // namespace

std::vector<Index> dissection_order(const Csr& pattern, std::span<const Index> node_of_dof,
                                    const Eigen::MatrixXd& position) {
  const NodeGraph graph = node_graph(pattern, node_of_dof, NodeGraphPart::whole);
  Eigen::MatrixXd of_node(position.rows(), graph.nodes());
  for (Index k = 0; k < graph.nodes(); ++k) {
    const Index dof = graph.first_dof[k];
    of_node.col(k) = position.col(node_of_dof.empty() ? dof : node_of_dof[dof]);
  }
  std::vector<int> nodes(graph.nodes());
  std::iota(nodes.begin(), nodes.end(), 0);
  Dissection(graph, std::move(of_node)).dissect(nodes);
  return dof_order(graph, nodes);
}

}  // namespace perimode
