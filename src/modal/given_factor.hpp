// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "perimode/linalg/factor.hpp"
#include "perimode/modal/modes.hpp"

namespace perimode {

/// What a caller that follows a changing symmetric body keeps between analyses.
struct GivenFactor {
  LinearOperator action;                   ///< K as it is
  const Csr* stiffness = nullptr;          ///< in the analysed pattern, as it is where inertia is asked for
  const CholeskyFactor* factor = nullptr;  ///< of K - shift M
  double shift = 0.0;                      ///< < 0
};

/// The shift below zero that solve_modes takes for the lowest modes, (rad/s)^2.
template <int Dim>
[[nodiscard]] double lowest_modes_shift(const Body<Dim>& body, const Eigen::VectorXd& mass);

/// The lowest options.modes modes as solve_modes finds them, by block Lanczos on that factor.
template <int Dim>
[[nodiscard]] ModalResult solve_modes_by(const Body<Dim>& body, const ModalOptions& options,
                                         const GivenFactor& given, const Eigen::VectorXd& mass,
                                         const Sink& sink);

}  // namespace perimode
