// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/boundary/boundary_map.hpp"

#include <gtest/gtest.h>

#include "perimode/assembly/body.hpp"
#include "perimode/assembly/operators.hpp"
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
  test::add_surface_nodes(m, 0, false, {"0.5"});
  const auto body = build_body<1>(m);
  ASSERT_EQ(body.boundary.image.size(), 3U);
  for (int g = 0; g < 3; ++g) {
    const int f = 2 - g;
    EXPECT_EQ(body.boundary.image[g], 0);
    EXPECT_NEAR(body.boundary.coefficient[g], -(2.0 * f + 1.0), 1e-12);
    EXPECT_NEAR(body.boundary.value[g], (2.0 * f + 2.0) * 0.5, 1e-12);
  }
}

/// Every ghost of a body whose particles move as u = h x, against h x of the ghost. Extrapolation multiplies
/// round-off by 1 + 2 ratio.
template <int Dim>
void expect_linear(const Model& model, const Eigen::Matrix<double, Dim, Dim>& h) {
  const auto body = build_body<Dim>(model);
  const auto& ghosts = std::get<GridBonds<Dim>>(body.bonds).ghosts;
  ASSERT_FALSE(ghosts.empty());
  Eigen::VectorXd u(body.count() * Dim);
  for (Index i = 0; i < body.count(); ++i) u.segment<Dim>(i * Dim) = h * body.particles.position[i];
  const double size = u.cwiseAbs().maxCoeff();
  for (std::size_t g = 0; g < ghosts.size(); ++g) {
    const Point<Dim> found =
        partner_displacement(body.boundary, u.data(), body.count() + static_cast<Index>(g), body.count());
    EXPECT_LE((found - h * ghosts[g].position).cwiseAbs().maxCoeff(), 1e-13 * size) << g;
  }
}

template <int Dim>
Eigen::Matrix<double, Dim, Dim> some_gradient() {
  Eigen::Matrix<double, Dim, Dim> h;
  for (int a = 0; a < Dim; ++a) {
    for (int b = 0; b < Dim; ++b) h(a, b) = 2.0 - a + 3.0 * b * a - 1.5 * b;
  }
  return h;
}

TEST(BoundaryMap, SurfaceNodesLetALinearFieldThrough) {
  for (int ratio : {2, 3, 4}) {
    const auto check = [&]<int Dim>(const std::vector<int>& cells) {
      const auto h = some_gradient<Dim>();
      Model m = box_model(cells, 0.1, ratio);
      m.volume_correction = VolumeCorrection::linear;
      for (int a = 0; a < Dim; ++a) {
        for (bool upper : {false, true}) test::add_surface_nodes(m, a, upper, test::linear_field<Dim>(h));
      }
      expect_linear<Dim>(m, h);
    };
    check.operator()<1>({9});
    check.operator()<2>({9, 5});
    check.operator()<3>({5, 7, 6});
  }
}

TEST(BoundaryMap, SurfaceNodesBesideOtherWallsAndPeriodicAxes) {
  // Mirrors at y-, z+: no normal displacement and no shear there. Odd walls at y+ would need u = 0.
  Eigen::Matrix3d h = Eigen::Vector3d(1.0, -2.0, 3.0).asDiagonal();
  Model m = box_model({6, 5, 7}, 0.1, 3.0);
  std::get<GridSpec>(m.particles).lower = {0.0, 0.0, -0.7};
  std::get<GridSpec>(m.particles).upper = {0.6, 0.5, 0.0};
  add_wall(m, 1, false, WallType::mirror);
  add_wall(m, 2, true, WallType::mirror);
  for (const auto& [axis, upper] : {std::pair{0, false}, {0, true}, {1, true}, {2, false}})
    test::add_surface_nodes(m, axis, upper, test::linear_field<3>(h));
  expect_linear<3>(m, h);

  Eigen::Matrix2d along = Eigen::Matrix2d::Zero();
  along(0, 0) = 1.5;
  along(1, 0) = -0.5;
  Model wrapped = box_model({5, 2}, 0.1, 3.0);  // images in y of images
  wrapped.periodic[1] = true;
  for (bool upper : {false, true}) test::add_surface_nodes(wrapped, 0, upper, test::linear_field<2>(along));
  expect_linear<2>(wrapped, along);
}

TEST(BoundaryMap, SurfaceNodesBehindAHoleTakeTheNextParticle) {
  Model m = box_model({6, 4}, 1.0, 2.0);
  std::get<GridSpec>(m.particles).remove.push_back(Region{NearestRegion{{0.5, 1.5}}, {}});
  test::add_surface_nodes(m, 0, false, {"y", "0"});
  const auto body = build_body<2>(m);
  const auto& ghosts = std::get<GridBonds<2>>(body.bonds).ghosts;
  int found = 0;
  for (std::size_t g = 0; g < ghosts.size(); ++g) {
    EXPECT_NEAR(body.boundary.value[2 * g], (1.0 - body.boundary.coefficient[2 * g]) * ghosts[g].position[1],
                1e-14);
    const bool behind = std::abs(ghosts[g].position[1] - 1.5) < 0.1;
    if (!behind) continue;
    ++found;
    EXPECT_EQ(body.particles.position[body.boundary.image[g]], Point<2>(1.5, 1.5));
    EXPECT_NEAR(body.boundary.coefficient[2 * g], ghosts[g].position[0] / 1.5, 1e-14);
  }
  EXPECT_EQ(found, 1);  // the ghost of the hole is absent, that of the particle behind it is there
}

TEST(BoundaryMap, TheLastOfTwoSurfacesHoldsAtTheirEdge) {
  Model m = box_model({6, 6}, 1.0, 2.0);
  test::add_surface_nodes(m, 1, true, {"3", "4"});
  test::add_surface_nodes(m, 0, true, {"5", "6"});
  const auto body = build_body<2>(m);
  const auto& ghosts = std::get<GridBonds<2>>(body.bonds).ghosts;
  for (std::size_t g = 0; g < ghosts.size(); ++g) {
    const double share = body.boundary.value[2 * g] / (1.0 - body.boundary.coefficient[2 * g]);
    EXPECT_NEAR(share, ghosts[g].position[0] > 6.0 ? 5.0 : 3.0, 1e-14);
  }
}

/// Force through the face `side` of a bar whose particles move as u: outward tension is positive.
double force_through(const Body<1>& body, const Eigen::VectorXd& u, int side) {
  const auto& ghosts = std::get<GridBonds<1>>(body.bonds).ghosts;
  double force = 0.0;
  for (Index i = 0; i < body.count(); ++i) {
    for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<1>& end) {
      if (end.neighbour < body.count() || ghosts[end.neighbour - body.count()].crossings[side] == 0) return;
      const double other = partner_displacement(body.boundary, u.data(), end.neighbour, body.count())[0];
      force += bond_stiffness(body, i, end) * (other - u[i]);
    });
  }
  return side == 1 ? force : -force;
}

TEST(BoundaryMap, ASurfaceTractionIsTheForceThroughTheSurfaceWhateverTheBodyDoes) {
  for (int m : {1, 2, 3, 7}) {
    for (Calibration calibration : {Calibration::continuum, Calibration::discrete}) {
      Model bar = box_model({12}, 0.1, m);
      bar.area = 0.3;
      bar.material.micromodulus.kernel = Kernel::gaussian;
      bar.calibration = calibration;
      bar.volume_correction = VolumeCorrection::linear;
      test::add_surface_traction(bar, false, -0.25);
      test::add_surface_traction(bar, true, 0.5, {.kind = TimeFunction::Kind::ramp, .a = 4.0});
      const auto body = build_body<1>(bar);
      const Eigen::VectorXd u = Eigen::VectorXd::NullaryExpr(12, [](Eigen::Index i) {
        return std::sin(3.0 * static_cast<double>(i)) + 0.1 * static_cast<double>(i);
      });
      const double round_off = 1e-14 * stiffness_bound(body) * u.cwiseAbs().maxCoeff();
      EXPECT_NEAR(force_through(body, u, 0), -0.25 * 0.3, round_off);
      EXPECT_NEAR(force_through(body, u, 1), 0.5 * 0.3, round_off);
      Body<1> later = body;
      later.boundary = at_time(body.boundary, 1.0);
      EXPECT_NEAR(force_through(later, u, 0), -0.25 * 0.3, round_off);
      EXPECT_NEAR(force_through(later, u, 1), 0.5 * 0.3 / 4.0, round_off);
      // Surfaces without a given displacement hold nothing: a translation stays one beyond them.
      const Eigen::VectorXd ones = Eigen::VectorXd::Ones(12);
      for (Index g = 0; g < static_cast<Index>(body.boundary.image.size()); ++g)
        EXPECT_NEAR(partner_displacement(body.boundary, ones.data(), 12 + g, 12, false)[0], 1.0, 1e-13);
    }
  }
}

TEST(BoundaryMap, MatricesFollowSeveralParticles) {
  Model bar = box_model({8}, 0.1, 3.0);
  fix_face(bar, 0, false, 1, {0});
  bar.boundary.push_back({Prescribe{{{0, 0.5}}, Region{FaceRegion{{0, true}, 2, 0.0}, {}}}, {}});
  test::add_surface_traction(bar, true, 2.0);
  const auto body = build_body<1>(bar);
  const auto matrices = boundary_matrices(body.boundary);
  std::vector<double> q(body.boundary.free);
  for (std::size_t k = 0; k < q.size(); ++k) q[k] = 1.0 + 0.1 * static_cast<double>(k * k);
  std::vector<double> all(matrices.t.rows);
  multiply(matrices.t, q, all);
  for (std::size_t d = 0; d < all.size(); ++d) all[d] += matrices.g[d];
  const auto u = body.boundary.expand(q.data());
  for (Index p = 0; p < static_cast<Index>(all.size()); ++p)
    EXPECT_NEAR(all[p], partner_displacement(body.boundary, u.data(), p, 8)[0], 1e-13);
}

TEST(BoundaryMap, TimeFunctionsAreKeptOncePerFunction) {
  const TimeFunction ramp{.kind = TimeFunction::Kind::ramp, .a = 2.0};
  const TimeFunction step{.kind = TimeFunction::Kind::step, .a = 1.0};
  const auto layer = [](int axis, bool upper) { return Region{FaceRegion{{axis, upper}, 1, 0.0}, {}}; };
  Model m = box_model({6, 5}, 1.0, 2.0);
  m.boundary.push_back({Prescribe{{{0, 4.0}}, layer(1, false), ramp}, {}});
  m.boundary.push_back({Prescribe{{{1, 8.0}}, layer(1, false)}, {}});
  test::add_surface_nodes(m, 0, false, {"1", "2"}, step);
  test::add_surface_nodes(m, 0, true, {"1", "2"}, ramp);
  fix_face(m, 0, false, 1, {0});
  const auto map = build_body<2>(m).boundary;
  ASSERT_EQ(map.time.size(), 3U);
  EXPECT_TRUE(same(map.time[0], TimeFunction{}));
  EXPECT_TRUE(same(map.time[1], ramp));
  EXPECT_TRUE(same(map.time[2], step));
  ASSERT_EQ(map.given_time.size(), map.given.size());
  ASSERT_EQ(map.value_time.size(), map.image.size());
  EXPECT_EQ(map.given_time[0], 0);  // the corner is fixed in x
  EXPECT_EQ(map.given_time[2], 1);
  EXPECT_EQ(map.given_time[3], 0);
  EXPECT_EQ(map.given[3], 8.0);

  const auto early = at_time(map, 0.5);
  EXPECT_EQ(early.given[2], 1.0);  // 4 m times 0.5 / 2
  EXPECT_EQ(early.given[3], 8.0);
  BoundaryMap<2> sum = with_only(map, 0);
  for (int k = 0; k < 3; ++k) {
    const auto part = with_only(map, k);
    const double h = value_at(map.time[static_cast<std::size_t>(k)], 0.5);
    for (std::size_t d = 0; d < sum.given.size(); ++d) sum.given[d] += k == 0 ? 0.0 : h * part.given[d];
    for (std::size_t v = 0; v < sum.value.size(); ++v) sum.value[v] += k == 0 ? 0.0 : h * part.value[v];
  }
  EXPECT_EQ(sum.given, early.given);
  EXPECT_EQ(sum.value, early.value);
  EXPECT_EQ(early.value[0], 0.0);  // beyond x-, before the step
  EXPECT_TRUE(build_body<2>(box_model({4, 4}, 1.0, 2.0)).boundary.given_time.empty());
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

  Model thin = box_model({8, 2}, 1.0, 3.0);  // behind its corner no particle lies deep enough
  add_walls(thin, 1, WallType::surface_nodes);
  EXPECT_NO_THROW((void)build_body<2>(thin));
  add_wall(thin, 0, true, WallType::surface_nodes);
  EXPECT_THROW((void)build_body<2>(thin), Error);

  Model plate_traction = box_model({8, 8}, 1.0, 2.0);
  test::add_surface_traction(plate_traction, true, 1.0);
  EXPECT_THROW((void)build_body<2>(plate_traction), Error);

  Model short_bar = box_model({3}, 1.0, 4.0);
  test::add_surface_traction(short_bar, true, 1.0);
  EXPECT_THROW((void)build_body<1>(short_bar), Error);

  Model components = box_model({8, 8}, 1.0, 2.0);
  test::add_surface_nodes(components, 0, true, {"0", "0", "0"});
  EXPECT_THROW((void)build_body<2>(components), Error);

  Model nowhere = box_model({8, 8}, 1.0, 2.0);
  nowhere.boundary.push_back({Fix{{0}, Region{BallRegion{{100.0, 100.0}, 0.1}, {}}}, {}});
  EXPECT_THROW((void)build_body<2>(nowhere), Error);

  Model component = box_model({8, 8}, 1.0, 2.0);
  fix_face(component, 0, false, 1, {2});
  EXPECT_THROW((void)build_body<2>(component), Error);
}

}  // namespace
}  // namespace perimode
