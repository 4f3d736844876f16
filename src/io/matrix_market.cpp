// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/io/matrix_market.hpp"

#include <fmt/compile.h>

#include <iterator>

#include "io/output_file.hpp"

namespace perimode {

namespace {

void append_header(fmt::memory_buffer& out, const char* symmetry, Offset rows, Offset cols, Offset entries) {
  fmt::format_to(std::back_inserter(out), "%%MatrixMarket matrix coordinate real {}\n{} {} {}\n", symmetry,
                 rows, cols, entries);
}

/// The shortest decimals (at most 17) that read back to the same bits.
void append_entry(fmt::memory_buffer& out, Index row, Index column, double value) {
  fmt::format_to(std::back_inserter(out), FMT_COMPILE("{} {} {}\n"), row + 1, column + 1, value);
}

/// Columns ascend, so the lower triangle of a row is its beginning.
Offset row_end(const Csr& matrix, Index row, MatrixSymmetry symmetry) {
  Offset end = matrix.row_start[row + 1];
  if (symmetry == MatrixSymmetry::symmetric) {
    while (end > matrix.row_start[row] && matrix.column[end - 1] > row) --end;
  }
  return end;
}

}  // namespace

void write_matrix_market(const std::filesystem::path& file, const Csr& matrix, MatrixSymmetry symmetry) {
  OutputFile output(file);
  Offset entries = 0;
  for (Index i = 0; i < matrix.rows; ++i) entries += row_end(matrix, i, symmetry) - matrix.row_start[i];
  append_header(output.buffer(), symmetry == MatrixSymmetry::symmetric ? "symmetric" : "general", matrix.rows,
                matrix.cols, entries);
  for (Index i = 0; i < matrix.rows; ++i) {
    const Offset end = row_end(matrix, i, symmetry);
    for (Offset e = matrix.row_start[i]; e < end; ++e) {
      append_entry(output.buffer(), i, matrix.column[e], matrix.value[e]);
    }
    output.flush_if_full();
  }
  output.close();
}

void write_matrix_market(const std::filesystem::path& file, std::span<const double> diagonal) {
  OutputFile output(file);
  const auto n = static_cast<Index>(diagonal.size());
  append_header(output.buffer(), "symmetric", n, n, n);
  for (Index i = 0; i < n; ++i) {
    append_entry(output.buffer(), i, i, diagonal[i]);
    output.flush_if_full();
  }
  output.close();
}

}  // namespace perimode
