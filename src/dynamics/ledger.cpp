// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/ledger.hpp"

#include "dynamics/saved_state.hpp"

namespace perimode {

double dot(const ForceTerm& term, const Eigen::VectorXd& x) {
  double sum = 0.0;
  for (std::size_t k = 0; k < term.dof.size(); ++k) sum += term.value[k] * x[term.dof[k]];
  return sum;
}

void add(const ForceTerm& term, double factor, Eigen::VectorXd& x) {
  if (factor == 0.0) return;
  for (std::size_t k = 0; k < term.dof.size(); ++k) x[term.dof[k]] += factor * term.value[k];
}

Eigen::VectorXd values_at(const std::vector<ForceTerm>& terms, double t) {
  Eigen::VectorXd h(static_cast<Eigen::Index>(terms.size()));
  for (Eigen::Index k = 0; k < h.size(); ++k) h[k] = value_at(terms[static_cast<std::size_t>(k)].time, t);
  return h;
}

Eigen::VectorXd reactions(const Motion& motion, const Eigen::VectorXd& pq, const Eigen::VectorXd& h) {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(h.size());
  std::vector<Eigen::Index> given;
  for (Eigen::Index k = 0; k < h.size(); ++k)
    if (motion.force[static_cast<std::size_t>(k)].motion) given.push_back(k);
  for (std::size_t k = 0; k < given.size(); ++k) {
    force[given[k]] = -pq[given[k]];
    for (std::size_t l = 0; l < given.size(); ++l) {
      force[given[k]] +=
          h[given[l]] * motion.motion_stiffness(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(l));
    }
  }
  return force;
}

double given_energy(const Motion& motion, const Eigen::VectorXd& pq, const Eigen::VectorXd& h) {
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(h.size());
  return 0.5 * h.dot(reactions(motion, pq, h) + reactions(motion, pq, none));
}

Energies Ledger::with(double kinetic, double strain) const {
  Energies e;
  e.kinetic = kinetic;
  e.strain = strain;
  e.external_work = work.value();
  e.damping = damping.value();
  e.initial = initial;
  return e;
}

void save(const Ledger& ledger, double dt, IntegratorState& state) {
  state.numbers["ledger"] = {ledger.work.sum,     ledger.work.lost, ledger.damping.sum,
                             ledger.damping.lost, ledger.initial,   dt};
}

Ledger saved_ledger(const IntegratorState& state, double dt) {
  const std::vector<double>& n = saved_numbers(state, "ledger", 6);
  check_saved_step(n[5], dt);
  return {{n[0], n[1]}, {n[2], n[3]}, n[4]};
}

}  // namespace perimode
