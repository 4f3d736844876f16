// SPDX-License-Identifier: BSD-3-Clause
#include "boundary/surface_traction.hpp"

#include <fmt/format.h>

#include <map>

#include "boundary/map_times.hpp"

namespace perimode {

namespace {

/// u_s = constant + sum of weight u over particles.
struct SurfaceValue {
  double constant = 0.0;  ///< m
  std::map<Index, double> weight;
};

/// Of a wall at face `side`, its ghosts still those of u_s = 0: coefficient = -r_f.
SurfaceValue surface_value(const BoundaryMap<1>& map, const Particles<1>& particles,
                           const GridBonds<1>& bonds, int side, double traction,
                           const BondStiffness<1>& stiffness) {
  SurfaceValue u;
  double total = 0.0;
  for (Index i = 0; i < particles.count(); ++i) {
    for_each_bond(bonds, i, Which::alive, [&](const BondEnd<1>& end) {
      if (end.neighbour < particles.count()) return;
      const auto g = static_cast<std::size_t>(end.neighbour - particles.count());
      if (bonds.ghosts[g].crossings[side] == 0) return;
      const double k = stiffness(i, end);
      const double ratio = -map.coefficient[g];
      u.weight[i] += k;
      u.weight[map.image[g]] += k * ratio;
      total += k * (1.0 + ratio);
    });
  }
  if (!(total > 0.0)) return {};
  const double area = particles.volume.front() / particles.grid->spacing;
  u.constant = (side == 1 ? 1.0 : -1.0) * traction * area / total;
  for (auto& [particle, weight] : u.weight) weight /= total;
  return u;
}

}  // namespace

void add_tractions(BoundaryMap<1>& map, const Particles<1>& particles, const Bonds<1>& bonds,
                   const std::vector<BoundaryCondition>& conditions, const BondStiffness<1>& stiffness) {
  const auto* grid = std::get_if<GridBonds<1>>(&bonds);
  if (grid == nullptr) return;
  std::array<SurfaceValue, 2> surface;  // per face
  std::array<int, 2> time = {};
  bool given = false;
  for (const auto& condition : conditions) {
    const auto* wall = std::get_if<Wall>(&condition.what);
    if (wall == nullptr || !wall->traction) continue;
    const int side = wall->face.upper ? 1 : 0;
    if (particles.grid->cells[0] < grid->reach) {
      invalid_input({"a body at least as long as its bonds reach, where a surface has a traction",
                     fmt::format("{} particles, bonds that reach {}", particles.grid->cells[0], grid->reach),
                     "use a smaller spacing or a shorter horizon", condition.where});
    }
    surface[side] = surface_value(map, particles, *grid, side, *wall->traction, stiffness);
    if (surface[side].weight.empty()) {
      invalid_input({"bonds across the surface with the traction", "none",
                     "move the pre-crack or the removed particles off the surface", condition.where});
    }
    time[side] = time_number(map, wall->time);
    given = true;
  }
  if (!given) return;
  const std::size_t n = grid->ghosts.size();
  map.more_start.assign(1, 0);
  for (std::size_t g = 0; g < n; ++g) {
    const int side = grid->ghosts[g].crossings[1] > 0 ? 1 : 0;
    const double share = 1.0 - map.coefficient[g];  // of u_s: 1 + r_f
    for (const auto& [particle, weight] : surface[side].weight) {
      if (particle == map.image[g]) {
        map.coefficient[g] += share * weight;
      } else {
        map.more_image.push_back(particle);
        map.more_coefficient.push_back(share * weight);
      }
    }
    map.more_start.push_back(static_cast<Offset>(map.more_image.size()));
    if (surface[side].weight.empty()) continue;
    map.value[g] = share * surface[side].constant;
    set_time(map.value_time, n, g, time[side]);
  }
}

}  // namespace perimode
