// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/fracture/griffith.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "perimode/assembly/critical_stretches.hpp"
#include "perimode/assembly/precracks.hpp"
#include "perimode/bonds/crossing.hpp"

namespace perimode {

namespace {

Crack<2> longer(const Crack<2>& crack, double by) {
  const Point<2> direction = (crack.corner[1] - crack.corner[0]).normalized();
  return {{crack.corner[1], crack.corner[1] + by * direction}, {true, false}};
}

Crack<3> longer(const Crack<3>& crack, double by) {
  const auto& c = crack.corner;
  const Point<3> first = (c[1] - c[0]).normalized();
  std::size_t far = 1;
  double furthest = 0.0;
  for (std::size_t k = 1; k < c.size(); ++k) {
    const Point<3> middle = 0.5 * (c[k] + c[(k + 1) % c.size()]) - c[0];
    const double distance = (middle - first.dot(middle) * first).norm();
    if (distance <= furthest * (1.0 + 1e-9)) continue;
    furthest = distance;
    far = k;
  }
  // The corners turn counter-clockwise about the normal, so outward is on the right of an edge.
  Point<3> normal = Point<3>::Zero();
  for (std::size_t k = 0; k < c.size(); ++k) normal += c[k].cross(c[(k + 1) % c.size()]);
  const Point<3>& p = c[far];
  const Point<3>& q = c[(far + 1) % c.size()];
  const Point<3> out = by * (q - p).cross(normal).normalized();
  return {{q, p, p + out, q + out}, {true, false, false, false}};
}

}  // namespace

template <int Dim>
Crack<Dim> crack_increment(const Model& model, const Body<Dim>& body, double spacings) {
  const auto cracks = precracks<Dim>(model);
  if (cracks.empty() || Dim == 1) {
    invalid_input({"a pre-crack that can grow longer, in 2D or 3D",
                   cracks.empty() ? "no pre-crack" : "one of a bar", "add one to body.precracks",
                   cracks.empty() ? model.where : model.precracks[0].where});
  }
  if constexpr (Dim > 1) return longer(cracks[0], spacings * typical_spacing(body.particles, body.section));
  return cracks[0];
}

template <int Dim>
double extent(const Crack<Dim>& crack) {
  const auto& c = crack.corner;
  if constexpr (Dim == 2) return (c[1] - c[0]).norm();
  if constexpr (Dim == 3) {
    Point<3> twice = Point<3>::Zero();
    for (std::size_t k = 1; k + 1 < c.size(); ++k) twice += (c[k] - c[0]).cross(c[k + 1] - c[0]);
    return 0.5 * twice.norm();
  }
  return 1.0;
}

template <int Dim>
std::vector<BondRef> crossing_bonds(const Body<Dim>& body, const Crack<Dim>& crack) {
  std::vector<BondRef> bonds;
  for (const CrossingEnd& end :
       crossing_ends<Dim>(body.bonds, body.particles, {crack}, typical_spacing(body.particles, body.section)))
    bonds.push_back({end.particle, end.slot});
  return with_images(body, std::move(bonds));
}

template <int Dim>
double fracture_energy_of(const Model& model, const Body<Dim>& body) {
  const auto stretches = critical_stretches(model, body);
  for (std::size_t block = 0; block < stretches.size(); ++block) {
    const auto& blocks = body.particles.block;
    const bool empty = std::find(blocks.begin(), blocks.end(), static_cast<int>(block)) == blocks.end();
    if (empty || !std::isfinite(stretches[block])) continue;
    const auto own = model.block_materials.find(body.particles.block_names[block]);
    const Material& m = own == model.block_materials.end() ? model.material : own->second;
    if (m.fracture_energy) return *m.fracture_energy;
    return fracture_energy_at(m, body, static_cast<int>(block), stretches[block],
                              {Dim, model.plane, body.section});
  }
  invalid_input({"a material that can break", "neither fracture_energy nor critical_stretch",
                 "give one of them", model.material.where});
}

#define PERIMODE_GRIFFITH(D)                                                        \
  template Crack<D> crack_increment<D>(const Model&, const Body<D>&, double);       \
  template double extent<D>(const Crack<D>&);                                       \
  template std::vector<BondRef> crossing_bonds<D>(const Body<D>&, const Crack<D>&); \
  template double fracture_energy_of<D>(const Model&, const Body<D>&)
PERIMODE_GRIFFITH(1);
PERIMODE_GRIFFITH(2);
PERIMODE_GRIFFITH(3);
#undef PERIMODE_GRIFFITH

}  // namespace perimode
