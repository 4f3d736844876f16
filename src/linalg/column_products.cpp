// SPDX-License-Identifier: BSD-3-Clause
#include "column_products.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "perimode/core/error.hpp"

namespace perimode {

void append(const SparseColumns& from, SparseColumns& to) {
  const Offset shift = to.start.back();
  for (std::size_t c = 1; c < from.start.size(); ++c) to.start.push_back(shift + from.start[c]);
  to.row.insert(to.row.end(), from.row.begin(), from.row.end());
  to.value.insert(to.value.end(), from.value.begin(), from.value.end());
}

SparseColumns no_columns(Index rows) {
  SparseColumns out;
  out.rows = rows;
  return out;
}

std::vector<Offset> places_of_products(const SparseColumns& columns, const Csr& a) {
  std::vector<Offset> out;
  for (Index c = 0; c < columns.count(); ++c)
    for (Offset i = columns.start[c]; i < columns.start[c + 1]; ++i) {
      const Index row = columns.row[i];
      const auto first = a.column.begin() + a.row_start[row], last = a.column.begin() + a.row_start[row + 1];
      for (Offset j = columns.start[c]; j < columns.start[c + 1]; ++j) {
        if (columns.value[i] == 0.0 || columns.value[j] == 0.0) continue;
        const auto at = std::lower_bound(first, last, columns.row[j]);
        if (at == last || *at != columns.row[j])
          invalid_input({"changes between dofs that share an entry of the matrix",
                         fmt::format("dofs {} and {}", row, columns.row[j]),
                         "make the solver with the widest pattern it will meet",
                         {}});
        out.push_back(at - a.column.begin());
      }
    }
  return out;
}

void add_products(const SparseColumns& columns, double sign, const std::vector<Offset>& places, Csr& a) {
  auto place = places.begin();
  for (Index c = 0; c < columns.count(); ++c)
    for (Offset i = columns.start[c]; i < columns.start[c + 1]; ++i)
      for (Offset j = columns.start[c]; j < columns.start[c + 1]; ++j)
        if (columns.value[i] != 0.0 && columns.value[j] != 0.0)
          a.value[*place++] += sign * columns.value[i] * columns.value[j];
}

}  // namespace perimode
