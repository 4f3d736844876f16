// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "perimode/assembly/body.hpp"
#include "perimode/dynamics/motion.hpp"

namespace perimode {

/// The given displacements that vary as one function of time, u = g h(t).
struct GivenShape {
  int function = 0;   ///< number in BoundaryMap::time
  Eigen::VectorXd g;  ///< of all particle dofs, m
};

/// Those of a body that are not all zero.
template <int Dim>
[[nodiscard]] std::vector<GivenShape> given_shapes(const Body<Dim>& body);

/// Forces -R K g_k of every shape and g_k^T K g_l, with K of the bonds as they are, in place of those that
/// `motion` has; loads stay before them. Cost O(bonds * shapes).
template <int Dim>
void set_given_forces(const Body<Dim>& body, const std::vector<GivenShape>& shapes, Motion& motion);

/// The free part of a force on all particle dofs, times `sign`, without its zeros.
template <int Dim>
[[nodiscard]] ForceTerm free_term(const BoundaryMap<Dim>& boundary, const Eigen::VectorXd& all, double sign);

}  // namespace perimode
