// SPDX-License-Identifier: BSD-3-Clause
#include "rank_kernels.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "vector_kernels.hpp"

namespace perimode {
namespace {

using Rows = double __attribute__((vector_size(row_chunk * sizeof(double))));

[[gnu::always_inline]] inline void load(Rows& to, const double* from) { std::memcpy(&to, from, sizeof to); }
[[gnu::always_inline]] inline void store(const Rows& from, double* to) {
  std::memcpy(to, &from, sizeof from);
}

/// What a column does to the rows below it, rank after rank: w_r -= p_r x, x += g_r w_r; then x *= scale.
struct Rotation {
  double p[most_ranks], g[most_ranks];
  double scale;
};

/// The rotations of `columns` columns on rows that follow them, `rows` a multiple of row_chunk. A chunk of
/// the ranks' rows stays in registers while the columns pass.
template <int... R>
[[gnu::always_inline]] inline void rotate_rows(const Rotation* rotation, std::ptrdiff_t columns, double* l,
                                               std::ptrdiff_t l_stride, double* w, std::ptrdiff_t w_stride,
                                               std::ptrdiff_t rows, std::integer_sequence<int, R...>) {
  for (std::ptrdiff_t i = 0; i < rows; i += row_chunk) {
    Rows held[sizeof...(R)];
    (load(held[R], w + R * w_stride + i), ...);
    for (std::ptrdiff_t j = 0; j < columns; ++j) {
      Rows x;
      load(x, l + j * l_stride + i);
      ((held[R] -= rotation[j].p[R] * x, x += rotation[j].g[R] * held[R]), ...);
      x *= rotation[j].scale;
      store(x, l + j * l_stride + i);
    }
    (store(held[R], w + R * w_stride + i), ...);
  }
}

/// The rotation of one column from its pivot l and the entries w_r of its row; returns the new pivot squared,
/// or 0 where a term leaves none. [gill1974], method C1: with d = l^2,
///   alpha' = alpha + sign w^2 / d, d' = d alpha' / alpha, g = sign w l / (d alpha').
[[gnu::always_inline]] inline double rotation_of(RankTerms& terms, double l, const double* w_row, int count,
                                                 Rotation& out) {
  double d = l * l;
  for (int r = 0; r < count; ++r) {
    const double w = w_row[r * panel_width];
    const double along = terms.sign[r] * w / d;
    const double alpha = terms.alpha[r] + along * w;
    if (!(alpha > 0.0)) return 0.0;
    out.p[r] = w / l;
    out.g[r] = along * l / alpha;
    d *= alpha / terms.alpha[r];
    terms.alpha[r] = alpha;
  }
  return d;
}

template <int Count>
[[gnu::always_inline]] inline std::ptrdiff_t rotate(RankTerms& terms, double* l, std::ptrdiff_t rows,
                                                    std::ptrdiff_t columns, const double* least) {
  constexpr auto ranks = std::make_integer_sequence<int, Count>{};
  Rotation rotation[panel_width];
  alignas(64) double block[panel_width * panel_width], block_w[Count * panel_width];
  for (std::ptrdiff_t first = 0; first < columns; first += panel_width) {
    const std::ptrdiff_t width = std::min(panel_width, columns - first);
    double* panel = l + first * rows + first;
    double* w = terms.w + first;
    std::fill(block, block + panel_width * panel_width, 0.0);
    std::fill(block_w, block_w + Count * panel_width, 0.0);
    for (int r = 0; r < Count; ++r) std::copy_n(w + r * terms.stride, width, block_w + r * panel_width);
    for (std::ptrdiff_t j = 0; j < width; ++j)
      std::copy(panel + j * rows + j, panel + j * rows + width, block + j * panel_width + j);
    for (std::ptrdiff_t j = 0; j < width; ++j) {
      const double pivot = block[j * panel_width + j];
      const double d = rotation_of(terms, pivot, block_w + j, Count, rotation[j]);
      if (!(d > least[first + j])) return first + j;
      const double root = std::sqrt(d);
      rotation[j].scale = root / pivot;
      const std::ptrdiff_t begin = j / row_chunk * row_chunk;  // what becomes of the rows above j is not used
      const std::ptrdiff_t end = (width + row_chunk - 1) / row_chunk * row_chunk;
      rotate_rows(rotation + j, 1, block + j * panel_width + begin, panel_width, block_w + begin, panel_width,
                  end - begin, ranks);
      block[j * panel_width + j] = root;
    }
    for (std::ptrdiff_t j = 0; j < width; ++j)
      std::copy(block + j * panel_width + j, block + j * panel_width + width, panel + j * rows + j);

    const std::ptrdiff_t below = rows - first - width, whole = below / row_chunk * row_chunk;
    rotate_rows(rotation, width, panel + width, rows, w + width, terms.stride, whole, ranks);
    if (const std::ptrdiff_t rest = below - whole; rest > 0) {
      double* at = panel + width + whole;
      std::fill(block, block + panel_width * row_chunk, 0.0);
      for (std::ptrdiff_t j = 0; j < width; ++j) std::copy_n(at + j * rows, rest, block + j * row_chunk);
      rotate_rows(rotation, width, block, row_chunk, w + width + whole, terms.stride, row_chunk, ranks);
      for (std::ptrdiff_t j = 0; j < width; ++j) std::copy_n(block + j * row_chunk, rest, at + j * rows);
    }
  }
  return columns;
}

PERIMODE_EVERY_PROCESSOR std::ptrdiff_t rotate_1(RankTerms& terms, double* l, std::ptrdiff_t rows,
                                                 std::ptrdiff_t columns, const double* least) {
  return rotate<1>(terms, l, rows, columns, least);
}
PERIMODE_EVERY_PROCESSOR std::ptrdiff_t rotate_2(RankTerms& terms, double* l, std::ptrdiff_t rows,
                                                 std::ptrdiff_t columns, const double* least) {
  return rotate<2>(terms, l, rows, columns, least);
}
PERIMODE_EVERY_PROCESSOR std::ptrdiff_t rotate_4(RankTerms& terms, double* l, std::ptrdiff_t rows,
                                                 std::ptrdiff_t columns, const double* least) {
  return rotate<4>(terms, l, rows, columns, least);
}
PERIMODE_EVERY_PROCESSOR std::ptrdiff_t rotate_8(RankTerms& terms, double* l, std::ptrdiff_t rows,
                                                 std::ptrdiff_t columns, const double* least) {
  return rotate<8>(terms, l, rows, columns, least);
}

}  // namespace

std::ptrdiff_t rotate_supernode(RankTerms& terms, double* l, std::ptrdiff_t rows, std::ptrdiff_t columns,
                                const double* least) {
  switch (terms.count) {
    case 1:
      return rotate_1(terms, l, rows, columns, least);
    case 2:
      return rotate_2(terms, l, rows, columns, least);
    case 4:
      return rotate_4(terms, l, rows, columns, least);
    default:
      return rotate_8(terms, l, rows, columns, least);
  }
}

}  // namespace perimode
