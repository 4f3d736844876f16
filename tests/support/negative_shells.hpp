// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <random>

#include "perimode/bonds/family.hpp"
#include "perimode/material/material.hpp"

namespace perimode::test {

/// Kernel shells with a random number from `least` to 1 for every orbit; the outermost is negative.
template <int Dim>
Micromodulus random_shells(double spacing, double horizon, unsigned seed, double least = -0.6) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> alpha(least, 1.0);
  const Family<Dim> family = make_family<Dim>(spacing, horizon, VolumeCorrection::none);
  Micromodulus m{Kernel::shells};
  m.shells.reserve(family.shell.size());
  for (const auto& own : family.shell) {
    Shell shell;
    std::copy(own.begin(), own.end(), shell.offset.begin());
    shell.alpha = alpha(generator);
    m.shells.push_back(shell);
  }
  m.shells.back().alpha = -0.3 + 0.2 * alpha(generator);
  return m;
}

inline Micromodulus random_shells(int dim, double spacing, double horizon, unsigned seed,
                                  double least = -0.6) {
  if (dim == 1) return random_shells<1>(spacing, horizon, seed, least);
  return dim == 2 ? random_shells<2>(spacing, horizon, seed, least)
                  : random_shells<3>(spacing, horizon, seed, least);
}

/// The convex quadratic programme of the plane for N = 2, plane strain: its lattice is stable in the bulk
/// although the bonds of (2, 0) have negative stiffness.
inline Micromodulus optimised_two() {
  Micromodulus m{Kernel::shells};
  m.shells = {{{1, 0, 0}, 8.1746376428}, {{1, 1, 0}, 1.4809609794}, {{2, 0, 0}, -3.0401212702}};
  return m;
}

}  // namespace perimode::test
