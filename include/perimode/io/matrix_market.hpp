// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <span>

#include "perimode/linalg/sparse.hpp"

namespace perimode {

enum class MatrixSymmetry { general, symmetric };

/// Writes a matrix in Matrix Market coordinate form, rows and columns from 1, row by row; every
/// value reads back to the same bits. symmetric: only the lower triangle is written, the
/// upper one is not looked at (square matrices). Cost O(nonzeros). Throws environment when it cannot be
/// written whole.
void write_matrix_market(const std::filesystem::path& file, const Csr& matrix, MatrixSymmetry symmetry);

/// The matrix diag(diagonal), symmetric, in the same form.
void write_matrix_market(const std::filesystem::path& file, std::span<const double> diagonal);

}  // namespace perimode
