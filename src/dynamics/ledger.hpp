// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "perimode/dynamics/motion.hpp"

namespace perimode {

/// p . x of a force term, N times the unit of x.
[[nodiscard]] double dot(const ForceTerm& term, const Eigen::VectorXd& x);

/// x += factor p
void add(const ForceTerm& term, double factor, Eigen::VectorXd& x);

/// h_k(t) of all terms.
[[nodiscard]] Eigen::VectorXd values_at(const std::vector<ForceTerm>& terms, double t);

/// With u = T q + sum_k h_k g_k and pq = p_k . q: g_k^T K u = -p_k . q + sum_l G_kl h_l of every term that is
/// a motion, 0 of loads: the force that holds it, times its shape, J.
[[nodiscard]] Eigen::VectorXd reactions(const Motion& motion, const Eigen::VectorXd& pq,
                                        const Eigen::VectorXd& h);

/// (u^T K u - q^T K q)/2 = - sum_k h_k p_k . q + (1/2) sum_kl h_k G_kl h_l over the motions, J.
[[nodiscard]] double given_energy(const Motion& motion, const Eigen::VectorXd& pq, const Eigen::VectorXd& h);

/// Work and losses since the start.
struct Ledger {
  CompensatedSum work;
  CompensatedSum damping;
  double initial = 0.0;  ///< J
  [[nodiscard]] Energies with(double kinetic, double strain) const;
};

void save(const Ledger& ledger, double dt, IntegratorState& state);
/// Throws invalid_input where the state is none of this kind, or one of another step.
[[nodiscard]] Ledger saved_ledger(const IntegratorState& state, double dt);

}  // namespace perimode
