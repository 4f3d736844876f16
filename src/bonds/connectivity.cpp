// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/bonds/connectivity.hpp"

#include <numeric>

namespace perimode {

template <int Dim>
Pieces find_pieces(const Bonds<Dim>& bonds, Index particles) {
  std::vector<Index> parent(particles);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](Index i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  Pieces pieces;
  for (Index i = 0; i < particles; ++i) {
    bool bonded = false;
    for_each_bond(bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
      bonded = true;
      const Index a = root(i);
      const Index b = root(owner(bonds, end.neighbour, particles));
      if (a != b) parent[std::max(a, b)] = std::min(a, b);  // the root is a piece's first particle
    });
    if (!bonded) ++pieces.isolated;
  }
  pieces.of.assign(particles, -1);
  for (Index i = 0; i < particles; ++i) {
    const Index r = root(i);
    pieces.of[i] = r == i ? pieces.count++ : pieces.of[r];
  }
  return pieces;
}

template Pieces find_pieces<1>(const Bonds<1>&, Index);
template Pieces find_pieces<2>(const Bonds<2>&, Index);
template Pieces find_pieces<3>(const Bonds<3>&, Index);

}  // namespace perimode
