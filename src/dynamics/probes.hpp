// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "perimode/dynamics/transient.hpp"

namespace perimode {

/// A probe whose particles are known.
template <int Dim>
struct PlacedProbe {
  TransientProbe::Kind kind = TransientProbe::Kind::displacement;
  Index particle = 0;
  Index other = 0;                            ///< strain
  Point<Dim> per_metre = Point<Dim>::Zero();  ///< strain: (x_b - x_a)/|x_b - x_a|^2, 1/m
};

/// Throws invalid_input: a point outside the body, a strain between one and the same particle.
template <int Dim>
[[nodiscard]] std::vector<PlacedProbe<Dim>> place_probes(const Body<Dim>& body,
                                                         const std::vector<TransientProbe>& probes);

/// What the probes show; displacement and velocity are of a dof of a particle.
template <int Dim>
[[nodiscard]] std::vector<double> read_probes(
    const std::vector<PlacedProbe<Dim>>& probes,
    const std::function<double(Index particle, int a)>& displacement,
    const std::function<double(Index particle, int a)>& velocity);

}  // namespace perimode
