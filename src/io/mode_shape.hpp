// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "perimode/core/error.hpp"
#include "perimode/geometry/particles.hpp"
#include "perimode/io/initial_state.hpp"

namespace perimode {

/// A mode of a modes.exo times its scale, over all dofs of these particles (point-major). Throws
/// invalid_input, at `where`: a file that is no Exodus file or no result of a modal analysis, particles other
/// than these (number, places to 1e-9 of the body's extent), a mode it does not hold.
template <int Dim>
[[nodiscard]] Eigen::VectorXd read_mode_shape(const ModeField& field, const Particles<Dim>& particles,
                                              const Where& where);

}  // namespace perimode
