// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/boundary/boundary_map.hpp"

#include <gtest/gtest.h>

#include "perimode/assembly/body.hpp"
#include "support/models.hpp"

namespace perimode {
namespace {

using test::add_wall;
using test::add_walls;
using test::box_model;
using test::fix_face;

/// Displacement of every ghost for a linear field of the particles.
template <int Dim>
void expect_reflection(WallType type, const std::array<double, 2>& normal_tangential) {
  Model m = box_model(std::vector<int>(Dim, 6), 1.0, 2.0);
  add_wall(m, 0, false, type);
  const auto body = build_body<Dim>(m);
  const auto& ghosts = std::get<GridBonds<Dim>>(body.bonds).ghosts;
  ASSERT_FALSE(ghosts.empty());
  for (std::size_t g = 0; g < ghosts.size(); ++g) {
    for (int a = 0; a < Dim; ++a) {
      EXPECT_EQ(body.boundary.coefficient[g * Dim + a], normal_tangential[a == 0 ? 0 : 1]);
      EXPECT_EQ(body.boundary.value[g * Dim + a], 0.0);
    }
  }
}

TEST(BoundaryMap, WallsReflectComponentsAsTheirTypeSays) {
  expect_reflection<2>(WallType::odd, {-1, -1});
  expect_reflection<2>(WallType::even, {1, 1});
  expect_reflection<3>(WallType::mirror, {-1, 1});
  expect_reflection<3>(WallType::antimirror, {1, -1});
  expect_reflection<2>(WallType::zero_layer, {0, 0});
}

TEST(BoundaryMap, CornersReflectTwice) {
  Model m = box_model({6, 6}, 1.0, 2.0);
  add_wall(m, 0, false, WallType::mirror);
  add_wall(m, 1, false, WallType::mirror);
  const auto body = build_body<2>(m);
  const auto& ghosts = std::get<GridBonds<2>>(body.bonds).ghosts;
  for (std::size_t g = 0; g < ghosts.size(); ++g) {
    const bool corner = ghosts[g].position[0] < 0 && ghosts[g].position[1] < 0;
    if (!corner) continue;
    EXPECT_EQ(body.boundary.coefficient[2 * g], -1.0);
    EXPECT_EQ(body.boundary.coefficient[2 * g + 1], -1.0);
  }
}

TEST(BoundaryMap, SurfaceNodesExtrapolateThroughTheSurface) {
  // [scabbia2023]: u_{-(f+1/2)} = -(2f+1) u_0 + (2f+2) u_s for cells centred half a spacing off the surface.
  Model m = box_model({10}, 0.1, 3.0);
  m.boundary.push_back({Wall{{0, false}, WallType::surface_nodes, {0.5}}, {}});
  const auto body = build_body<1>(m);
  ASSERT_EQ(body.boundary.image.size(), 3U);
  for (int g = 0; g < 3; ++g) {
    const int f = 2 - g;
    EXPECT_EQ(body.boundary.image[g], 0);
    EXPECT_NEAR(body.boundary.coefficient[g], -(2.0 * f + 1.0), 1e-12);
    EXPECT_NEAR(body.boundary.value[g], (2.0 * f + 2.0) * 0.5, 1e-12);
  }
}

TEST(BoundaryMap, MatricesReproduceTheMap) {
  Model m = box_model({7, 5}, 1.0, 2.0);
  add_wall(m, 0, false, WallType::odd);
  add_wall(m, 0, true, WallType::antimirror);
  fix_face(m, 1, false, 1, {0});
  m.boundary.push_back({Prescribe{{{1, 0.25}}, Region{FaceRegion{{1, true}, 1, 0.0}, {}}}, {}});
  const auto body = build_body<2>(m);
  const auto matrices = boundary_matrices(body.boundary);
  std::vector<double> q(body.boundary.free);
  for (std::size_t k = 0; k < q.size(); ++k) q[k] = 1.0 + 0.1 * static_cast<double>(k);
  std::vector<double> all(matrices.t.rows);
  multiply(matrices.t, q, all);
  for (std::size_t d = 0; d < all.size(); ++d) all[d] += matrices.g[d];
  const auto particles = body.boundary.expand(q.data());
  for (std::size_t d = 0; d < particles.size(); ++d) EXPECT_EQ(all[d], particles[d]);
  for (std::size_t g = 0; g < body.boundary.image.size(); ++g) {
    for (int a = 0; a < 2; ++a) {
      const double expected =
          body.boundary.coefficient[2 * g + a] * particles[2 * body.boundary.image[g] + a];
      EXPECT_EQ(all[particles.size() + 2 * g + a], expected);
    }
  }
  std::vector<double> picked(matrices.r.rows);
  multiply(matrices.r, all, picked);
  EXPECT_EQ(picked, q);
}

TEST(BoundaryMap, FixOutlastsPrescribe) {
  Model m = box_model({5}, 1.0, 1.0);
  fix_face(m, 0, false, 1, {0});
  m.boundary.push_back({Prescribe{{{0, 2.0}}, Region{FaceRegion{{0, false}, 2, 0.0}, {}}}, {}});
  const auto body = build_body<1>(m);
  EXPECT_EQ(body.boundary.given[0], 0.0);
  EXPECT_EQ(body.boundary.given[1], 2.0);
  EXPECT_EQ(body.boundary.free, 3);
}

TEST(BoundaryMap, ContradictionsAreErrors) {
  Model periodic_wall = box_model({8, 8}, 1.0, 2.0);
  periodic_wall.periodic[0] = true;
  add_wall(periodic_wall, 0, true, WallType::odd);
  EXPECT_THROW((void)build_body<2>(periodic_wall), Error);

  Model twice = box_model({8, 8}, 1.0, 2.0);
  add_wall(twice, 0, true, WallType::odd);
  add_wall(twice, 0, true, WallType::even);
  EXPECT_THROW((void)build_body<2>(twice), Error);

  Model plane_nodes = box_model({8, 8}, 1.0, 2.0);
  add_wall(plane_nodes, 0, true, WallType::surface_nodes);
  EXPECT_THROW((void)build_body<2>(plane_nodes), Error);

  Model nowhere = box_model({8, 8}, 1.0, 2.0);
  nowhere.boundary.push_back({Fix{{0}, Region{BallRegion{{100.0, 100.0}, 0.1}, {}}}, {}});
  EXPECT_THROW((void)build_body<2>(nowhere), Error);

  Model component = box_model({8, 8}, 1.0, 2.0);
  fix_face(component, 0, false, 1, {2});
  EXPECT_THROW((void)build_body<2>(component), Error);
}

}  // namespace
}  // namespace perimode
