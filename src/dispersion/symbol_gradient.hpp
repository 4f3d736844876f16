// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "perimode/dispersion/lattice.hpp"

namespace perimode {

/// A symbol with its gradient, docs/theory/16_dispersion.md eqs. (2) to (4).
template <int Dim>
struct SymbolGradient {
  using Matrix = Eigen::Matrix<double, Dim, Dim>;
  Matrix symbol = Matrix::Zero();
  std::array<Matrix, Dim> gradient = {};  ///< dM/dk_c
  double scale = 0.0;                     ///< trace of the symbol of |rates|: what round-off is relative to

  SymbolGradient() { gradient.fill(Matrix::Zero()); }

  /// a^T dM/dk b
  [[nodiscard]] Point<Dim> between(const Point<Dim>& a, const Point<Dim>& b) const {
    Point<Dim> g;
    for (int c = 0; c < Dim; ++c) g[c] = a.dot(gradient[static_cast<std::size_t>(c)] * b);
    return g;
  }
};

/// Calls visit(xi, rate of the bond and its negative together / |xi|^2) for half of the family.
template <int Dim, class Visit>
void for_each_pair(const Lattice<Dim>& lattice, Visit visit) {
  const Family<Dim>& family = lattice.family;
  const std::size_t pairs = family.offset.size() / 2;
  for (std::size_t j = 0; j < pairs; ++j) {
    Point<Dim> xi;
    for (int a = 0; a < Dim; ++a) xi[a] = family.spacing * family.offset[j][static_cast<std::size_t>(a)];
    visit(xi, 2.0 * lattice.rates[j] / (family.length[j] * family.length[j]));
  }
}

/// M(k) and dM/dk_c = sum_j rate_j n_j n_j^T xi_jc sin k.xi_j.
template <int Dim>
SymbolGradient<Dim> symbol_gradient(const Lattice<Dim>& lattice, const Point<Dim>& k) {
  SymbolGradient<Dim> result;
  for_each_pair(lattice, [&](const Point<Dim>& xi, double rate) {
    const double half = 0.5 * k.dot(xi);
    const double s = std::sin(half);
    const double c = std::cos(half);
    const typename SymbolGradient<Dim>::Matrix outer = xi * xi.transpose();
    result.symbol += (2.0 * rate * s * s) * outer;
    for (int a = 0; a < Dim; ++a)
      result.gradient[static_cast<std::size_t>(a)] += (2.0 * rate * s * c * xi[a]) * outer;
    result.scale += 2.0 * std::abs(rate) * s * s * xi.squaredNorm();
  });
  return result;
}

/// The acoustic tensor A(d) = (1/2) sum_j rate_j n_j n_j^T (xi_j.d)^2 and dA/dd_c.
template <int Dim>
SymbolGradient<Dim> acoustic_tensor(const Lattice<Dim>& lattice, const Point<Dim>& d) {
  SymbolGradient<Dim> result;
  for_each_pair(lattice, [&](const Point<Dim>& xi, double rate) {
    const double s = xi.dot(d);
    const typename SymbolGradient<Dim>::Matrix outer = xi * xi.transpose();
    result.symbol += (0.5 * rate * s * s) * outer;
    for (int a = 0; a < Dim; ++a) result.gradient[static_cast<std::size_t>(a)] += (rate * s * xi[a]) * outer;
    result.scale += 0.5 * std::abs(rate) * s * s * xi.squaredNorm();
  });
  return result;
}

}  // namespace perimode
