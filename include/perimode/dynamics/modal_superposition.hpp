// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "perimode/dynamics/motion.hpp"

namespace perimode {

/// What modes leave out of the initial state and the loads.
struct Truncation {
  double initial_energy = 0.0;  ///< share of the initial energy that the modes do not carry, 0 .. 1
  double load =
      0.0;  ///< share of the loads likewise: 1 - sum (phi^T p)^2 / (p^T M^-1 p), largest of the terms
};

/// q = sum_k phi_k y_k(t) with the exact response of every mode to loads that vary linearly within a step
/// (exact for free vibration, constant and ramp loads, any dt), and energies likewise. Displacements are made
/// of the modes only when asked for. `modes` are columns with phi^T M phi = 1 and
/// `lambda` their eigenvalues (rad/s)^2, rigid modes (0) included. Damping must be modal: Rayleigh's.
/// Throws invalid_input: unsymmetric K, nodal damping or sponges.
[[nodiscard]] std::unique_ptr<Integrator> modal_superposition(const Motion& motion, double dt,
                                                              const Eigen::MatrixXd& modes,
                                                              const Eigen::VectorXd& lambda);

[[nodiscard]] Truncation truncation(const Motion& motion, const Eigen::MatrixXd& modes,
                                    const Eigen::VectorXd& lambda, const Eigen::VectorXd& q,
                                    const Eigen::VectorXd& v);

}  // namespace perimode
