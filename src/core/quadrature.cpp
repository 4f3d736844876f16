// SPDX-License-Identifier: BSD-3-Clause
#include "core/quadrature.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace perimode {
namespace {

constexpr int order = 16;

std::array<QuadratureNode, order> make_rule() {
  std::array<QuadratureNode, order> rule;
  for (int i = 0; i < order; ++i) {
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (order + 0.5));
    double slope = 0.0;
    for (int iteration = 0; iteration < 8; ++iteration) {  // Newton; four steps suffice
      double previous = 1.0, value = x;
      for (int n = 2; n <= order; ++n) {
        const double next = ((2 * n - 1) * x * value - (n - 1) * previous) / n;
        previous = value;
        value = next;
      }
      slope = order * (x * value - previous) / (x * x - 1.0);
      x -= value / slope;
    }
    rule[static_cast<std::size_t>(i)] = {x, 2.0 / ((1.0 - x * x) * slope * slope)};
  }
  return rule;
}

}  // namespace

const std::array<QuadratureNode, 16>& gauss_legendre() {
  static const std::array<QuadratureNode, order> rule = make_rule();
  return rule;
}

}  // namespace perimode
