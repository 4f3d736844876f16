// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/bonds/crossing.hpp"

#include <algorithm>

namespace perimode {

namespace {

template <int Dim>
bool same_place(const Crack<Dim>& a, const Crack<Dim>& b, double tolerance) {
  return a.corner.size() == b.corner.size() &&
         std::all_of(a.corner.begin(), a.corner.end(), [&](const Point<Dim>& p) {
           return std::any_of(b.corner.begin(), b.corner.end(),
                              [&](const Point<Dim>& q) { return (p - q).norm() <= tolerance; });
         });
}

template <int Dim>
bool near_box(const Crack<Dim>& crack, const Point<Dim>& low, const Point<Dim>& high) {
  Point<Dim> a = crack.corner[0];
  Point<Dim> b = crack.corner[0];
  for (const auto& c : crack.corner) {
    a = a.cwiseMin(c);
    b = b.cwiseMax(c);
  }
  return ((b - low).array() >= 0.0).all() && ((high - a).array() >= 0.0).all();
}

/// Cracks and their images within a box.
template <int Dim>
struct CrackImages {
  std::vector<Crack<Dim>> cracks;
  Point<Dim> low, high;
  double tolerance;

  void add(const Crack<Dim>& image) {
    const bool known = std::any_of(cracks.begin(), cracks.end(),
                                   [&](const Crack<Dim>& c) { return same_place(c, image, tolerance); });
    if (!known && near_box(image, low, high)) cracks.push_back(image);
  }
  void add_shifted(Crack<Dim> image, int axis, double by) {
    for (auto& c : image.corner) c[axis] += by;
    add(image);
  }
};

/// The cracks with all their images in walls and periods that bonds of the grid can meet.
template <int Dim>
std::vector<Crack<Dim>> with_images(const GridBonds<Dim>& bonds, const Grid<Dim>& grid,
                                    std::vector<Crack<Dim>> cracks, double tolerance) {
  const double reach = (bonds.reach + 1) * grid.spacing;
  CrackImages<Dim> all{std::move(cracks), grid.lower.array() - reach, grid.upper().array() + reach,
                       tolerance};
  for (std::size_t k = 0; k < all.cracks.size(); ++k) {  // grows: images of images
    for (int a = 0; a < Dim; ++a) {
      const double period = grid.cells[a] * grid.spacing;
      for (int side = 0; side < 2; ++side) {
        const Crack<Dim> original = all.cracks[k];
        if (bonds.beyond[2 * a + side] == Beyond::ghosts) {
          all.add(reflected(original, a, grid.lower[a] + side * period));
        } else if (bonds.beyond[2 * a + side] == Beyond::periodic_image) {
          all.add_shifted(original, a, side == 0 ? -period : period);
        }
      }
    }
  }
  return all.cracks;
}

/// The cracks with all their periodic images that bonds of the cloud can meet.
template <int Dim>
std::vector<Crack<Dim>> with_images(const CloudBonds<Dim>& bonds, const Particles<Dim>& particles,
                                    double reach, std::vector<Crack<Dim>> cracks, double tolerance) {
  if ((bonds.period.array() == 0.0).all()) return cracks;
  Point<Dim> low = particles.position.front();
  Point<Dim> high = low;
  for (const auto& x : particles.position) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  CrackImages<Dim> all{std::move(cracks), low.array() - reach, high.array() + reach, tolerance};
  for (std::size_t k = 0; k < all.cracks.size(); ++k) {  // grows: images of images
    for (int a = 0; a < Dim; ++a) {
      if (bonds.period[a] == 0.0) continue;
      const Crack<Dim> original = all.cracks[k];
      all.add_shifted(original, a, -bonds.period[a]);
      all.add_shifted(original, a, bonds.period[a]);
    }
  }
  return all.cracks;
}

}  // namespace

template <int Dim>
std::vector<CrossingEnd> crossing_ends(const Bonds<Dim>& bonds, const Particles<Dim>& particles,
                                       std::vector<Crack<Dim>> cracks, double spacing) {
  const double tolerance = 1e-9 * spacing;
  for (auto& crack : cracks) crack.joined.resize(crack.corner.size());
  double reach = 0.0;
  if (const auto* grid = std::get_if<GridBonds<Dim>>(&bonds)) {
    cracks = with_images(*grid, *particles.grid, std::move(cracks), tolerance);
    reach = (grid->reach + 1) * grid->family.spacing;
  } else {
    const auto& cloud = std::get<CloudBonds<Dim>>(bonds);
    for (const auto& xi : cloud.xi) reach = std::max(reach, xi.norm());
    reach += tolerance;
    cracks = with_images(cloud, particles, reach, std::move(cracks), tolerance);
  }
  auto all = cracks;
  join(all, tolerance);
  for (std::size_t c = 0; c < all.size(); ++c) {
    for (std::size_t k = 0; k < all[c].joined.size(); ++k)
      all[c].joined[k] = all[c].joined[k] || cracks[c].joined[k];
  }
  const Index n = particles.count();
  constexpr Index chunk = 4096;  // particles whose ends are listed together
  const Index chunks = (n + chunk - 1) / chunk;
  std::vector<std::vector<CrossingEnd>> found(static_cast<std::size_t>(chunks));
  // Each end decides for itself; ties are decided by the tolerance, far above round-off, so both agree.
#pragma omp parallel for schedule(dynamic)
  for (Index part = 0; part < chunks; ++part) {
    std::vector<const Crack<Dim>*> near;
    for (Index i = part * chunk; i < std::min(n, (part + 1) * chunk); ++i) {
      const Point<Dim>& x = particles.position[i];
      near.clear();
      for (const auto& crack : all)
        if (near_box<Dim>(crack, x.array() - reach, x.array() + reach)) near.push_back(&crack);
      if (near.empty()) continue;
      for_each_bond(bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
        const Point<Dim> y = x + end.xi;
        const Point<Dim> low = x.cwiseMin(y).array() - tolerance;
        const Point<Dim> high = x.cwiseMax(y).array() + tolerance;
        const bool crossed = std::any_of(near.begin(), near.end(), [&](const Crack<Dim>* crack) {
          return near_box(*crack, low, high) && crosses(*crack, x, y, tolerance);
        });
        if (crossed) found[static_cast<std::size_t>(part)].push_back({i, end.slot});
      });
    }
  }
  std::vector<CrossingEnd> ends;
  for (const auto& some : found) ends.insert(ends.end(), some.begin(), some.end());
  return ends;
}

#define PERIMODE_CROSSING(D)                                                               \
  template std::vector<CrossingEnd> crossing_ends<D>(const Bonds<D>&, const Particles<D>&, \
                                                     std::vector<Crack<D>>, double)
PERIMODE_CROSSING(1);
PERIMODE_CROSSING(2);
PERIMODE_CROSSING(3);
#undef PERIMODE_CROSSING

}  // namespace perimode
