// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <memory>

#include "perimode/assembly/assemble.hpp"
#include "perimode/assembly/operators.hpp"
#include "perimode/dynamics/motion.hpp"
#include "perimode/dynamics/newmark.hpp"

namespace perimode::test {

/// Matrices and vectors of a body of one dof.
inline Eigen::MatrixXd number(double x) { return Eigen::MatrixXd::Constant(1, 1, x); }
inline Eigen::VectorXd one(double x) { return Eigen::VectorXd::Constant(1, x); }

/// M q'' + K q = 0 with a dense K.
inline Motion dense_motion(const Eigen::MatrixXd& k, const Eigen::VectorXd& mass) {
  Motion motion;
  motion.mass = mass;
  const auto n = static_cast<Index>(mass.size());
  motion.stiffness = in_rows({n, [k, n](const double* x, double* y) {
                                Eigen::Map<Eigen::VectorXd>(y, n) =
                                    k * Eigen::Map<const Eigen::VectorXd>(x, n);
                              }});
  motion.symmetric = k.isApprox(k.transpose(), 1e-12);
  return motion;
}

inline ShiftedSolver dense_solver(const Eigen::MatrixXd& k) {
  return [k](const Eigen::VectorXd& d) -> ShiftedSolve {
    const Eigen::MatrixXd a = k + Eigen::MatrixXd(d.asDiagonal());
    return [lu = a.partialPivLu()](const Eigen::VectorXd& b, const Eigen::VectorXd&, Eigen::VectorXd& x) {
      x = lu.solve(b);
      return 0;
    };
  };
}

/// K of a body, column by column.
template <int Dim>
Eigen::MatrixXd dense_stiffness(const Body<Dim>& body) {
  return multiply(stiffness_operator(body, StiffnessForm::blocks),
                  Eigen::MatrixXd(Eigen::MatrixXd::Identity(body.boundary.free, body.boundary.free)));
}

template <int Dim>
Motion free_motion(const Body<Dim>& body) {
  Motion motion;
  motion.mass = lumped_mass(body);
  motion.stiffness = in_rows(stiffness_operator(body));
  motion.symmetric = asymmetry(as_operator(motion.stiffness)) <= 1e-12;
  return motion;
}

/// A chain of `n` unit masses and springs whose last one is held by a wall that moves as the time function:
/// K of all n + 1 points, the motion of the n free ones, and a load on the first.
struct DrivenChain {
  Eigen::MatrixXd whole;
  Eigen::MatrixXd k;
  Motion motion;
};

inline DrivenChain driven_chain(Index n, const TimeFunction& wall, const TimeFunction& load,
                                double given = 0.1, double push = 0.3) {
  DrivenChain chain;
  chain.whole = Eigen::MatrixXd::Zero(n + 1, n + 1);
  for (Index i = 0; i < n; ++i) {
    const double stiffness = 1.0 + 0.1 * i;
    chain.whole(i, i) += stiffness;
    chain.whole(i + 1, i + 1) += stiffness;
    chain.whole(i, i + 1) -= stiffness;
    chain.whole(i + 1, i) -= stiffness;
  }
  chain.k = chain.whole.topLeftCorner(n, n);
  chain.motion = dense_motion(chain.k, Eigen::VectorXd::LinSpaced(n, 1.0, 2.0));
  chain.motion.force.push_back({load, {0}, {push}, false});
  chain.motion.force.push_back({wall, {n - 1}, {-chain.whole(n - 1, n) * given}, true});
  chain.motion.motion_stiffness = Eigen::MatrixXd::Constant(1, 1, given * chain.whole(n, n) * given);
  return chain;
}

}  // namespace perimode::test
