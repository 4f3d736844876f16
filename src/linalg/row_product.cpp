// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/linalg/row_product.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace perimode {

namespace {

constexpr Index piece = 1024;  ///< rows

}  // namespace

RowProduct in_rows(LinearOperator a) {
  const Index size = a.size;
  const Index pieces = (size + piece - 1) / piece;
  const auto y = std::make_shared<std::vector<double>>(static_cast<std::size_t>(size));
  return {size, pieces, true,
          [size, pieces, y, product = std::move(a)](const double* x,
                                                    const std::function<void(const RowPiece&)>& take) {
            double* all = y->data();
            product.apply(x, all);
#pragma omp parallel for schedule(static) if (pieces > 1)
            for (Index p = 0; p < pieces; ++p)
              take({p, p * piece, std::min(piece, size - p * piece), all + p * piece});
          }};
}

LinearOperator as_operator(RowProduct a) {
  const Index size = a.size;
  return {size, [product = std::move(a)](const double* x, double* y) {
            product.apply(x, [y](const RowPiece& rows) { std::copy_n(rows.y, rows.count, y + rows.first); });
          }};
}

}  // namespace perimode
