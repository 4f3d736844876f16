// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "perimode/dynamics/motion.hpp"
#include "perimode/linalg/factor.hpp"

namespace perimode {

/// Newmark's method and HHT-alpha (alpha = 0: Newmark):
///   M a_{n+1} + (1 + alpha)(C v + K q)_{n+1} - alpha (C v + K q)_n = (1 + alpha) F_{n+1} - alpha F_n,
///   q_{n+1} = q_n + dt v_n + dt^2 ((1/2 - beta) a_n + beta a_{n+1}),  v_{n+1} = v_n + dt ((1 - gamma) a_n +
///   gamma a_{n+1}).
/// [newmark1959], [hilber1977]. The start's acceleration is that of the equation at t = 0. Energies are those
/// the scheme conserves [krenk2006]: beside (1/2) v^T M v and the strain energy,
///   (1/2) (beta - gamma/2) dt^2 a^T M a in `kinetic`, -(1/2) alpha (1 - gamma) dq^T K dq in `strain`,
/// and its algorithmic dissipation in `damping`; they balance to round-off where K is symmetric.
struct NewmarkOptions {
  double beta = 0.25;
  double gamma = 0.5;
  double alpha = 0.0;  ///< in [-1/3, 0]; not 0: beta = (1 - alpha)^2 / 4, gamma = 1/2 - alpha are set
};

/// Solves (K + diag(d)) x = b for the d that its ShiftedSolver was called with; `guess` is near x. b that is
/// no number gives x that is none. Returns the number of
/// iterations, 0 for a factor.
using ShiftedSolve =
    std::function<int(const Eigen::VectorXd& b, const Eigen::VectorXd& guess, Eigen::VectorXd& x)>;
/// How a Newmark step is solved, made once: by a factor of K + diag(d), or by conjugate gradients.
using ShiftedSolver = std::function<ShiftedSolve(const Eigen::VectorXd& d)>;

class StepBreaking;

/// Each step costs one product with K and one solution; gamma > 1/2, HHT and stiffness damping take a product
/// more each, energies one or two. `motion` has to outlive the integrator. Throws invalid_input for
/// parameters outside their range (beta <= 0, gamma < 1/2, alpha outside [-1/3, 0]).
/// `breaking` (step_breaking.hpp, of the same motion; `solver` then is its own): a step is solved again
/// without the bonds that are beyond their critical stretch at its end, until none is. The equation of a step
/// is that of the bonds alive at its end, HHT's weighted forces included. With gamma = 1/2, alpha = 0 a bond
/// takes along k_b e_n e_{n+1}/2, its elongations at both ends of the step; the general form, which keeps the
/// balance to round-off, is in docs/theory/13_breaking.md.
[[nodiscard]] std::unique_ptr<Integrator> newmark(const Motion& motion, double dt,
                                                  const NewmarkOptions& options, const ShiftedSolver& solver,
                                                  StepBreaking* breaking = nullptr);

}  // namespace perimode
