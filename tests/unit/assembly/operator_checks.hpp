// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <random>

#include "perimode/assembly/assemble.hpp"
#include "perimode/assembly/operators.hpp"
#include "support/models.hpp"

namespace perimode::test {

/// Uniform in [-1, 1].
inline Eigen::VectorXd random_vector(Eigen::Index size, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  return Eigen::VectorXd::NullaryExpr(size, [&] { return uniform(generator); });
}

/// sum_b |k_b| |n| (|n| . (|u_i| + |u_j|)): the sizes of the numbers each row sums, before they cancel.
template <int Dim>
Eigen::VectorXd sizes(const Body<Dim>& body, const Eigen::VectorXd& x) {
  const auto& map = body.boundary;
  const auto u = map.expand(x.data());
  Eigen::VectorXd out = Eigen::VectorXd::Zero(x.size());
  for (Index i = 0; i < body.count(); ++i) {
    for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
      const Point<Dim> n = (end.xi / end.length).cwiseAbs();
      double stretch = 0.0;
      for (int a = 0; a < Dim; ++a) {
        const std::size_t own = static_cast<std::size_t>(i) * Dim + a;
        const auto g = static_cast<std::size_t>(std::max(end.neighbour - body.count(), 0));
        const double other = end.neighbour < body.count()
                                 ? u[static_cast<std::size_t>(end.neighbour) * Dim + a]
                                 : followed(map, g, a, [&u](Index j, int b) {
                                     return u[static_cast<std::size_t>(j) * Dim + b];
                                   });
        stretch += n[a] * ((map.free_number[own] < 0 ? 0.0 : std::abs(u[own])) + std::abs(other));
      }
      for (int a = 0; a < Dim; ++a) {
        const Index number = map.free_number[static_cast<std::size_t>(i) * Dim + a];
        if (number >= 0) out[number] += std::abs(bond_stiffness(body, i, end)) * n[a] * stretch;
      }
    });
  }
  return out;
}

/// Every form times a random vector is the assembled matrix times it. Each row sums up to some hundred
/// products whose sizes add up to `sizes`; round-off of the sums, of b = sqrt(k) n and of the harmonic mean
/// is a few units in the last place (2e-16) of that, a few tens at the very worst.
template <int Dim>
void expect_forms_equal_the_matrix(const Body<Dim>& body, unsigned seed = 1) {
  const Csr matrix = scalar_csr(assemble_stiffness(body), body.boundary.free_number);
  const Eigen::VectorXd x = random_vector(body.boundary.free, seed);
  const Eigen::VectorXd expected = multiply(as_operator(matrix), x);
  const Eigen::VectorXd scale = sizes(body, x);
  for (auto form :
       {StiffnessForm::automatic, StiffnessForm::stencil, StiffnessForm::bonds, StiffnessForm::blocks}) {
    if (form == StiffnessForm::stencil && !body.particles.grid) continue;
    const auto k = stiffness_operator(body, form);
    ASSERT_EQ(k.size, body.boundary.free);
    for (int repeat = 0; repeat < 2; ++repeat) {  // the second product meets used memory
      Eigen::VectorXd y = Eigen::VectorXd::Constant(k.size, std::nan(""));
      k.apply(x.data(), y.data());
      const Eigen::ArrayXd excess = (y - expected).array().abs() - 2e-14 * scale.array();
      ASSERT_TRUE((excess <= 0.0).all()) << "form " << static_cast<int>(form) << ", worst "
                                         << excess.maxCoeff() << " of " << body.count() << " particles";
    }
  }
}

/// A stiff ball of another kernel, a block of the same material, a hole.
inline Model of_blocks(const std::vector<int>& cells, Calibration calibration) {
  Model m = box_model(cells, 1.0, 3.0);
  Coordinates centre;
  for (int n : cells) centre.push_back(n / 3.0);
  m.blocks.push_back({"stiff", Region{BallRegion{centre, 3.0}, {}}});
  for (double& c : centre) c += 5.0;
  m.blocks.push_back({"same", Region{BallRegion{centre, 3.0}, {}}});
  m.block_materials["stiff"] = m.material;
  m.block_materials["stiff"].youngs_modulus = 7.0;
  m.block_materials["stiff"].micromodulus.kernel = Kernel::gaussian;
  std::get<GridSpec>(m.particles).remove.push_back(Region{BallRegion{{12.0, 3.0, 4.0}, 1.9}, {}});
  m.calibration = calibration;
  return m;
}

}  // namespace perimode::test
