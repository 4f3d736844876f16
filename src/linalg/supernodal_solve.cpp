// SPDX-License-Identifier: BSD-3-Clause
#include "supernodal_solve.hpp"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <numeric>

#include "vector_kernels.hpp"

namespace perimode {
namespace {

constexpr int group = 4;  // columns of L that a pass over the rows takes at a time

/// A supernode: `columns` columns of L, dense, `rows` long; the first rows are its own columns.
struct Supernode {
  std::ptrdiff_t rows, columns;
  const double* value;  // column-major, leading dimension rows
};

constexpr std::ptrdiff_t line = 8;  // numbers in a cache line

/// Asks for one cache line of each column of a group that is needed soon: the columns are too short for the
/// processor to see them coming.
[[gnu::always_inline]] inline void fetch_group(const double* at, std::ptrdiff_t rows) {
  for (int q = 0; q < group; ++q) __builtin_prefetch(at + q * rows);
}

/// y[columns..rows) -= L y[0..columns), y[0..columns) = L_11^-1 y; y interleaved, rows x Width.
template <int Width>
[[gnu::always_inline]] inline void forward(const Supernode& node, double* y_data) {
  using Vector = typename Lane<Width>::Type;
  auto* y = reinterpret_cast<Vector*>(y_data);
  const std::ptrdiff_t rows = node.rows;
  for (std::ptrdiff_t j = 0; j < node.columns; j += group) {
    const std::ptrdiff_t width = std::min<std::ptrdiff_t>(group, node.columns - j);
    const double* l = node.value + j * rows;
    for (std::ptrdiff_t q = 0; q < width; ++q) {
      y[j + q] /= l[q * rows + j + q];
      for (std::ptrdiff_t r = q + 1; r < width; ++r) y[j + r] -= l[q * rows + j + r] * y[j + q];
    }
    if (width == group) {
      const Vector y0 = y[j], y1 = y[j + 1], y2 = y[j + 2], y3 = y[j + 3];
      const double *l0 = l, *l1 = l + rows, *l2 = l + 2 * rows, *l3 = l + 3 * rows;
      for (std::ptrdiff_t begin = j + group; begin < rows; begin += line) {
        fetch_group(l + begin + group * rows, rows);
        const std::ptrdiff_t end = std::min(begin + line, rows);
        for (std::ptrdiff_t i = begin; i < end; ++i)
          y[i] -= (l0[i] * y0 + l1[i] * y1) + (l2[i] * y2 + l3[i] * y3);
      }
    } else {
      for (std::ptrdiff_t q = 0; q < width; ++q)
        for (std::ptrdiff_t i = j + width; i < rows; ++i) y[i] -= l[q * rows + i] * y[j + q];
    }
  }
}

/// y[0..columns) = L_11^-T (y[0..columns) - L_21^T y[columns..rows)).
template <int Width>
[[gnu::always_inline]] inline void backward(const Supernode& node, double* y_data) {
  using Vector = typename Lane<Width>::Type;
  auto* y = reinterpret_cast<Vector*>(y_data);
  const std::ptrdiff_t rows = node.rows;
  for (std::ptrdiff_t j = (node.columns - 1) / group * group; j >= 0; j -= group) {
    const std::ptrdiff_t width = std::min<std::ptrdiff_t>(group, node.columns - j);
    const double* l = node.value + j * rows;
    Vector sum[group] = {};
    if (width == group) {
      const double *l0 = l, *l1 = l + rows, *l2 = l + 2 * rows, *l3 = l + 3 * rows;
      Vector s0 = {}, s1 = {}, s2 = {}, s3 = {};
      for (std::ptrdiff_t begin = j + group; begin < rows; begin += line) {
        fetch_group(l + begin - group * rows, rows);
        const std::ptrdiff_t end = std::min(begin + line, rows);
        for (std::ptrdiff_t i = begin; i < end; ++i) {
          const Vector at = y[i];
          s0 += l0[i] * at;
          s1 += l1[i] * at;
          s2 += l2[i] * at;
          s3 += l3[i] * at;
        }
      }
      sum[0] = s0;
      sum[1] = s1;
      sum[2] = s2;
      sum[3] = s3;
    } else {
      for (std::ptrdiff_t q = 0; q < width; ++q)
        for (std::ptrdiff_t i = j + width; i < rows; ++i) sum[q] += l[q * rows + i] * y[i];
    }
    for (std::ptrdiff_t q = width - 1; q >= 0; --q) {
      Vector at = y[j + q] - sum[q];
      for (std::ptrdiff_t r = q + 1; r < width; ++r) at -= l[q * rows + j + r] * y[j + r];
      y[j + q] = at / l[q * rows + j + q];
    }
  }
}

PERIMODE_EVERY_PROCESSOR void forward_4(const Supernode& node, double* y) { forward<4>(node, y); }
PERIMODE_EVERY_PROCESSOR void forward_8(const Supernode& node, double* y) { forward<8>(node, y); }
PERIMODE_EVERY_PROCESSOR void backward_4(const Supernode& node, double* y) { backward<4>(node, y); }
PERIMODE_EVERY_PROCESSOR void backward_8(const Supernode& node, double* y) { backward<8>(node, y); }

/// One group of at most Width vectors; x and y are interleaved work arrays.
template <int Width>
void solve_group(const cholmod_factor& factor, std::span<const int> forward,
                 const Eigen::Ref<const Eigen::MatrixXd>& b, Eigen::MatrixXd& out, Eigen::Index first,
                 double* x, double* y) {
  const auto n = static_cast<std::ptrdiff_t>(factor.n);
  const auto nodes = static_cast<std::ptrdiff_t>(factor.nsuper);
  const auto* super = static_cast<const int*>(factor.super);
  const auto* row_start = static_cast<const int*>(factor.pi);
  const auto* value_start = static_cast<const int*>(factor.px);
  const auto* row = static_cast<const int*>(factor.s);
  const auto* order = static_cast<const int*>(factor.Perm);
  const auto* value = static_cast<const double*>(factor.x);
  const Eigen::Index width = std::min<Eigen::Index>(Width, b.cols() - first);

  for (std::ptrdiff_t k = 0; k < n; ++k)
    for (int w = 0; w < Width; ++w) x[k * Width + w] = w < width ? b(order[k], first + w) : 0.0;
  const auto node_at = [&](std::ptrdiff_t s) {
    return Supernode{row_start[s + 1] - row_start[s], super[s + 1] - super[s], value + value_start[s]};
  };
  for (const int s : forward) {
    const Supernode node = node_at(s);
    const int* below = row + row_start[s];
    double* own = x + static_cast<std::ptrdiff_t>(super[s]) * Width;
    std::copy_n(own, node.columns * Width, y);
    std::fill(y + node.columns * Width, y + node.rows * Width, 0.0);
    Width == 4 ? forward_4(node, y) : forward_8(node, y);
    std::copy_n(y, node.columns * Width, own);
    for (std::ptrdiff_t i = node.columns; i < node.rows; ++i)
      for (int w = 0; w < Width; ++w)
        x[static_cast<std::ptrdiff_t>(below[i]) * Width + w] += y[i * Width + w];
  }
  for (std::ptrdiff_t s = nodes - 1; s >= 0; --s) {
    const Supernode node = node_at(s);
    const int* below = row + row_start[s];
    for (std::ptrdiff_t i = 0; i < node.rows; ++i)
      std::copy_n(x + static_cast<std::ptrdiff_t>(below[i]) * Width, Width, y + i * Width);
    Width == 4 ? backward_4(node, y) : backward_8(node, y);
    std::copy_n(y, node.columns * Width, x + static_cast<std::ptrdiff_t>(super[s]) * Width);
  }
  for (std::ptrdiff_t k = 0; k < n; ++k)
    for (Eigen::Index w = 0; w < width; ++w) out(order[k], first + w) = x[k * Width + w];
}

}  // namespace

void supernodal_solve(const cholmod_factor& factor, const Eigen::Ref<const Eigen::MatrixXd>& b,
                      Eigen::MatrixXd& x, std::vector<double>& work) {
  std::vector<int> all(factor.nsuper);
  std::iota(all.begin(), all.end(), 0);
  supernodal_solve(factor, all, b, x, work);
}

void supernodal_solve(const cholmod_factor& factor, std::span<const int> forward,
                      const Eigen::Ref<const Eigen::MatrixXd>& b, Eigen::MatrixXd& x,
                      std::vector<double>& work) {
  constexpr int wide = 8, narrow = 4;
  x.resize(b.rows(), b.cols());
  constexpr std::size_t alignment = wide * sizeof(double);
  std::size_t room = (2 * factor.n + 1) * alignment;
  work.resize(room / sizeof(double));
  void* begin = work.data();
  auto* interleaved = static_cast<double*>(std::align(alignment, room - alignment, begin, room));
  double* front = interleaved + wide * factor.n;
  for (Eigen::Index first = 0; first < b.cols();) {
    const bool take_wide = b.cols() - first > narrow;
    if (take_wide)
      solve_group<wide>(factor, forward, b, x, first, interleaved, front);
    else
      solve_group<narrow>(factor, forward, b, x, first, interleaved, front);
    first += take_wide ? wide : narrow;
  }
}

}  // namespace perimode
