// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/geometry/particles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace perimode {

template <int Dim>
Particles<Dim> grid_particles(const Grid<Dim>& grid, double section) {
  Particles<Dim> p;
  const auto n = static_cast<Index>(grid.count());
  p.position.reserve(n);
  p.cell.reserve(n);
  for (Index i = 0; i < n; ++i) {
    p.position.push_back(grid.centre(grid.cell(i)));
    p.cell.push_back(i);
  }
  p.volume.assign(n, std::pow(grid.spacing, Dim) * section);
  p.block.assign(n, 0);
  p.grid = grid;
  return p;
}

namespace {

template <int Dim>
struct Selector {
  const Particles<Dim>& particles;
  const Where& where;
  double tolerance;

  template <class Inside>
  std::vector<Index> all(const Inside& inside) const {
    std::vector<Index> chosen;
    for (Index i = 0; i < particles.count(); ++i) {
      if (inside(i)) chosen.push_back(i);
    }
    return chosen;
  }

  std::vector<Index> operator()(const FaceRegion& r) const {
    const int axis = r.face.axis;
    if (axis >= Dim) {
      invalid_input({fmt::format("a face of a {}-dimensional body", Dim), fmt::format("axis {}", "xyz"[axis]),
                     "use another face", where});
    }
    if (particles.grid) {
      if (r.layers < 1) {
        invalid_input({"layers >= 1 for a face region of a grid",
                       fmt::format("layers {}, depth {}", r.layers, r.depth), "write {face: x-, layers: 3}",
                       where});
      }
      const auto& grid = *particles.grid;
      return all([&](Index i) {
        const Index c = grid.cell(particles.cell[i])[axis];
        return r.face.upper ? c >= grid.cells[axis] - r.layers : c < r.layers;
      });
    }
    if (!(r.depth > 0.0)) {
      invalid_input({"depth > 0 (m) for a face region of a cloud",
                     fmt::format("layers {}, depth {}", r.layers, r.depth),
                     "write {face: x-, depth: 0.01}; layers belong to grids", where});
    }
    double extreme =
        r.face.upper ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
    for (const auto& x : particles.position) {
      extreme = r.face.upper ? std::max(extreme, x[axis]) : std::min(extreme, x[axis]);
    }
    return all(
        [&](Index i) { return std::abs(particles.position[i][axis] - extreme) <= r.depth * (1.0 + 1e-9); });
  }

  std::vector<Index> operator()(const BoxRegion& r) const {
    const Point<Dim> low = to_point<Dim>(r.lower, "box.lower", where);
    const Point<Dim> top = to_point<Dim>(r.upper, "box.upper", where);
    return all([&](Index i) {
      const auto& x = particles.position[i];
      return ((x - low).array() >= -tolerance).all() && ((top - x).array() >= -tolerance).all();
    });
  }

  std::vector<Index> operator()(const BallRegion& r) const {
    const Point<Dim> centre = to_point<Dim>(r.centre, "ball.centre", where);
    return all([&](Index i) { return (particles.position[i] - centre).norm() <= r.radius + tolerance; });
  }

  std::vector<Index> operator()(const BlockRegion& r) const {
    const auto& names = particles.block_names;
    const auto it = std::find(names.begin() + 1, names.end(), r.name);
    if (it == names.end()) {
      invalid_input({"the name of a block of the body", fmt::format("'{}'", r.name),
                     names.size() > 1
                         ? fmt::format("blocks are: {}", fmt::join(names.begin() + 1, names.end(), ", "))
                         : std::string("the body has no blocks"),
                     where});
    }
    const auto number = static_cast<int>(it - names.begin());
    return all([&](Index i) { return particles.block[i] == number; });
  }

  std::vector<Index> operator()(const NearestRegion& r) const {
    const Point<Dim> target = to_point<Dim>(r.point, "nearest", where);
    Index best = 0;
    double distance = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < particles.count(); ++i) {
      const double d = (particles.position[i] - target).norm();
      if (d < distance - tolerance) {
        best = i;
        distance = d;
      } else if (d <= distance + tolerance && higher(particles.position[i], particles.position[best])) {
        best = i;
        distance = std::min(distance, d);
      }
    }
    return {best};
  }

  bool higher(const Point<Dim>& a, const Point<Dim>& b) const {
    for (int k = 0; k < Dim; ++k) {
      if (std::abs(a[k] - b[k]) > tolerance) return a[k] > b[k];
    }
    return false;
  }
};

}  // namespace

template <int Dim>
std::vector<Index> select(const Region& region, const Particles<Dim>& particles) {
  if (particles.count() == 0) return {};
  const double tolerance = 1e-9 * typical_spacing(particles, 1.0);
  return std::visit(Selector<Dim>{particles, region.where, tolerance}, region.shape);
}

template <int Dim>
Particles<Dim> without(const Particles<Dim>& particles, const std::vector<Index>& removed) {
  Particles<Dim> left;
  left.block_names = particles.block_names;
  left.grid = particles.grid;
  std::size_t next = 0;
  for (Index i = 0; i < particles.count(); ++i) {
    if (next < removed.size() && removed[next] == i) {
      ++next;
      continue;
    }
    left.position.push_back(particles.position[i]);
    left.volume.push_back(particles.volume[i]);
    left.block.push_back(particles.block[i]);
    if (!particles.cell.empty()) left.cell.push_back(particles.cell[i]);
  }
  return left;
}

template <int Dim>
double typical_spacing(const Particles<Dim>& particles, double section) {
  if (particles.grid) return particles.grid->spacing;
  double sum = 0.0;
  for (double v : particles.volume) sum += std::pow(v / section, 1.0 / Dim);
  return sum / static_cast<double>(std::max<std::size_t>(1, particles.volume.size()));
}

#define PERIMODE_PARTICLES(D)                                                       \
  template Particles<D> grid_particles<D>(const Grid<D>&, double);                  \
  template std::vector<Index> select<D>(const Region&, const Particles<D>&);        \
  template Particles<D> without<D>(const Particles<D>&, const std::vector<Index>&); \
  template double typical_spacing<D>(const Particles<D>&, double)
PERIMODE_PARTICLES(1);
PERIMODE_PARTICLES(2);
PERIMODE_PARTICLES(3);
#undef PERIMODE_PARTICLES

}  // namespace perimode
