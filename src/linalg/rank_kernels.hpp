// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace perimode {

constexpr int most_ranks = 8;               // that go through a supernode together
constexpr std::ptrdiff_t panel_width = 16;  // columns whose rotations are found before the rows below follow
constexpr std::ptrdiff_t row_chunk = 8;     // rows at a time

/// Rank-one terms sum_r (sign_r / alpha_r) w_r w_r^T on their way through the columns of L.
struct RankTerms {
  int count = 0;  ///< 1, 2, 4 or 8
  double sign[most_ranks] = {};
  double alpha[most_ranks] = {};
  double* w = nullptr;        ///< w_r[i] = w[r * stride + i]
  std::ptrdiff_t stride = 0;  ///< at least row_chunk more than there are rows
};

/// Takes the terms through the columns of one supernode (column-major, rows x columns, the triangle first).
/// On return w holds what is left for the rows below. A pivot d is refused where d <= least[j]. Returns the
/// number of columns that passed: `columns`, unless one was refused.
[[nodiscard]] std::ptrdiff_t rotate_supernode(RankTerms& terms, double* l, std::ptrdiff_t rows,
                                              std::ptrdiff_t columns, const double* least);

}  // namespace perimode
