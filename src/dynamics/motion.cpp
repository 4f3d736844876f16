// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/dynamics/motion.hpp"

#include <cmath>

namespace perimode {

void CompensatedSum::add(double term) {
  const double total = sum + term;
  lost += std::abs(sum) >= std::abs(term) ? (sum - total) + term : (term - total) + sum;
  sum = total;
}

}  // namespace perimode
