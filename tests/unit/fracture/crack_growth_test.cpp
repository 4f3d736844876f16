// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/fracture/crack_growth.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/models.hpp"

namespace perimode {
namespace {

using test::add_crack;
using test::add_wall;
using test::box_model;
using test::fix_face;

ModalOptions lowest(int modes) {
  ModalOptions options;
  options.modes = modes;
  options.solver = ModalSolver::lanczos;
  return options;
}

/// The model at a fraction of its cracks' growth as a case of its own.
template <int Dim>
Model at_fraction(Model m, double fraction) {
  const auto cracks = grown_precracks<Dim>(m, fraction);
  m.precracks.clear();
  for (const auto& crack : cracks) {
    std::vector<Coordinates> points;
    points.reserve(crack.corner.size());
    for (const auto& corner : crack.corner) points.emplace_back(corner.begin(), corner.end());
    add_crack(m, points);
  }
  return m;
}

/// Updated and fresh factors give the frequencies of a body of its own at every length: to 1e-9, the
/// tolerance of the iteration being 1e-10 in eigenvalues.
template <int Dim>
void expect_growth(const Model& model, int n, int modes) {
  for (const auto way : {GrowthFactor::updated, GrowthFactor::fresh, GrowthFactor::automatic}) {
    const CrackGrowthResult grown = crack_growth_modes<Dim>(model, lowest(modes), n, way);
    ASSERT_TRUE(grown.converged) << grown.message;
    ASSERT_EQ(grown.steps.size(), static_cast<std::size_t>(n) + 1);
    for (int k = 0; k <= n; ++k) {
      const CrackGrowthStep& step = grown.steps[static_cast<std::size_t>(k)];
      Model alone = model;
      alone.precracks.clear();
      if (k > 0) alone = at_fraction<Dim>(model, step.fraction);
      const auto body = build_body<Dim>(alone);
      const ModalResult expected = solve_modes(body, lowest(modes));
      EXPECT_EQ(step.cut, body.cut);
      EXPECT_EQ(step.fraction, static_cast<double>(k) / n);
      EXPECT_LT(step.residual, 1e-6);
      ASSERT_EQ(step.frequency.size(), static_cast<std::size_t>(modes));
      const double top = step.frequency.back();
      for (int m = 0; m < modes; ++m)
        EXPECT_NEAR(step.frequency[static_cast<std::size_t>(m)], expected.frequency_hz[m], 1e-9 * top)
            << "step " << k << ", mode " << m;
      if (way != GrowthFactor::automatic && k > 0) {
        EXPECT_EQ(step.factor, way);
      }
    }
  }
}

TEST(CrackGrowth, UpdatedFreshAndSeparateBodiesAgree) {
  Model clamped = box_model({40, 15}, 0.5, 3.0);
  fix_face(clamped, 0, false, 3, {0, 1});
  add_crack(clamped, {{8.0, 7.5}, {8.0, 2.0}});
  expect_growth<2>(clamped, 4, 6);

  Model free = box_model({36, 14}, 0.5, 3.0);  // rigid motions, two cracks, one slanted
  add_crack(free, {{9.0, 0.0}, {9.0, 4.0}});
  add_crack(free, {{3.0, 3.0}, {6.0, 5.0}});
  expect_growth<2>(free, 3, 8);

  Model parted = box_model({30, 12}, 0.5, 3.0);  // cut in two at last: one half is free
  fix_face(parted, 0, false, 3, {0, 1});
  add_crack(parted, {{7.5, 0.0}, {7.5, 6.0}});
  expect_growth<2>(parted, 3, 7);

  Model walled = box_model({30, 12}, 0.5, 3.0);
  add_wall(walled, 0, false, WallType::mirror);
  add_wall(walled, 0, true, WallType::antimirror);
  walled.calibration = Calibration::discrete;
  add_crack(walled, {{0.0, 3.0}, {6.0, 3.0}});
  expect_growth<2>(walled, 3, 6);

  Model solid = box_model({14, 7, 6}, 0.5, 2.0);
  fix_face(solid, 0, false, 2, {0, 1, 2});
  add_crack(solid, {{3.0, 0.0, 0.0}, {3.0, 3.5, 0.0}, {3.0, 3.5, 2.0}, {3.0, 0.0, 2.0}});
  expect_growth<3>(solid, 2, 6);
}

TEST(CrackGrowth, CalibrationAfterCracksIsMadeAnew) {
  Model m = box_model({30, 12}, 0.5, 3.0);
  fix_face(m, 0, false, 3, {0, 1});
  add_crack(m, {{7.5, 6.0}, {7.5, 2.0}});
  m.calibration = Calibration::discrete_cut;
  const auto grown = crack_growth_modes<2>(m, lowest(5), 2, GrowthFactor::updated);
  ASSERT_TRUE(grown.converged) << grown.message;
  for (const auto& step : grown.steps) EXPECT_EQ(step.factor, GrowthFactor::fresh);
  const auto expected = solve_modes(build_body<2>(m), lowest(5));
  for (int k = 0; k < 5; ++k)
    EXPECT_NEAR(grown.steps[2].frequency[static_cast<std::size_t>(k)], expected.frequency_hz[k],
                1e-9 * expected.frequency_hz[k]);
}

/// Bonds only ever take stiffness away.
TEST(CrackGrowth, FrequenciesFallAsTheCrackGrows) {
  Model m = box_model({40, 15}, 0.5, 3.0);
  fix_face(m, 0, false, 3, {0, 1});
  add_crack(m, {{8.0, 7.5}, {8.0, 2.0}});
  const auto grown = crack_growth_modes<2>(m, lowest(5), 8);
  EXPECT_EQ(grown.steps[0].crack_length, 0.0);
  EXPECT_NEAR(grown.steps[8].crack_length, 5.5, 1e-14);
  for (std::size_t k = 1; k < grown.steps.size(); ++k) {
    EXPECT_GT(grown.steps[k].cut, grown.steps[k - 1].cut);
    for (std::size_t mode = 0; mode < 5; ++mode)
      EXPECT_LE(grown.steps[k].frequency[mode], grown.steps[k - 1].frequency[mode] * (1.0 + 1e-9));
  }
}

TEST(CrackGrowth, WhatCannotGrowIsRefused) {
  Model m = box_model({20, 10}, 0.5, 3.0);
  EXPECT_THROW((void)crack_growth_modes<2>(m, lowest(4), 3), Error);
  add_crack(m, {{3.0, 0.0}, {3.0, 2.0}});
  EXPECT_THROW((void)crack_growth_modes<2>(m, lowest(4), 0), Error);
  ModalOptions range;
  range.range = {0.0, 1.0};
  EXPECT_THROW((void)crack_growth_modes<2>(m, range, 3), Error);
  ModalOptions dense = lowest(4);
  dense.solver = ModalSolver::dense;
  EXPECT_THROW((void)crack_growth_modes<2>(m, dense, 3), Error);
  Model outside = m;
  add_crack(outside, {{30.0, 0.0}, {30.0, 2.0}});
  EXPECT_THROW((void)crack_growth_modes<2>(outside, lowest(4), 3), Error);
  Model odd = m;
  add_wall(odd, 0, true, WallType::odd);
  EXPECT_THROW((void)crack_growth_modes<2>(odd, lowest(4), 3), Error);
  Model bar = box_model({20}, 0.5, 3.0);
  add_crack(bar, {{3.0}});
  EXPECT_THROW((void)crack_growth_modes<1>(bar, lowest(4), 3), Error);
}

}  // namespace
}  // namespace perimode
