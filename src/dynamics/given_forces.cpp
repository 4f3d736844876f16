// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/given_forces.hpp"

#include <algorithm>
#include <utility>

#include "perimode/assembly/operators.hpp"

namespace perimode {

template <int Dim>
ForceTerm free_term(const BoundaryMap<Dim>& boundary, const Eigen::VectorXd& all, double sign) {
  ForceTerm term;
  for (Eigen::Index d = 0; d < all.size(); ++d) {
    const Index number = boundary.free_number[static_cast<std::size_t>(d)];
    if (number < 0 || all[d] == 0.0) continue;
    term.dof.push_back(number);
    term.value.push_back(sign * all[d]);
  }
  return term;
}

template <int Dim>
std::vector<GivenShape> given_shapes(const Body<Dim>& body) {
  std::vector<GivenShape> shapes;
  for (std::size_t k = 0; k < body.boundary.time.size(); ++k) {
    const BoundaryMap<Dim> map = with_only(body.boundary, static_cast<int>(k));
    const auto zero = [](double v) { return v == 0.0; };
    if (std::all_of(map.given.begin(), map.given.end(), zero) &&
        std::all_of(map.value.begin(), map.value.end(), zero)) {
      continue;
    }
    shapes.push_back(
        {static_cast<int>(k),
         Eigen::Map<const Eigen::VectorXd>(map.given.data(), static_cast<Eigen::Index>(map.given.size()))});
  }
  return shapes;
}

template <int Dim>
void set_given_forces(const Body<Dim>& body, const std::vector<GivenShape>& shapes, Motion& motion) {
  std::erase_if(motion.force, [](const ForceTerm& term) { return term.motion; });
  std::vector<Eigen::VectorXd> force;  // K g_k on all particle dofs
  for (const GivenShape& shape : shapes) {
    force.push_back(internal_force(body, with_only(body.boundary, shape.function), shape.g));
    ForceTerm term = free_term(body.boundary, force.back(), -1.0);
    term.time = body.boundary.time[static_cast<std::size_t>(shape.function)];
    term.motion = true;
    motion.force.push_back(std::move(term));
  }
  const auto n = static_cast<Eigen::Index>(shapes.size());
  motion.motion_stiffness.resize(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    for (Eigen::Index l = 0; l < n; ++l) {
      const auto a = static_cast<std::size_t>(k);
      const auto b = static_cast<std::size_t>(l);
      motion.motion_stiffness(k, l) = 0.5 * (shapes[a].g.dot(force[b]) + shapes[b].g.dot(force[a]));
    }
  }
}

#define PERIMODE_GIVEN(D)                                                                     \
  template std::vector<GivenShape> given_shapes<D>(const Body<D>&);                           \
  template void set_given_forces<D>(const Body<D>&, const std::vector<GivenShape>&, Motion&); \
  template ForceTerm free_term<D>(const BoundaryMap<D>&, const Eigen::VectorXd&, double)
PERIMODE_GIVEN(1);
PERIMODE_GIVEN(2);
PERIMODE_GIVEN(3);
#undef PERIMODE_GIVEN

}  // namespace perimode
