// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "perimode/linalg/sparse.hpp"

namespace perimode {

[[nodiscard]] SparseColumns no_columns(Index rows);
void append(const SparseColumns& from, SparseColumns& to);

/// Where c c^T of every column meets the entries of A: per pair of rows, those with a zero left out. Throws
/// invalid_input where A has no such entry.
[[nodiscard]] std::vector<Offset> places_of_products(const SparseColumns& columns, const Csr& a);

/// A += sign c c^T, column by column, at these places.
void add_products(const SparseColumns& columns, double sign, const std::vector<Offset>& places, Csr& a);

}  // namespace perimode
