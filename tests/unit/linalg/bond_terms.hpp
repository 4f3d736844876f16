// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "perimode/assembly/assemble.hpp"
#include "perimode/assembly/body.hpp"
#include "perimode/linalg/sparse.hpp"

namespace perimode::test {

inline void append(SparseColumns& columns, std::vector<std::pair<Index, double>> entries) {
  std::sort(entries.begin(), entries.end());
  for (const auto& [row, value] : entries) {
    columns.row.push_back(row);
    columns.value.push_back(value);
  }
  columns.start.push_back(static_cast<Offset>(columns.row.size()));
}

inline SparseColumns no_columns(Index rows) {
  SparseColumns out;
  out.rows = rows;
  return out;
}

/// Some of the columns, in the given order.
inline SparseColumns chosen(const SparseColumns& from, const std::vector<Index>& which) {
  SparseColumns out = no_columns(from.rows);
  for (const Index c : which) {
    std::vector<std::pair<Index, double>> entries;
    for (Offset e = from.start[c]; e < from.start[c + 1]; ++e)
      entries.emplace_back(from.row[e], from.value[e]);
    append(out, std::move(entries));
  }
  return out;
}

/// A += sign c c^T for every column, entry by entry where A has them.
inline void add_products(Csr& a, const SparseColumns& columns, double sign) {
  for (Index c = 0; c < columns.count(); ++c)
    for (Offset i = columns.start[c]; i < columns.start[c + 1]; ++i)
      for (Offset j = columns.start[c]; j < columns.start[c + 1]; ++j) {
        const auto first = a.column.begin() + a.row_start[columns.row[i]];
        const auto last = a.column.begin() + a.row_start[columns.row[i] + 1];
        const auto at = std::lower_bound(first, last, columns.row[j]);
        if (at == last || *at != columns.row[j]) throw std::logic_error("outside the pattern");
        a.value[at - a.column.begin()] += sign * columns.value[i] * columns.value[j];
      }
}

/// The rank-one terms of all bonds between particles of a body without walls: sqrt(k_b) [n; -n], free dofs
/// only. `which` (may be null) picks bonds by their two ends.
template <int Dim, class Pick>
SparseColumns bond_terms(const Body<Dim>& body, Pick&& pick) {
  SparseColumns out = no_columns(body.boundary.free);
  for (Index i = 0; i < body.count(); ++i)
    for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
      if (end.neighbour <= i || !pick(i, end.neighbour)) return;
      const Point<Dim> c = std::sqrt(bond_stiffness(body, i, end)) / end.length * end.xi;
      std::vector<std::pair<Index, double>> entries;
      for (int a = 0; a < Dim; ++a) {
        const Index here = body.boundary.free_number[static_cast<std::size_t>(i) * Dim + a];
        const Index there = body.boundary.free_number[static_cast<std::size_t>(end.neighbour) * Dim + a];
        if (here >= 0) entries.emplace_back(here, c[a]);
        if (there >= 0) entries.emplace_back(there, -c[a]);
      }
      if (!entries.empty()) append(out, std::move(entries));
    });
  return out;
}

}  // namespace perimode::test
