// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/ledger.hpp"

#include <fmt/format.h>

#include "perimode/core/error.hpp"

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

void save(const std::string& name, const Eigen::VectorXd& x, IntegratorState& state) {
  state.numbers[name].assign(x.begin(), x.end());
}

Eigen::VectorXd saved(const IntegratorState& state, const std::string& name, Eigen::Index size) {
  const auto found = state.numbers.find(name);
  if (found == state.numbers.end() || found->second.size() != static_cast<std::size_t>(size)) {
    invalid_input({fmt::format("a saved state with {} numbers named {}", size, name),
                   found == state.numbers.end() ? "none" : fmt::format("{}", found->second.size()),
                   "resume with the case and the method the state was made by",
                   {}});
  }
  return Eigen::Map<const Eigen::VectorXd>(found->second.data(), size);
}

void save(const Ledger& ledger, double dt, IntegratorState& state) {
  state.numbers["ledger"] = {ledger.work.sum,     ledger.work.lost, ledger.damping.sum,
                             ledger.damping.lost, ledger.initial,   dt};
}

Ledger saved_ledger(const IntegratorState& state, double dt) {
  const Eigen::VectorXd n = saved(state, "ledger", 6);
  if (n[5] != dt) {
    invalid_input({fmt::format("a saved state of steps of {} s", dt),
                   fmt::format("{} s", n[5]),
                   "resume with the step the state was made by",
                   {}});
  }
  return {{n[0], n[1]}, {n[2], n[3]}, n[4]};
}

}  // namespace perimode
