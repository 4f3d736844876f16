// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "perimode/assembly/bond_forces.hpp"
#include "perimode/dynamics/motion.hpp"

namespace perimode {

/// Central differences in velocity form,
///   v_{n+1/2} = v_{n-1/2} + dt a_n,   q_{n+1} = q_n + dt v_{n+1/2},
/// with the exact start v_{-1/2} = v_0 - (dt/2) a_0 [scabbia2023] eq. (6). Diagonal damping is centred,
/// C (v_{n-1/2} + v_{n+1/2})/2; stiffness damping acts on v_{n-1/2} and costs a second product per step.
/// One pass over memory per step: the product and the update are one. Energies are those of the half step,
/// (1/2) v_{n-1/2}^T M v_{n-1/2} and (1/2) u_{n-1}^T K u_n, which balance exactly where K is symmetric.
/// The step is not checked against stable_step. `motion` has to outlive the integrator.
[[nodiscard]] std::unique_ptr<Integrator> central_difference(const Motion& motion, double dt);

/// The same with the forces of bonds that turn and break in place of K q (motion.stiffness is used for
/// stiffness damping alone). Energies stand at whole steps: (1/2) v_n^T M v_n with v_n = (v_{n-1/2} +
/// v_{n+1/2})/2 and that of the bonds, and balance to the order of the scheme. `forces` has to outlive the
/// integrator.
template <int Dim>
[[nodiscard]] std::unique_ptr<Integrator> central_difference(const Motion& motion, BondForces<Dim>& forces,
                                                             double dt);

}  // namespace perimode
