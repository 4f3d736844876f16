// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include "perimode/statics/static.hpp"
#include "support/models.hpp"

namespace perimode::test {

/// Gives all components of the particles that lie within `layers` of a face of the grid the displacement
/// field(x), and leaves the others free.
template <int Dim, class Field>
void hold_outer_layers(Body<Dim>& body, int layers, Field&& field) {
  const Grid<Dim>& grid = *body.particles.grid;
  BoundaryMap<Dim>& map = body.boundary;
  map.free = 0;
  for (Index i = 0; i < body.count(); ++i) {
    const auto cell = grid.cell(body.particles.cell[i]);
    bool outer = false;
    for (int a = 0; a < Dim; ++a) outer = outer || cell[a] < layers || cell[a] >= grid.cells[a] - layers;
    const Point<Dim> u = field(body.particles.position[i]);
    for (int a = 0; a < Dim; ++a) {
      map.given[static_cast<std::size_t>(i) * Dim + a] = outer ? u[a] : 0.0;
      map.free_number[static_cast<std::size_t>(i) * Dim + a] = outer ? -1 : map.free++;
    }
  }
}

template <int Dim>
StaticResult solve_held(const Body<Dim>& body, StaticSolver solver = StaticSolver::automatic) {
  StaticOptions options;
  options.solver = solver;
  options.tolerance = 1e-12;
  StaticResult result = solve_static(body, {}, options);
  EXPECT_EQ(result.status, StaticStatus::converged) << result.message;
  return result;
}

}  // namespace perimode::test
