// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <array>
#include <string>

#include "perimode/bonds/family.hpp"
#include "perimode/material/material.hpp"

namespace perimode::studies {

/// How the sum over the family is made: linear volume correction (the paper's eq. (36)), the whole cell of
/// every bond (its eqs. (49), (50)), or linear with the constant scaled so that the discrete family is exact
/// for a uniform strain.
enum class Rule { corrected, uncorrected, normalised };
inline constexpr std::array rules = {Rule::corrected, Rule::uncorrected, Rule::normalised};

inline std::string name_of(Rule rule) {
  constexpr std::array<const char*, 3> names = {"corrected", "uncorrected", "normalised"};
  return names[static_cast<std::size_t>(rule)];
}
inline VolumeCorrection correction_of(Rule rule) {
  return rule == Rule::uncorrected ? VolumeCorrection::none : VolumeCorrection::linear;
}
inline Calibration calibration_of(Rule rule) {
  return rule == Rule::normalised ? Calibration::discrete : Calibration::continuum;
}

inline const Micromodulus constant{Kernel::constant, 0.0};
inline Micromodulus gaussian(double p) { return {Kernel::gaussian, p}; }

/// "constant", "gaussian2", ...
inline std::string name_of(const Micromodulus& kernel) {
  return kernel.kernel == Kernel::constant ? "constant" : fmt::format("gaussian{:g}", kernel.p);
}

}  // namespace perimode::studies
