// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "perimode/assembly/model.hpp"

namespace perimode {

/// One mode of a body whose discrete eigenproblem separates.
struct ClosedFormMode {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double discrete = unknown;   ///< angular frequency of the discrete body, exact, rad/s
  double nonlocal = unknown;   ///< of the peridynamic continuum (same wave vector and branch)
  double classical = unknown;  ///< of classical elasticity
};

/// The lowest `count` modes (rigid ones, at 0, counted; ascending in `discrete`) of a grid body
/// that separates: no holes, cracks or blocks, calibration continuum (or discrete with complete
/// families), and per axis periodic or two reflecting walls whose modes are sines and cosines
/// (1D: odd, even; 2D and 3D: mirror, antimirror, also mixed with periodic axes).
/// Empty, with the reason in `why_not`, for any other body.
[[nodiscard]] std::optional<std::vector<ClosedFormMode>> closed_form_modes(const Model& model, int count,
                                                                           std::string& why_not);

}  // namespace perimode
