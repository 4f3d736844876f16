// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "perimode/assembly/body.hpp"

namespace perimode {

namespace {

template <class T>
double bytes_of(const std::vector<T>& v) {
  return static_cast<double>(v.size() * sizeof(T));
}

}  // namespace

template <int Dim>
double horizons_long(const Body<Dim>& body) {
  Point<Dim> low = body.particles.position.front();
  Point<Dim> high = low;
  for (const auto& x : body.particles.position) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  double horizon = 0.0;
  if (const auto* grid = std::get_if<GridBonds<Dim>>(&body.bonds)) {
    horizon = grid->family.horizon;
  } else {
    for (double h : std::get<CloudBonds<Dim>>(body.bonds).horizon) horizon = std::max(horizon, h);
  }
  return horizon > 0.0 ? (high - low).maxCoeff() / horizon : 0.0;
}

template <int Dim>
double body_bytes(const Body<Dim>& body) {
  const auto& p = body.particles;
  const auto& b = body.boundary;
  double bytes = bytes_of(p.position) + bytes_of(p.volume) + bytes_of(p.block) + bytes_of(p.cell) +
                 bytes_of(b.free_number) + bytes_of(b.given) + bytes_of(b.image) + bytes_of(b.coefficient) +
                 bytes_of(b.value) + bytes_of(b.given_time) + bytes_of(b.value_time) +
                 bytes_of(body.constants.factor) + bytes_of(body.constants.kernel_of_end);
  if (const auto* grid = std::get_if<GridBonds<Dim>>(&body.bonds)) {
    return bytes + bytes_of(grid->occupant) + bytes_of(grid->home) + bytes_of(grid->ghosts) +
           bytes_of(grid->alive);
  }
  const auto& cloud = std::get<CloudBonds<Dim>>(body.bonds);
  constexpr double search = 20.0;  // per bond end, while neighbours are searched
  return bytes + bytes_of(cloud.start) + bytes_of(cloud.neighbour) + bytes_of(cloud.xi) +
         bytes_of(cloud.weight) + bytes_of(cloud.horizon) + bytes_of(cloud.alive) +
         search * static_cast<double>(cloud.neighbour.size());
}

double least_body_bytes(const Model& model) {
  const BodySize size = estimate_size(model);
  // Positions, volumes, maps, the alive bits, and some ten vectors.
  return size.particles * (28.0 + 28.0 * model.dimension + size.family / 8.0 + 80.0 * model.dimension);
}

template double body_bytes<1>(const Body<1>&);
template double horizons_long<1>(const Body<1>&);
template double body_bytes<2>(const Body<2>&);
template double horizons_long<2>(const Body<2>&);
template double body_bytes<3>(const Body<3>&);
template double horizons_long<3>(const Body<3>&);

}  // namespace perimode
