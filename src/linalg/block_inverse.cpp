// SPDX-License-Identifier: BSD-3-Clause
#include "block_inverse.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <memory>

#include "fused.hpp"
#include "perimode/core/error.hpp"
#include "perimode/linalg/conjugate_gradients.hpp"
#include "vector_kernels.hpp"

namespace perimode {
namespace {

constexpr int widest = 16;
using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, widest, widest>;

Square inverse_of(const Square& a) {
  const Eigen::LLT<Square> factor(a);
  // A pivot at round-off level (a mechanism) counts as not positive.
  const bool positive =
      factor.info() == Eigen::Success &&
      factor.matrixLLT().diagonal().minCoeff() > 1e-6 * factor.matrixLLT().diagonal().maxCoeff();
  if (positive) {
    const Square inverse = factor.solve(Square::Identity(a.rows(), a.cols()));
    return 0.5 * (inverse + inverse.transpose());
  }
  Square inverse = Square::Zero(a.rows(), a.cols());
  for (Eigen::Index k = 0; k < a.rows(); ++k) {
    // a <= rows diag(a) for every positive semi-definite a
    inverse(k, k) = a(k, k) > 0.0 ? 1.0 / (static_cast<double>(a.rows()) * a(k, k)) : 1.0;
  }
  return inverse;
}

/// use(first dof, residual-to-correction product) for nodes [first, last): v = D^-1 (b - q), q may be null.
template <int Block, bool HasQ, class Use>
[[gnu::always_inline]] inline void full_nodes(const BlockInverse& m, Index first, Index last, const double* b,
                                              const double* q, const Use& use) {
  for (Index node = first; node < last; ++node) {
    const double* d = m.inverse.data() + static_cast<std::size_t>(m.which[node]) * Block * Block;
    const std::size_t at = static_cast<std::size_t>(node) * Block;
    double r[Block];
    for (int k = 0; k < Block; ++k) r[k] = HasQ ? b[at + k] - q[at + k] : b[at + k];
    for (int k = 0; k < Block; ++k) {
      double v = 0.0;
      for (int l = 0; l < Block; ++l) v += d[k * Block + l] * r[l];
      use(at + k, v);
    }
  }
}

template <bool HasQ, class Use>
[[gnu::always_inline]] inline void any_nodes(const BlockInverse& m, Index first, Index last, const double* b,
                                             const double* q, const Use& use) {
  if (m.start.empty()) {
    if (m.block == 1) return full_nodes<1, HasQ>(m, first, last, b, q, use);
    if (m.block == 2) return full_nodes<2, HasQ>(m, first, last, b, q, use);
    if (m.block == 3) return full_nodes<3, HasQ>(m, first, last, b, q, use);
  }
  for (Index node = first; node < last; ++node) {
    const double* d = m.inverse.data() + static_cast<std::size_t>(m.which[node]) * m.block * m.block;
    const std::size_t at = static_cast<std::size_t>(m.first_dof(node));
    const int count = static_cast<int>(static_cast<std::size_t>(m.first_dof(node + 1)) - at);
    for (int k = 0; k < count; ++k) {
      double v = 0.0;
      for (int l = 0; l < count; ++l) v += d[k * count + l] * (HasQ ? b[at + l] - q[at + l] : b[at + l]);
      use(at + k, v);
    }
  }
}

PERIMODE_EVERY_PROCESSOR void apply_part(const BlockInverse& m, Index first, Index last, const double* x,
                                         double* __restrict y) {
  any_nodes<false>(m, first, last, x, nullptr, [=](std::size_t at, double v) { y[at] = v; });
}

PERIMODE_EVERY_PROCESSOR void start_part(const BlockInverse& m, Index first, Index last, double gain,
                                         const double* b, double* __restrict d, double* __restrict x) {
  any_nodes<false>(m, first, last, b, nullptr, [=](std::size_t at, double v) { d[at] = x[at] = gain * v; });
}

PERIMODE_EVERY_PROCESSOR void step_part(const BlockInverse& m, Index first, Index last, double momentum,
                                        double gain, const double* b, const double* q, double* __restrict d,
                                        double* __restrict x) {
  any_nodes<true>(m, first, last, b, q, [=](std::size_t at, double v) {
    d[at] = momentum * d[at] + gain * v;
    x[at] += d[at];
  });
}

}  // namespace

double BlockInverse::bytes() const {
  return static_cast<double>((which.size() + start.size()) * sizeof(Index) + inverse.size() * sizeof(double));
}

BlockInverse invert_blocks(const std::vector<double>& blocks, int block, std::span<const Index> dof_number) {
  if (block < 1 || block > widest || dof_number.size() % static_cast<std::size_t>(block) != 0 ||
      blocks.size() != dof_number.size() * static_cast<std::size_t>(block)) {
    invalid_input(
        {fmt::format("blocks of 1 to {} rows, one per node, and a number per dof", widest),
         fmt::format("{} numbers in blocks of {} rows, {} dofs", blocks.size(), block, dof_number.size()),
         "take them from one body",
         {}});
  }
  BlockInverse out;
  out.block = block;
  const std::size_t entries = static_cast<std::size_t>(block) * block;
  const double* last = nullptr;  // the block of the node before, and which of its dofs were kept
  std::vector<char> kept(block), last_kept(block);
  bool all_full = true;
  Index dofs = 0;
  for (std::size_t node = 0; node < dof_number.size() / block; ++node) {
    int count = 0;
    for (int k = 0; k < block; ++k) count += kept[k] = dof_number[node * block + k] >= 0 ? 1 : 0;
    if (count == 0) continue;
    all_full = all_full && count == block;
    const double* here = blocks.data() + node * entries;
    if (last == nullptr || kept != last_kept || !std::equal(here, here + entries, last)) {
      Square a(count, count);
      for (int k = 0, row = 0; k < block; ++k) {
        if (!kept[k]) continue;
        for (int l = 0, column = 0; l < block; ++l)
          if (kept[l]) a(row, column++) = 0.5 * (here[k * block + l] + here[l * block + k]);
        ++row;
      }
      const Square inverse = inverse_of(a);
      out.inverse.insert(out.inverse.end(), inverse.data(), inverse.data() + inverse.size());
      out.inverse.resize((out.inverse.size() + entries - 1) / entries * entries, 0.0);
    }
    last = here;
    last_kept = kept;
    out.which.push_back(static_cast<Index>(out.inverse.size() / entries) - 1);
    out.start.push_back(dofs);
    dofs += count;
  }
  out.start.push_back(dofs);
  if (all_full) out.start = {};
  return out;
}

void apply(const BlockInverse& inverse, const double* x, double* y) {
  for_each_chunk(inverse.nodes(), [&](Index at, Index count) { apply_part(inverse, at, at + count, x, y); });
}

void chebyshev_start(const BlockInverse& inverse, double gain, const double* b, double* d, double* x) {
  for_each_chunk(inverse.nodes(),
                 [&](Index at, Index count) { start_part(inverse, at, at + count, gain, b, d, x); });
}

void chebyshev_step(const BlockInverse& inverse, double momentum, double gain, const double* b,
                    const double* q, double* d, double* x) {
  for_each_chunk(inverse.nodes(), [&](Index at, Index count) {
    step_part(inverse, at, at + count, momentum, gain, b, q, d, x);
  });
}

LinearOperator block_jacobi(const std::vector<double>& blocks, int block, std::span<const Index> dof_number) {
  const auto inverse = std::make_shared<const BlockInverse>(invert_blocks(blocks, block, dof_number));
  return {inverse->size(), [inverse](const double* x, double* y) { apply(*inverse, x, y); }};
}

}  // namespace perimode
