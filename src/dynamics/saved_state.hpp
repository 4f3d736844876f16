// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "perimode/dynamics/motion.hpp"

namespace perimode {

void save(const std::string& name, const Eigen::VectorXd& x, IntegratorState& state);

/// The numbers of that name, as long as `state` lives. Throws invalid_input where there are none, or not
/// `size`.
[[nodiscard]] const std::vector<double>& saved_numbers(const IntegratorState& state, const std::string& name,
                                                       std::size_t size);
/// A copy of them.
[[nodiscard]] Eigen::VectorXd saved(const IntegratorState& state, const std::string& name, Eigen::Index size);

/// Throws invalid_input where the step `saved` (s) of a checkpoint is not that of the run.
void check_saved_step(double saved, double dt);

}  // namespace perimode
