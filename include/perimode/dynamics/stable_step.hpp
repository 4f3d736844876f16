// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>

#include "perimode/assembly/body.hpp"
#include "perimode/linalg/operator.hpp"

namespace perimode {

/// The largest stable step of central differences, from the operator itself.
struct StableStep {
  double limit = 0.0;      ///< s: 2/omega_max; with stiffness damping b: sqrt(b^2 + 4/omega_max^2) - b
  double omega_max = 0.0;  ///< rad/s, of K x = omega^2 M x, never below the true one (docs/theory/11)
  double bound = 0.0;      ///< s: the sufficient step min_i sqrt(2 m_i / sum_b k_b) [silling_askari2005]
  bool symmetric = true;
  /// 1/s: rate at which undamped motion grows, max |Im sqrt(lambda)| of complex eigenvalues that an
  /// unsymmetric boundary brings about (docs/theory/03_boundaries.md). 0: none was found.
  double growth = 0.0;
  int products = 0;  ///< with K
};

/// omega_max of M^-1/2 K M^-1/2: up to 400 dofs from all eigenvalues, else by Lanczos to 1e-4, raised by its
/// error bound [zhou_li2011]; for unsymmetric
/// K from all eigenvalues (up to 400 dofs) or by Arnoldi, raised by ten times the residual; there eigenvalues
/// complex beyond 1e-8 of the largest make `growth`, those of larger bodies as far as Arnoldi meets them.
/// Throws invalid_input, a material instability, where an eigenvalue is below -1e-10 of the largest (on a
/// grid with the wave vector of its motion, in units of pi/spacing); Error(solver_failure) where a product
/// with K is no number. Only bonds of negative micromodulus can make a symmetric K indefinite, so where there
/// are none the lower end is not looked at; where there are, up to 600 products are spent on it, which finds
/// what lies below about -1e-5 of the largest. Cost: some 30 to 150 products.
template <int Dim>
[[nodiscard]] StableStep stable_step(const Body<Dim>& body, const LinearOperator& stiffness,
                                     const Eigen::VectorXd& mass, bool symmetric,
                                     double stiffness_damping = 0.0);

}  // namespace perimode
