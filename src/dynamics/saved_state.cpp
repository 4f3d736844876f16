// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/saved_state.hpp"

#include <fmt/format.h>

#include "perimode/core/error.hpp"

namespace perimode {

void save(const std::string& name, const Eigen::VectorXd& x, IntegratorState& state) {
  state.numbers[name].assign(x.begin(), x.end());
}

const std::vector<double>& saved_numbers(const IntegratorState& state, const std::string& name,
                                         std::size_t size) {
  const auto found = state.numbers.find(name);
  if (found == state.numbers.end() || found->second.size() != size) {
    invalid_input({fmt::format("a checkpoint with {} numbers named {}", size, name),
                   found == state.numbers.end() ? "none" : fmt::format("{}", found->second.size()),
                   "resume with the case that made it",
                   {}});
  }
  return found->second;
}

Eigen::VectorXd saved(const IntegratorState& state, const std::string& name, Eigen::Index size) {
  return Eigen::Map<const Eigen::VectorXd>(saved_numbers(state, name, static_cast<std::size_t>(size)).data(),
                                           size);
}

void check_saved_step(double saved, double dt) {
  if (saved == dt) return;
  invalid_input({fmt::format("a checkpoint of steps of {} s", dt),
                 fmt::format("{} s", saved),
                 "resume with the case that made it",
                 {}});
}

}  // namespace perimode
