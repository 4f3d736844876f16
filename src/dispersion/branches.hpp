// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "perimode/core/types.hpp"

namespace perimode {

/// Eigenpairs of a symbol in the order of the branches: P, then S ascending.
template <int Dim>
struct Branches {
  std::array<double, Dim> squared = {};
  Eigen::Matrix<double, Dim, Dim> polarisation = Eigen::Matrix<double, Dim, Dim>::Identity();
};

/// Ascending eigenpairs of a symmetric matrix, to round-off of its norm.
template <int Dim>
Branches<Dim> ascending_eigenpairs(const Eigen::Matrix<double, Dim, Dim>& m) {
  Branches<Dim> pairs;
  if constexpr (Dim == 1) {
    pairs.squared[0] = m(0, 0);
  } else if constexpr (Dim == 2) {
    const double half = 0.5 * (m(0, 0) - m(1, 1));
    const double mean = 0.5 * (m(0, 0) + m(1, 1));
    const double radius = std::hypot(half, m(1, 0));
    pairs.squared = {mean - radius, mean + radius};
    if (radius > 0.0) {
      const Point<2> upper = half >= 0.0 ? Point<2>(half + radius, m(1, 0)).normalized()
                                         : Point<2>(m(1, 0), radius - half).normalized();
      pairs.polarisation << -upper[1], upper[0], upper[0], upper[1];
    }
  } else {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(m);
    for (std::size_t b = 0; b < 3; ++b) pairs.squared[b] = solver.eigenvalues()[static_cast<int>(b)];
    pairs.polarisation = solver.eigenvectors();
  }
  return pairs;
}

/// Turns the eigenvectors first..last-1, which share an eigenvalue, so that the last of them is as parallel
/// to the direction as it can be.
template <int Dim>
void turn_towards(Branches<Dim>& pairs, int first, int last, const Point<Dim>& direction) {
  const auto shared = pairs.polarisation.middleCols(first, last - first);
  Point<Dim> along = shared * (shared.transpose() * direction);
  const double length = along.norm();
  if (length < 1e-6) return;
  along /= length;
  auto& v = pairs.polarisation;
  if constexpr (Dim == 2) {
    v.col(0) = Point<2>(-along[1], along[0]);
  } else if constexpr (Dim == 3) {
    if (last - first == 3) {
      v.col(0) = along.unitOrthogonal();
      v.col(1) = along.cross(v.col(0));
    } else {
      v.col(first) = Point<3>(along.cross(v.col(first == 0 ? 2 : 0)));
    }
  }
  v.col(last - 1) = along;
}

/// Eigenpairs of a symbol named by polarisation. Eigenvalues nearer than 1e-12 `scale` count as one, whose
/// eigenvectors are chosen for P; where two waves are equally parallel to the direction P is the faster.
/// Signs: P along the direction, of S the first component that is not small positive.
template <int Dim>
Branches<Dim> branches_of(const Eigen::Matrix<double, Dim, Dim>& symbol, const Point<Dim>& direction,
                          double scale) {
  Branches<Dim> pairs = ascending_eigenpairs<Dim>(symbol);
  for (int first = 0, last = 1; first < Dim; first = last++) {
    while (last < Dim && pairs.squared[static_cast<std::size_t>(last)] -
                                 pairs.squared[static_cast<std::size_t>(last) - 1] <=
                             1e-12 * scale)
      ++last;
    if (last - first > 1) turn_towards<Dim>(pairs, first, last, direction);
  }
  int pressure = Dim - 1;
  double parallel = std::abs(pairs.polarisation.col(pressure).dot(direction));
  for (int b = Dim - 2; b >= 0; --b) {
    const double here = std::abs(pairs.polarisation.col(b).dot(direction));
    if (here > parallel + 1e-9) {
      pressure = b;
      parallel = here;
    }
  }
  for (int b = pressure; b > 0; --b) {  // P to the front, the order of the others stays
    std::swap(pairs.squared[static_cast<std::size_t>(b)], pairs.squared[static_cast<std::size_t>(b) - 1]);
    pairs.polarisation.col(b).swap(pairs.polarisation.col(b - 1));
  }
  if (pairs.polarisation.col(0).dot(direction) < 0.0) pairs.polarisation.col(0) *= -1.0;
  for (int b = 1; b < Dim; ++b) {
    int c = 0;
    while (std::abs(pairs.polarisation(c, b)) < 1e-9) ++c;
    if (pairs.polarisation(c, b) < 0.0) pairs.polarisation.col(b) *= -1.0;
  }
  return pairs;
}

}  // namespace perimode
