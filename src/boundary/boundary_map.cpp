// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/boundary/boundary_map.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "boundary/ghost_rule.hpp"
#include "boundary/map_times.hpp"
#include "boundary/surface_traction.hpp"

namespace perimode {

namespace {

std::string face_name(const Face& face) {
  return fmt::format("{}{}", "xyz"[face.axis], face.upper ? '+' : '-');
}

template <int Dim>
std::vector<Index> chosen(const Region& at, const Where& where, const Particles<Dim>& particles) {
  auto particles_in = select(at, particles);
  if (particles_in.empty()) {
    invalid_input({"a region that holds at least one particle", "none", "move or enlarge the region",
                   at.where.line > 0 ? at.where : where});
  }
  return particles_in;
}

template <int Dim>
void check_component(int component, const Where& where) {
  if (component < 0 || component >= Dim) {
    invalid_input({fmt::format("components of a {}-dimensional body", Dim),
                   fmt::format("'{}'", component >= 0 && component < 3 ? "xyz"[component] : '?'),
                   fmt::format("use {}", std::string("x, y, z").substr(0, 3 * Dim - 2)), where});
  }
}

template <int Dim>
void check_surface(const Wall& wall, const Where& where) {
  if (!wall.displacement.empty() && wall.displacement.size() != static_cast<std::size_t>(Dim)) {
    invalid_input({fmt::format("{} component{} of the surface's displacement", Dim, Dim == 1 ? "" : "s"),
                   fmt::format("{}", wall.displacement.size()), fmt::format("the body has dimension {}", Dim),
                   where});
  }
  if (wall.traction && Dim != 1) {
    invalid_input({"a traction of surface nodes in 1D", fmt::format("dimension {}", Dim),
                   "give the traction as a load on the outermost layer of the face", where});
  }
}

/// What the ghosts do.
template <int Dim>
void add_ghosts(BoundaryMap<Dim>& map, const Grid<Dim>& grid, const GridBonds<Dim>& bonds,
                const std::vector<BoundaryCondition>& conditions) {
  const std::size_t n = bonds.ghosts.size();
  map.image.resize(n);
  map.coefficient.resize(n * Dim);
  map.value.assign(n * Dim, 0.0);
  const auto walls = wall_numbers<Dim>(conditions);
  for (std::size_t g = 0; g < n; ++g) {
    const GhostRule<Dim> rule = ghost_rule(bonds.ghosts[g], grid, bonds, conditions, walls);
    map.image[g] = rule.particle;
    const bool surface = rule.wall != GhostRule<Dim>::none;
    for (int a = 0; a < Dim; ++a) map.coefficient[g * Dim + a] = rule.sign[a] * (surface ? -rule.ratio : 1.0);
    if (!surface) continue;
    const auto& wall = std::get<Wall>(conditions[rule.wall].what);
    if (wall.displacement.empty()) continue;
    std::array<double, 3> x = {};
    std::copy_n(rule.surface.data(), Dim, x.data());
    for (int a = 0; a < Dim; ++a)
      map.value[g * Dim + a] = rule.sign[a] * (1.0 + rule.ratio) * wall.displacement[a](x[0], x[1], x[2]);
    set_time(map.value_time, n, g, time_number(map, wall.time));
  }
}

}  // namespace

template <int Dim>
std::vector<double> BoundaryMap<Dim>::expand(const double* q) const {
  std::vector<double> u = given;
  for (std::size_t d = 0; d < u.size(); ++d) {
    if (free_number[d] >= 0) u[d] = q[free_number[d]];
  }
  return u;
}

namespace {

/// Given values of particles and ghosts times factor[number of their time function].
template <int Dim>
BoundaryMap<Dim> scaled(BoundaryMap<Dim> map, const std::vector<double>& factor) {
  for (std::size_t d = 0; d < map.given.size(); ++d)
    map.given[d] *= factor[map.given_time.empty() ? 0 : static_cast<std::size_t>(map.given_time[d])];
  for (std::size_t v = 0; v < map.value.size(); ++v)
    map.value[v] *= factor[map.value_time.empty() ? 0 : static_cast<std::size_t>(map.value_time[v / Dim])];
  return map;
}

}  // namespace

template <int Dim>
BoundaryMap<Dim> with_only(const BoundaryMap<Dim>& map, int number) {
  std::vector<double> factor(map.time.size(), 0.0);
  factor[static_cast<std::size_t>(number)] = 1.0;
  return scaled(map, factor);
}

template <int Dim>
BoundaryMap<Dim> at_time(const BoundaryMap<Dim>& map, double t) {
  std::vector<double> factor;
  factor.reserve(map.time.size());
  for (const TimeFunction& h : map.time) factor.push_back(value_at(h, t));
  return scaled(map, factor);
}

template <int Dim>
std::array<Beyond, 2 * Dim> beyond_faces(const std::vector<BoundaryCondition>& conditions,
                                         const std::array<bool, 3>& periodic) {
  std::array<Beyond, 2 * Dim> beyond = {};
  for (int a = 0; a < Dim; ++a) {
    if (periodic[a]) beyond[2 * a] = beyond[2 * a + 1] = Beyond::periodic_image;
  }
  for (const auto& condition : conditions) {
    const auto* wall = std::get_if<Wall>(&condition.what);
    if (wall == nullptr) continue;
    const Face& face = wall->face;
    if (face.axis < 0 || face.axis >= Dim) {
      invalid_input({fmt::format("a wall on a face of a {}-dimensional body", Dim), face_name(face),
                     "use another face", condition.where});
    }
    Beyond& here = beyond[2 * face.axis + (face.upper ? 1 : 0)];
    if (here == Beyond::periodic_image) {
      invalid_input({"a wall on an axis that is not periodic", face_name(face),
                     "remove the wall, or the axis from body.periodic", condition.where});
    }
    if (here == Beyond::ghosts) {
      invalid_input({"one wall per face", fmt::format("a second one on {}", face_name(face)), "remove one",
                     condition.where});
    }
    here = Beyond::ghosts;
  }
  return beyond;
}

template <int Dim>
BoundaryMap<Dim> make_boundary_map(const Particles<Dim>& particles, const Bonds<Dim>& bonds,
                                   const std::vector<BoundaryCondition>& conditions,
                                   const BondStiffness<Dim>& stiffness) {
  BoundaryMap<Dim> map;
  const auto dofs = static_cast<std::size_t>(particles.count()) * Dim;
  map.given.assign(dofs, 0.0);
  std::vector<char> state(dofs, 0);  // 0 free, 1 prescribed, 2 fixed
  for (const auto& condition : conditions) {
    if (const auto* fix = std::get_if<Fix>(&condition.what)) {
      for (Index i : chosen(fix->at, condition.where, particles)) {
        for (int c : fix->components) {
          check_component<Dim>(c, condition.where);
          state[static_cast<std::size_t>(i) * Dim + c] = 2;
          map.given[static_cast<std::size_t>(i) * Dim + c] = 0.0;
          set_time(map.given_time, dofs, static_cast<std::size_t>(i) * Dim + c, 0);
        }
      }
    } else if (const auto* prescribe = std::get_if<Prescribe>(&condition.what)) {
      const int number = time_number(map, prescribe->time);
      for (Index i : chosen(prescribe->at, condition.where, particles)) {
        for (const auto& [c, value] : prescribe->components) {
          check_component<Dim>(c, condition.where);
          const std::size_t dof = static_cast<std::size_t>(i) * Dim + c;
          if (state[dof] == 2) continue;
          state[dof] = 1;
          map.given[dof] = value;
          set_time(map.given_time, dofs, dof, number);
        }
      }
    } else {
      check_surface<Dim>(std::get<Wall>(condition.what), condition.where);
    }
  }
  map.free_number.assign(dofs, -1);
  for (std::size_t d = 0; d < dofs; ++d) {
    if (state[d] == 0) map.free_number[d] = map.free++;
  }

  if (const auto* grid = std::get_if<GridBonds<Dim>>(&bonds))
    add_ghosts(map, *particles.grid, *grid, conditions);
  if constexpr (Dim == 1) add_tractions(map, particles, bonds, conditions, stiffness);
  return map;
}

template <int Dim>
BoundaryMatrices boundary_matrices(const BoundaryMap<Dim>& map) {
  const auto particle_dofs = static_cast<Index>(map.free_number.size());
  const auto ghosts = static_cast<Index>(map.image.size());
  BoundaryMatrices m;
  m.t = {particle_dofs + ghosts * Dim, map.free, {0}, {}, {}};
  m.r = {map.free, particle_dofs + ghosts * Dim, {0}, {}, {}};
  m.g = map.given;
  const auto add = [&](Index free, double coefficient) {
    if (free < 0 || coefficient == 0.0) return;
    m.t.column.push_back(free);
    m.t.value.push_back(coefficient);
  };
  const auto end_row = [&] { m.t.row_start.push_back(static_cast<Offset>(m.t.column.size())); };
  for (Index d = 0; d < particle_dofs; ++d) {
    add(map.free_number[d], 1.0);
    end_row();
    if (map.free_number[d] < 0) continue;
    m.r.column.push_back(d);
    m.r.value.push_back(1.0);
    m.r.row_start.push_back(static_cast<Offset>(m.r.column.size()));
  }
  for (std::size_t g = 0; g < map.image.size(); ++g) {
    for (int c = 0; c < Dim; ++c) {
      double given = map.value[g * Dim + c];
      for_each_image(map, g, [&](Index j, const double* coefficient) {
        add(map.free_number[j * Dim + c], coefficient[c]);
        given += coefficient[c] * map.given[j * Dim + c];
      });
      end_row();
      m.g.push_back(given);
    }
  }
  return m;
}

#define PERIMODE_BOUNDARY(D)                                                                                 \
  template struct BoundaryMap<D>;                                                                            \
  template BoundaryMap<D> with_only<D>(const BoundaryMap<D>&, int);                                          \
  template BoundaryMap<D> at_time<D>(const BoundaryMap<D>&, double);                                         \
  template std::array<Beyond, 2 * D> beyond_faces<D>(const std::vector<BoundaryCondition>&,                  \
                                                     const std::array<bool, 3>&);                            \
  template BoundaryMap<D> make_boundary_map<D>(                                                              \
      const Particles<D>&, const Bonds<D>&, const std::vector<BoundaryCondition>&, const BondStiffness<D>&); \
  template BoundaryMatrices boundary_matrices<D>(const BoundaryMap<D>&)
PERIMODE_BOUNDARY(1);
PERIMODE_BOUNDARY(2);
PERIMODE_BOUNDARY(3);
#undef PERIMODE_BOUNDARY

}  // namespace perimode
