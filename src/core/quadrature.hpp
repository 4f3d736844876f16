// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

namespace perimode {

struct QuadratureNode {
  double x = 0.0;  ///< in (-1, 1)
  double weight = 0.0;
};

/// Nodes of the 16-point Gauss-Legendre rule.
[[nodiscard]] const std::array<QuadratureNode, 16>& gauss_legendre();

/// Composite rule. For cos(k x) with at most 4 rad a panel the error is below rounding.
template <class Function>
double integrate(double lower, double upper, int panels, Function f) {
  const double half = 0.5 * (upper - lower) / panels;
  double sum = 0.0;
  for (int panel = 0; panel < panels; ++panel) {
    const double centre = lower + (2 * panel + 1) * half;
    for (const QuadratureNode& node : gauss_legendre()) sum += node.weight * f(centre + half * node.x);
  }
  return half * sum;
}

}  // namespace perimode
