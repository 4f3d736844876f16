// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/probes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace perimode {

namespace {

/// The particle nearest to a point of the body. Inside it means: within half a cell's diagonal of a particle
/// (grids), or within the particles' box widened by half a spacing (clouds).
template <int Dim>
Index particle_at(const Body<Dim>& body, const Coordinates& point, const TransientProbe& probe) {
  const Point<Dim> x = to_point<Dim>(point, "a probe's point", probe.where);
  const Index i = select<Dim>({NearestRegion{point}, probe.where}, body.particles).at(0);
  const double spacing = typical_spacing(body.particles, body.section);
  bool inside = true;
  if (body.particles.grid) {
    const Point<Dim> off = (x - body.particles.position[static_cast<std::size_t>(i)]).cwiseAbs();
    inside = off.maxCoeff() <= 0.5 * spacing * (1.0 + 1e-9);
  } else {
    Point<Dim> low = body.particles.position[0];
    Point<Dim> high = low;
    for (const Point<Dim>& p : body.particles.position) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    inside = ((x - low).array() >= -0.5 * spacing).all() && ((high - x).array() >= -0.5 * spacing).all();
  }
  if (!inside) {
    invalid_input({fmt::format("a point of the body for the probe '{}'", probe.name),
                   fmt::format("[{}]", fmt::join(point, ", ")), "place it inside, away from holes",
                   probe.where});
  }
  return i;
}

}  // namespace

std::vector<std::string> probe_columns(const std::vector<TransientProbe>& probes, int dimension) {
  std::vector<std::string> names;
  for (const TransientProbe& probe : probes) {
    if (probe.kind == TransientProbe::Kind::strain) {
      names.push_back(probe.name);
      continue;
    }
    for (int a = 0; a < dimension; ++a) names.push_back(probe.name + "_" + "xyz"[a]);
  }
  return names;
}

template <int Dim>
std::vector<PlacedProbe<Dim>> place_probes(const Body<Dim>& body, const std::vector<TransientProbe>& probes) {
  std::vector<PlacedProbe<Dim>> placed;
  for (const TransientProbe& probe : probes) {
    PlacedProbe<Dim> p;
    p.kind = probe.kind;
    p.particle = particle_at(body, probe.at, probe);
    if (probe.kind == TransientProbe::Kind::strain) {
      p.other = particle_at(body, probe.to, probe);
      if (p.other == p.particle) {
        invalid_input({fmt::format("two particles for the strain '{}'", probe.name),
                       "points nearest to one and the same", "move them a spacing apart", probe.where});
      }
      const Point<Dim> apart = body.particles.position[static_cast<std::size_t>(p.other)] -
                               body.particles.position[static_cast<std::size_t>(p.particle)];
      p.per_metre = apart / apart.squaredNorm();
    }
    placed.push_back(p);
  }
  return placed;
}

template <int Dim>
std::vector<double> read_probes(const std::vector<PlacedProbe<Dim>>& probes,
                                const std::function<double(Index, int)>& displacement,
                                const std::function<double(Index, int)>& velocity) {
  std::vector<double> values;
  for (const PlacedProbe<Dim>& probe : probes) {
    if (probe.kind == TransientProbe::Kind::strain) {
      double strain = 0.0;
      for (int a = 0; a < Dim; ++a)
        strain += (displacement(probe.other, a) - displacement(probe.particle, a)) * probe.per_metre[a];
      values.push_back(strain);
      continue;
    }
    const auto& of = probe.kind == TransientProbe::Kind::displacement ? displacement : velocity;
    for (int a = 0; a < Dim; ++a) values.push_back(of(probe.particle, a));
  }
  return values;
}

#define PERIMODE_PROBES(D)                                                                                  \
  template std::vector<PlacedProbe<D>> place_probes<D>(const Body<D>&, const std::vector<TransientProbe>&); \
  template std::vector<double> read_probes<D>(const std::vector<PlacedProbe<D>>&,                           \
                                              const std::function<double(Index, int)>&,                     \
                                              const std::function<double(Index, int)>&)
PERIMODE_PROBES(1);
PERIMODE_PROBES(2);
PERIMODE_PROBES(3);
#undef PERIMODE_PROBES

}  // namespace perimode
