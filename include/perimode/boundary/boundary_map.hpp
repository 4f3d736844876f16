// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "perimode/bonds/bonds.hpp"
#include "perimode/boundary/conditions.hpp"
#include "perimode/linalg/sparse.hpp"

namespace perimode {

/// The affine map u_all = T q + g from the free degrees of freedom to those of all particles, ghosts
/// included, in its compact form: a dof of a particle is free or has a given value; a dof of a ghost is
///   u_ghost[a] = coefficient[a] u_image[a] + value[a].
/// Beyond surface nodes the image is the particle that u is extrapolated from.
/// dof = Dim * particle + component. Sources: docs/theory/03_boundaries.md.
template <int Dim>
struct BoundaryMap {
  std::vector<Index> free_number;   ///< per dof of a particle: number among the free ones, or -1
  std::vector<double> given;        ///< per dof of a particle: its value where it is not free, m
  std::vector<Index> image;         ///< per ghost: the particle it follows
  std::vector<double> coefficient;  ///< Dim per ghost
  std::vector<double> value;        ///< Dim per ghost, m
  Index free = 0;                   ///< number of free dofs

  /// Ghosts that follow further particles (surface nodes of a given traction): their entries
  /// more_start[ghost] .. more_start[ghost + 1]. All empty where there are none.
  std::vector<Offset> more_start = {};
  std::vector<Index> more_image = {};
  std::vector<double> more_coefficient = {};  ///< Dim per entry

  /// How given values and those of ghosts vary in time; the first one is constant. A static or modal analysis
  /// takes all of them in full.
  std::vector<TimeFunction> time = {TimeFunction{}};
  std::vector<int> given_time = {};  ///< per dof of a particle: number in `time`; empty: all constant
  std::vector<int> value_time = {};  ///< per ghost, likewise

  /// Displacements of all particle dofs from the free ones, given values in full. Cost O(dofs).
  [[nodiscard]] std::vector<double> expand(const double* q) const;
};

/// The same map with the given values (of particles and ghosts) that vary as `time[number]` alone, the others
/// zero: u_all = T q + sum_k h_k(t) g_k, and this is T and g_k.
template <int Dim>
[[nodiscard]] BoundaryMap<Dim> with_only(const BoundaryMap<Dim>& map, int number);

/// The map at an instant: given values times their h_k(t).
template <int Dim>
[[nodiscard]] BoundaryMap<Dim> at_time(const BoundaryMap<Dim>& map, double t);

/// Component a of the linear part of a ghost's displacement, value(particle, a) being those of particles.
template <int Dim, class Value>
[[nodiscard]] inline double followed(const BoundaryMap<Dim>& map, std::size_t ghost, int a, Value&& value) {
  double u = map.coefficient[ghost * Dim + a] * value(map.image[ghost], a);
  if (map.more_start.empty()) return u;
  for (Offset e = map.more_start[ghost]; e < map.more_start[ghost + 1]; ++e)
    u += map.more_coefficient[static_cast<std::size_t>(e) * Dim + a] * value(map.more_image[e], a);
  return u;
}

/// Calls visit(particle, coefficients) for every particle that a ghost follows, those of Dim coefficients 0
/// left out; no particle comes twice.
template <int Dim, class Visit>
inline void for_each_image(const BoundaryMap<Dim>& map, std::size_t ghost, Visit&& visit) {
  const auto take = [&](Index particle, const double* coefficient) {
    for (int a = 0; a < Dim; ++a) {
      if (coefficient[a] != 0.0) return visit(particle, coefficient);
    }
  };
  take(map.image[ghost], map.coefficient.data() + ghost * Dim);
  if (map.more_start.empty()) return;
  for (Offset e = map.more_start[ghost]; e < map.more_start[ghost + 1]; ++e)
    take(map.more_image[e], map.more_coefficient.data() + static_cast<std::size_t>(e) * Dim);
}

/// Displacement of a bond partner, particle or ghost, for displacements `u` of all particle dofs; with
/// `given` false, ghosts follow by the linear part of the map alone.
template <int Dim>
[[nodiscard]] inline Point<Dim> partner_displacement(const BoundaryMap<Dim>& map, const double* u,
                                                     Index partner, Index particles, bool given = true) {
  Point<Dim> result;
  for (int a = 0; a < Dim; ++a) {
    if (partner < particles) {
      result[a] = u[static_cast<std::size_t>(partner) * Dim + a];
      continue;
    }
    const auto g = static_cast<std::size_t>(partner - particles);
    result[a] =
        followed(map, g, a, [u](Index i, int b) { return u[static_cast<std::size_t>(i) * Dim + b]; }) +
        (given ? map.value[g * Dim + a] : 0.0);
  }
  return result;
}

/// The same map as sparse matrices: T (all dofs x free), R (free x all dofs, picks the equations), g.
struct BoundaryMatrices {
  Csr t;
  Csr r;
  std::vector<double> g;
};

/// Stiffness of a bond seen from a particle, N/m (body.hpp).
template <int Dim>
using BondStiffness = std::function<double(Index, const BondEnd<Dim>&)>;

/// What lies beyond each face of a grid, for make_grid_bonds. Throws invalid_input: two
/// conditions on one face, a wall on a periodic axis or on an axis the body does not have.
template <int Dim>
[[nodiscard]] std::array<Beyond, 2 * Dim> beyond_faces(const std::vector<BoundaryCondition>& conditions,
                                                       const std::array<bool, 3>& periodic);

/// Numbers the free dofs and says what ghosts do. A fixed dof stays fixed whatever comes later; among
/// prescribed values the last one holds, and so does the last wall where faces of surface nodes meet.
/// Surface nodes of a given traction take the stiffness of the bonds that are alive now; those across the
/// surface are not to break later. Throws invalid_input: a region that holds no particle, a component the
/// body does not have, no particle behind an edge of surface nodes, a traction outside 1D, of a body shorter
/// than the reach of its bonds or without bonds across its surface. Cost O(particles + ghosts); with a
/// traction O(bonds).
template <int Dim>
[[nodiscard]] BoundaryMap<Dim> make_boundary_map(const Particles<Dim>& particles, const Bonds<Dim>& bonds,
                                                 const std::vector<BoundaryCondition>& conditions,
                                                 const BondStiffness<Dim>& stiffness);

template <int Dim>
[[nodiscard]] BoundaryMatrices boundary_matrices(const BoundaryMap<Dim>& map);

}  // namespace perimode
