// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/boundary/loads.hpp"

#include <fmt/format.h>

#include <numeric>

namespace perimode {

namespace {

template <int Dim>
std::vector<Index> loaded(const Particles<Dim>& particles, const Load& load) {
  if (!load.at) {
    std::vector<Index> all(static_cast<std::size_t>(particles.count()));
    std::iota(all.begin(), all.end(), Index{0});
    return all;
  }
  std::vector<Index> here = select(*load.at, particles);
  if (here.empty()) {
    invalid_input({"a region that holds at least one particle", "none", "move or enlarge the region",
                   load.at->where.line > 0 ? load.at->where : load.where});
  }
  return here;
}

/// How deep below its face a traction acts, m.
template <int Dim>
double depth_of(const Particles<Dim>& particles, const Load& load) {
  const auto* face = load.at ? std::get_if<FaceRegion>(&load.at->shape) : nullptr;
  if (face == nullptr) {
    invalid_input({"a traction on a face", load.at ? "another region" : "no region",
                   "write at: { face: y+, layers: 1 }, or give a body_force or a force",
                   load.at ? load.at->where : load.where});
  }
  if (!particles.grid) return face->depth;
  const Index layers = particles.grid->cells[static_cast<std::size_t>(face->face.axis)];
  if (face->layers > layers) {
    invalid_input({fmt::format("at most the {} layers of the body", layers), fmt::format("{}", face->layers),
                   "a traction usually acts on one layer", load.at->where});
  }
  return face->layers * particles.grid->spacing;
}

}  // namespace

template <int Dim>
Eigen::VectorXd load_vector(const Particles<Dim>& particles, const std::vector<Load>& loads) {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(particles.count()) * Dim);
  for (const Load& load : loads) {
    const std::vector<Index> here = loaded(particles, load);
    Point<Dim> density;  // N/m3
    if (const auto* traction = std::get_if<Traction>(&load.what)) {
      density = to_point<Dim>(traction->value, "traction", load.where) / depth_of(particles, load);
    } else if (const auto* body_force = std::get_if<BodyForce>(&load.what)) {
      density = to_point<Dim>(body_force->value, "body_force", load.where);
    } else {
      double volume = 0.0;
      for (Index i : here) volume += particles.volume[static_cast<std::size_t>(i)];
      density = to_point<Dim>(std::get<TotalForce>(load.what).value, "force", load.where) / volume;
    }
    for (Index i : here) {
      force.segment<Dim>(static_cast<Eigen::Index>(i) * Dim) +=
          density * particles.volume[static_cast<std::size_t>(i)];
    }
  }
  return force;
}

template Eigen::VectorXd load_vector<1>(const Particles<1>&, const std::vector<Load>&);
template Eigen::VectorXd load_vector<2>(const Particles<2>&, const std::vector<Load>&);
template Eigen::VectorXd load_vector<3>(const Particles<3>&, const std::vector<Load>&);

}  // namespace perimode
