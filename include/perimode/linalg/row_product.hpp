// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "perimode/linalg/operator.hpp"

namespace perimode {

/// Consecutive rows of a product y = A x, as they come out: rows first .. first + count - 1 in y[0 .. count),
/// which whoever takes them may write to.
struct RowPiece {
  Index piece = 0;  ///< number of the piece, for sums that do not depend on the number of threads
  Index first = 0;
  Index count = 0;
  double* y = nullptr;
};

/// y = A x handed out piece by piece, so that y need never be stored: a step of time takes each piece while
/// it is in the first cache. Every row is handed out once; the pieces are the same for any number of threads,
/// which take them in any order, one `take` each at a time. `take` must not throw.
struct RowProduct {
  Index size = 0;
  Index pieces = 0;  ///< numbers that RowPiece::piece takes
  /// true: nothing reads the rows of x of a piece any more once it is handed out, so that `take` may change
  /// them (and no others). false: x must not change until `apply` is back.
  bool in_place = false;
  std::function<void(const double* x, const std::function<void(const RowPiece&)>& take)> apply;
};

/// Any operator as such, through a vector y of its own.
[[nodiscard]] RowProduct in_rows(LinearOperator a);

/// y = A x as a whole.
[[nodiscard]] LinearOperator as_operator(RowProduct a);

}  // namespace perimode
