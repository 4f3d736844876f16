// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "perimode/dynamics/central_difference.hpp"
#include "perimode/dynamics/transient.hpp"
#include "support/models.hpp"

namespace perimode {
namespace {

/// A free bar pulled at both ends: what surfaces of a given traction bring in is all that moves it, so
/// central differences hold M v = A sum of the tractions by the trapezium rule, to round-off.
TEST(SurfaceTraction, ItsImpulseIsTheMomentumOfAFreeBar) {
  Model model = test::box_model({200}, 0.01, 3.0);
  model.area = 0.5;
  model.volume_correction = VolumeCorrection::linear;
  const TimeFunction pull{.kind = TimeFunction::Kind::half_sine, .a = 0.8};
  const TimeFunction step{.kind = TimeFunction::Kind::step, .a = 0.3};
  test::add_surface_traction(model, true, 3.0, pull);
  test::add_surface_traction(model, false, 0.7, step);
  const auto body = build_body<1>(model);
  const Motion motion = make_motion(body, {});
  EXPECT_FALSE(motion.symmetric);
  const double dt = 0.004;
  const auto run = central_difference(motion, dt);
  run->start(Eigen::VectorXd::Zero(200), Eigen::VectorXd::Zero(200));
  const auto force = [&](int n) {
    return 0.5 * (3.0 * value_at(pull, n * dt) - 0.7 * value_at(step, n * dt));
  };
  double impulse = 0.0, largest = 0.0;
  for (int n = 1; n <= 600; ++n) {
    run->advance(false);
    impulse += 0.5 * dt * (force(n - 1) + force(n));
    largest = std::max(largest, std::abs(impulse));
    EXPECT_NEAR(motion.mass.dot(run->velocity()), impulse, 1e-11 * largest) << n;
  }
}

/// Until the reflection comes back the pulled end of a long bar (E = rho = c = 1) moves by the impulse per
/// area.
TEST(SurfaceTraction, APulledEndMovesAsInAnEndlessBar) {
  Model model = test::box_model({400}, 0.005, 3.0);
  model.volume_correction = VolumeCorrection::linear;
  test::add_surface_nodes(model, 0, false);
  test::add_surface_traction(model, true, 1e-3, {.kind = TimeFunction::Kind::half_sine, .a = 1.0});
  const auto body = build_body<1>(model);
  const Motion motion = make_motion(body, {});
  const auto run = central_difference(motion, 0.002);
  run->start(Eigen::VectorXd::Zero(400), Eigen::VectorXd::Zero(400));
  for (int n = 0; n < 750; ++n) run->advance(false);
  // 2 T / pi times 1e-3; dispersion is of the order of (horizon / wave length)^2.
  EXPECT_NEAR(run->displacement()[399], 2e-3 / 3.14159265358979323846, 1e-3 * 2e-3);
}

}  // namespace
}  // namespace perimode
