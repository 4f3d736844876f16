// SPDX-License-Identifier: BSD-3-Clause
#include "fracture/fracture_ledger.hpp"

#include <utility>

#include "dynamics/saved_state.hpp"

namespace perimode {

void FractureLedger::reach(EquilibriumState state, const std::vector<BondState>& broken) {
  if (state_.displacement.size() == 0) {
    state_.displacement = Eigen::VectorXd::Zero(state.displacement.size());
    state_.external = state_.displacement;
  }
  work_.add(0.5 * (state_.external + state.external).dot(state.displacement - state_.displacement));
  dissipated_.add(0.5 * (state_.force * state.along - state.force * state_.along));
  for (std::size_t b = 0; b < left_.size(); ++b) {
    const BondState& before = left_[b];
    relaxation_.add(0.5 * before.share * before.stiffness * before.elongation *
                    (broken[b].elongation - before.elongation));
  }
  left_.clear();
  state_ = std::move(state);
}

void FractureLedger::leave(const std::vector<BondState>& broken) {
  for (const BondState& bond : broken)
    released_.add(0.5 * bond.share * bond.stiffness * bond.elongation * bond.elongation);
  left_.insert(left_.end(), broken.begin(), broken.end());
}

void FractureLedger::put(QuasistaticRow& row) const {
  row.displacement = state_.along;
  row.force = state_.force;
  row.stored_energy = state_.stored;
  row.dissipated_energy = dissipated_.value();
  row.bond_energy_released = released_.value();
  row.relaxation_energy = relaxation_.value();
  row.external_work = work_.value();
}

void FractureLedger::save(IntegratorState& to) const {
  perimode::save("displacement", state_.displacement, to);
  perimode::save("external", state_.external, to);
  std::vector<double>& sums = to.numbers["ledger"];
  sums = {state_.along, state_.force, state_.stored};
  for (const CompensatedSum* sum : {&work_, &released_, &relaxation_, &dissipated_}) {
    sums.push_back(sum->sum);
    sums.push_back(sum->lost);
  }
  std::vector<double>& left = to.numbers["left"];
  left.clear();
  for (const BondState& bond : left_) {
    for (const double x : {bond.stiffness, bond.elongation, bond.share}) left.push_back(x);
  }
}

void FractureLedger::restore(const IntegratorState& from) {
  const auto dofs = static_cast<Eigen::Index>(from.numbers.at("displacement").size());
  state_.displacement = saved(from, "displacement", dofs);
  state_.external = saved(from, "external", dofs);
  const std::vector<double>& sums = saved_numbers(from, "ledger", 11);
  state_.along = sums[0];
  state_.force = sums[1];
  state_.stored = sums[2];
  std::size_t at = 3;
  for (CompensatedSum* sum : {&work_, &released_, &relaxation_, &dissipated_}) {
    sum->sum = sums[at++];
    sum->lost = sums[at++];
  }
  left_.clear();
  const std::vector<double>& left = from.numbers.at("left");
  for (std::size_t b = 0; b + 2 < left.size(); b += 3) left_.push_back({left[b], left[b + 1], left[b + 2]});
}

}  // namespace perimode
