// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "perimode/assembly/body.hpp"
#include "perimode/reference/wave_in_bar.hpp"

namespace perimode::studies {

/// Displacements along x at the particles, 0 along the other axes, m (point-major).
template <int Dim>
[[nodiscard]] Eigen::VectorXd along_x(const Body<Dim>& body, const std::function<double(double)>& u);

/// In place of a step: nine tenths of the stable one, shortened to hit the last instant.
inline constexpr double automatic_step = 0.0;

/// Displacements (point-major) at the given instants (ascending, whole numbers of steps) of a body that is
/// let go from u0 at rest and stepped by central differences.
template <int Dim>
[[nodiscard]] std::vector<Eigen::VectorXd> release(Body<Dim>& body, const Eigen::VectorXd& u0, double dt,
                                                   const std::vector<double>& times);

/// Strain between the cells on both sides of `x` of a bar that is let go likewise, at every `every`-th step
/// from 0 on and at `end`.
[[nodiscard]] std::vector<double> strain_history(Body<1>& bar, const Eigen::VectorXd& u0, double dt,
                                                 double end, int every, double x);

/// omega(k) of waves along x in the lattice of a model, pressure waves (its calibration, kernel and volume
/// correction; the family complete).
[[nodiscard]] DispersionRelation lattice_relation(const Model& model);

/// The same stepped by central differences.
[[nodiscard]] DispersionRelation stepped_relation(const Model& model, double dt);

}  // namespace perimode::studies
