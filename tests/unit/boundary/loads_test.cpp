// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/boundary/loads.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "perimode/assembly/body.hpp"
#include "support/models.hpp"

namespace perimode {
namespace {

using test::box_model;

Region face(int axis, bool upper, int layers) { return {FaceRegion{{axis, upper}, layers, 0.0}, {}}; }
Region ball(Coordinates centre, double radius) { return {BallRegion{std::move(centre), radius}, {}}; }

template <int Dim>
Point<Dim> sum(const Eigen::VectorXd& force) {
  Point<Dim> total = Point<Dim>::Zero();
  for (Eigen::Index d = 0; d < force.size(); ++d) total[d % Dim] += force[d];
  return total;
}

TEST(Loads, ATractionSpreadsItsForceOverItsLayers) {
  Model m = box_model({8, 5}, 0.1, 2.0);
  m.thickness = 0.25;
  const auto particles = build_body<2>(m).particles;
  for (int layers : {1, 2, 5}) {
    const Eigen::VectorXd f = load_vector(particles, {{Traction{{3.0, -7.0}}, face(1, true, layers)}});
    const double area = 0.8 * 0.25;
    EXPECT_NEAR(sum<2>(f)[0], 3.0 * area, 1e-14);
    EXPECT_NEAR(sum<2>(f)[1], -7.0 * area, 1e-14);
    for (Index i = 0; i < particles.count(); ++i) {
      const bool inside = particles.position[i][1] > 0.5 - 0.1 * layers;
      EXPECT_NEAR(f[2 * i], inside ? 3.0 * area / (8 * layers) : 0.0, 1e-15);
    }
  }
}

TEST(Loads, ATractionOnABarAndOnABlockIsForcePerArea) {
  Model bar = box_model({10}, 0.1, 2.0);
  bar.area = 1e-4;
  const Eigen::VectorXd f = load_vector(build_body<1>(bar).particles, {{Traction{{5.0}}, face(0, false, 3)}});
  EXPECT_NEAR(f.sum(), 5.0 * 1e-4, 1e-18);
  const auto block = build_body<3>(box_model({4, 3, 2}, 0.5, 1.0)).particles;
  const Eigen::VectorXd g = load_vector(block, {{Traction{{0.0, 2.0, 0.0}}, face(0, true, 1)}});
  EXPECT_NEAR(sum<3>(g)[1], 2.0 * 1.5 * 1.0, 1e-14);
}

TEST(Loads, ACloudTakesTheDepthOfItsFace) {
  Particles<2> cloud;
  for (double x : {0.0, 0.05, 0.3}) {
    cloud.position.emplace_back(x, 0.0);
    cloud.volume.push_back(0.01 * (1.0 + x));
    cloud.block.push_back(0);
  }
  const Region at{FaceRegion{{0, false}, 0, 0.1}, {}};
  const Eigen::VectorXd f = load_vector(cloud, {{Traction{{4.0, 0.0}}, at}});
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(f[2 * i], i < 2 ? 40.0 * cloud.volume[i] : 0.0, 1e-15);
}

TEST(Loads, ABodyForceActsOnVolumeAndATotalForceIsSharedByIt) {
  Model m = box_model({6, 6}, 1.0, 2.0);
  const auto particles = build_body<2>(m).particles;
  const Eigen::VectorXd everywhere = load_vector(particles, {{BodyForce{{0.0, -2.0}}}});
  for (Index i = 0; i < particles.count(); ++i) EXPECT_EQ(everywhere[2 * i + 1], -2.0);
  Particles<2> uneven = particles;
  for (Index i = 0; i < uneven.count(); ++i) uneven.volume[i] = 1.0 + i;
  const Region at = ball({3.0, 3.0}, 1.0);
  const auto here = select(at, uneven);
  double volume = 0.0;
  for (Index i : here) volume += uneven.volume[i];
  const Eigen::VectorXd shared = load_vector(uneven, {{TotalForce{{8.0, 0.0}}, at}});
  EXPECT_NEAR(shared.sum(), 8.0, 1e-14);
  for (Index i : here) EXPECT_NEAR(shared[2 * i], 8.0 * uneven.volume[i] / volume, 1e-14);
}

TEST(Loads, LoadsAddUp) {
  const auto particles = build_body<2>(box_model({4, 4}, 1.0, 2.0)).particles;
  const std::vector<Load> loads = {{BodyForce{{1.0, 0.0}}}, {TotalForce{{0.0, 3.0}}, face(1, false, 1)}};
  const Eigen::VectorXd together = load_vector(particles, loads);
  const Eigen::VectorXd apart = load_vector(particles, {loads[0]}) + load_vector(particles, {loads[1]});
  EXPECT_EQ(together, apart);
}

TEST(Loads, WhatDoesNotFitTheBodyIsAnError) {
  const auto particles = build_body<2>(box_model({4, 4}, 1.0, 2.0)).particles;
  const auto says = [&](const Load& load, const char* words) {
    try {
      (void)load_vector(particles, {load});
      ADD_FAILURE() << "no error: " << words;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
      EXPECT_THAT(error.what(), testing::HasSubstr(words));
    }
  };
  says({Traction{{1.0, 0.0}}, ball({2.0, 2.0}, 1.0)}, "a traction on a face");
  says({Traction{{1.0, 0.0}}}, "a traction on a face");
  says({Traction{{1.0, 0.0}}, face(0, true, 5)}, "at most the 4 layers");
  says({BodyForce{{1.0, 0.0}}, ball({20.0, 2.0}, 1.0)}, "at least one particle");
  says({BodyForce{{1.0, 0.0, 0.0}}}, "body_force");
}

}  // namespace
}  // namespace perimode
