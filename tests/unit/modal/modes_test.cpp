// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/modal/modes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "perimode/assembly/assemble.hpp"
#include "perimode/modal/plan.hpp"
#include "perimode/modal/rigid.hpp"
#include "support/models.hpp"

namespace perimode {
namespace {

using test::add_crack;
using test::add_walls;
using test::box_model;
using test::fix_face;

ModalOptions lowest(int modes, ModalSolver solver = ModalSolver::automatic) {
  ModalOptions o;
  o.modes = modes;
  o.solver = solver;
  return o;
}

template <int Dim>
int rigid_count(const Model& model) {
  const auto body = build_body<Dim>(model);
  const auto k = scalar_csr(assemble_stiffness(body), body.boundary.free_number);
  return static_cast<int>(rigid_modes(body, as_operator(k), lumped_mass(body)).cols());
}

TEST(RigidModes, FreeBodiesHaveAllMotions) {
  EXPECT_EQ(rigid_count<1>(box_model({30}, 0.1, 3.0)), 1);
  EXPECT_EQ(rigid_count<2>(box_model({12, 9}, 0.1, 3.0)), 3);
  EXPECT_EQ(rigid_count<3>(box_model({6, 5, 4}, 0.1, 2.0)), 6);
}

TEST(RigidModes, PeriodicBodiesKeepTheirTranslations) {
  Model m = box_model({6, 5, 4}, 0.1, 2.0);
  m.periodic = {true, true, true};
  EXPECT_EQ(rigid_count<3>(m), 3);
  m.periodic = {true, true, false};
  EXPECT_EQ(rigid_count<3>(m), 3);
  m.periodic = {true, false, false};
  EXPECT_EQ(rigid_count<3>(m), 4);  // and the rotation about x
}

TEST(RigidModes, ASoftSupportHoldsAStiffLightBody) {
  // Held at the soft and heavy half: that K q is small beside the largest eigenvalue frees nothing.
  Model m = box_model({100, 5}, 1.0, 3.0);
  fix_face(m, 0, false, 1, {0, 1});
  m.blocks.push_back({"stiff", Region{BoxRegion{{50.0, 0.0}, {100.0, 5.0}}, {}}});
  m.block_materials["stiff"] = m.material;
  m.block_materials["stiff"].youngs_modulus = 1e4;
  m.block_materials["stiff"].density = 1e-4;
  EXPECT_EQ(rigid_count<2>(m), 0);
  const auto r = solve_modes(build_body<2>(m), lowest(3, ModalSolver::lanczos));
  EXPECT_EQ(r.mechanisms, 0);  // nor is a slow mode a mechanism
  EXPECT_GT(r.eigenvalue[0], 0.0);
  m.boundary.clear();
  EXPECT_EQ(rigid_count<2>(m), 3);
}

TEST(RigidModes, SupportsTakeThemAway) {
  Model clamped = box_model({12, 9}, 0.1, 3.0);
  fix_face(clamped, 0, false, 1, {0, 1});
  EXPECT_EQ(rigid_count<2>(clamped), 0);
  Model roller = box_model({12, 9}, 0.1, 3.0);
  fix_face(roller, 0, false, 2, {0});
  EXPECT_EQ(rigid_count<2>(roller), 1);
  Model pinned = box_model({12, 9}, 0.1, 3.0);
  pinned.boundary.push_back({Fix{{0, 1}, Region{NearestRegion{{0.0, 0.0}}, {}}}, {}});
  EXPECT_EQ(rigid_count<2>(pinned), 1);
}

TEST(RigidModes, WallsLeaveWhatTheyDoNotHold) {
  Model m = box_model({12, 9}, 0.1, 3.0);
  test::add_wall(m, 0, false, WallType::mirror);
  EXPECT_EQ(rigid_count<2>(m), 1);  // along the wall
}

TEST(RigidModes, OfAFreeBodyStartWithPureTranslations) {
  const auto body = build_body<3>(box_model({6, 5, 4}, 0.1, 2.0));
  const auto r = solve_modes(body, lowest(6));
  const double mass = 6 * 5 * 4 * 0.001;
  const Eigen::Matrix3d translations = mass * Eigen::Matrix3d::Identity();
  EXPECT_LE((r.effective_mass.topRows(3) - translations).cwiseAbs().maxCoeff(), 1e-12 * mass);
  EXPECT_LE(r.effective_mass.bottomRows(3).cwiseAbs().maxCoeff(), 1e-12 * mass);
}

TEST(RigidModes, EveryPieceMovesByItself) {
  Model m = box_model({12, 9}, 0.1, 3.0);
  add_crack(m, {{0.6, -0.1}, {0.6, 1.0}});
  EXPECT_EQ(rigid_count<2>(m), 6);
}

TEST(Modes, OfAFreePlateStartWithThreeRigidOnesAtExactlyZero) {
  const auto body = build_body<2>(box_model({16, 11}, 0.1, 3.0));
  const auto r = solve_modes(body, lowest(8, ModalSolver::lanczos));
  ASSERT_EQ(r.count(), 8);
  EXPECT_EQ(r.rigid_modes, 3);
  EXPECT_EQ(r.mechanisms, 0);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(r.kind[k], ModeKind::rigid);
    EXPECT_EQ(r.eigenvalue[k], 0.0);
    EXPECT_LT(r.residual[k], 1e-13);
  }
  EXPECT_EQ(r.kind[3], ModeKind::elastic);
  EXPECT_GT(r.frequency_hz[3], 0.0);
  EXPECT_TRUE(r.certificate.complete);
}

TEST(Modes, AreMassOrthonormalWithSmallResiduals) {
  Model m = box_model({20, 10}, 0.1, 3.0);
  fix_face(m, 0, false, 3, {0, 1});
  const auto body = build_body<2>(m);
  const auto mass = lumped_mass(body);
  for (auto solver : {ModalSolver::lanczos, ModalSolver::arpack, ModalSolver::dense}) {
    const auto r = solve_modes(body, lowest(12, solver));
    ASSERT_EQ(r.count(), 12);
    EXPECT_EQ(r.status, EigenStatus::converged);
    const Eigen::MatrixXd gram = r.shape.transpose() * mass.asDiagonal() * r.shape;
    EXPECT_LE((gram - Eigen::MatrixXd::Identity(12, 12)).cwiseAbs().maxCoeff(), 1e-10);
    EXPECT_LE(r.residual.maxCoeff(), 1e-9);
  }
}

TEST(Modes, EffectiveMassesOfAllModesAddUpToTheFreeMass) {
  Model m = box_model({8, 5}, 0.1, 2.0);
  fix_face(m, 0, false, 2, {0, 1});
  const auto body = build_body<2>(m);
  const auto r = solve_modes(body, lowest(body.boundary.free));
  const double mass = 30 * 0.01;  // free particles of volume 0.01 and density 1
  EXPECT_NEAR(r.effective_mass.col(0).sum(), mass, 1e-12);
  EXPECT_NEAR(r.effective_mass.col(1).sum(), mass, 1e-12);
}

TEST(Modes, RangeReturnsAllInside) {
  Model m = box_model({20, 10}, 0.1, 3.0);
  fix_face(m, 0, false, 3, {0, 1});
  const auto body = build_body<2>(m);
  const auto all = solve_modes(body, lowest(40));
  ModalOptions range;
  range.range = {0.5 * (all.frequency_hz[5] + all.frequency_hz[6]),
                 0.5 * (all.frequency_hz[20] + all.frequency_hz[21])};
  for (auto solver : {ModalSolver::lanczos, ModalSolver::dense}) {
    range.solver = solver;
    const auto r = solve_modes(body, range);
    ASSERT_EQ(r.count(), 15);
    for (int k = 0; k < 15; ++k)
      EXPECT_NEAR(r.frequency_hz[k], all.frequency_hz[k + 6], 1e-9 * all.frequency_hz[k + 6]);
  }
}

TEST(Modes, RangeFromZeroHoldsTheRigidOnes) {
  const auto body = build_body<2>(box_model({12, 9}, 0.1, 3.0));
  const auto all = solve_modes(body, lowest(10));
  ModalOptions range;
  range.range = {0.0, 0.5 * (all.frequency_hz[6] + all.frequency_hz[7])};
  const auto r = solve_modes(body, range);
  EXPECT_EQ(r.count(), 7);
  EXPECT_EQ(r.rigid_modes, 3);
}

TEST(Modes, ShiftReturnsTheNearestInHertz) {
  const auto body = build_body<1>(box_model({100}, 0.01, 3.0));
  const auto all = solve_modes(body, lowest(100));
  for (double target : {0.1 * all.frequency_hz[1], 0.9 * all.frequency_hz[10], all.frequency_hz[60]}) {
    ModalOptions near = lowest(7, ModalSolver::lanczos);
    near.shift = target;
    const auto r = solve_modes(body, near);
    std::vector<double> distance;
    for (double f : all.frequency_hz) distance.push_back(std::abs(f - target));
    std::sort(distance.begin(), distance.end());
    ASSERT_EQ(r.count(), 7);
    EXPECT_NEAR((r.frequency_hz.array() - target).abs().maxCoeff(), distance[6], 1e-8 * target);
  }
}

TEST(Modes, MechanismsAreCountedApartFromRigidMotions) {
  const auto body =
      build_body<2>(box_model({4, 4}, 1.0, 1.0));  // axis bonds only: rows and columns shear freely
  const auto r = solve_modes(body, lowest(16));
  EXPECT_EQ(r.rigid_modes, 3);
  // Each of 4 columns slides along y and each of 4 rows along x: 8 zero-energy motions, 3 of them rigid.
  EXPECT_EQ(r.mechanisms, 5);
}

TEST(Modes, ACrackLowersNoFrequencyLessThanNothing) {
  Model m = box_model({24, 12}, 0.1, 3.0);
  fix_face(m, 0, false, 3, {0, 1});
  const auto whole = solve_modes(build_body<2>(m), lowest(10));
  add_crack(m, {{1.2, -0.1}, {1.2, 0.6}});
  const auto cracked = solve_modes(build_body<2>(m), lowest(10));
  for (int k = 0; k < 10; ++k) EXPECT_LE(cracked.eigenvalue[k], whole.eigenvalue[k] * (1.0 + 1e-12));
  EXPECT_LT(cracked.eigenvalue[0], 0.9 * whole.eigenvalue[0]);
}

TEST(Modes, AssuranceIsOneForItselfAndZeroForOthers) {
  Model m = box_model({14, 10}, 0.1, 3.0);
  fix_face(m, 1, false, 3, {0, 1});
  const auto body = build_body<2>(m);
  const auto r = solve_modes(body, lowest(6));
  const auto mac = modal_assurance(r.shape, -2.0 * r.shape, lumped_mass(body));
  EXPECT_LE((mac - Eigen::MatrixXd::Identity(6, 6)).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(Modes, SurfaceNodesGiveRealEigenvaluesAndBiorthogonalVectors) {
  Model m = box_model({100}, 0.01, 10.0);
  m.material.micromodulus.kernel = Kernel::inverse_distance;
  m.volume_correction = VolumeCorrection::linear;
  add_walls(m, 0, WallType::surface_nodes);
  const auto body = build_body<1>(m);
  const auto r = solve_modes(body, lowest(20));
  EXPECT_EQ(r.status, EigenStatus::converged);
  EXPECT_GT(r.asymmetry, 0.1);
  EXPECT_LT(r.imaginary, 1e-8);
  const Eigen::MatrixXd gram = r.left.transpose() * lumped_mass(body).asDiagonal() * r.shape;
  EXPECT_LE((gram - Eigen::MatrixXd::Identity(20, 20)).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_LE(r.residual.maxCoeff(), 1e-9);
}

TEST(Modes, AskingForTooManyOrForNothingIsAnError) {
  Model m = box_model({6}, 0.1, 2.0);
  EXPECT_THROW((void)solve_modes(build_body<1>(m), lowest(7)), Error);
  fix_face(m, 0, false, 6, {0});
  EXPECT_THROW((void)solve_modes(build_body<1>(m), lowest(1)), Error);
}

TEST(Plan, CountsWhatTheRunFinds) {
  Model m = box_model({40, 30}, 0.1, 3.0);
  add_crack(m, {{2.0, -0.1}, {2.0, 1.0}});
  const auto body = build_body<2>(m);
  const auto plan = plan_modes(body, lowest(10));
  const auto r = solve_modes(body, lowest(10));
  EXPECT_EQ(plan.solver, r.solver);
  EXPECT_EQ(plan.rigid, r.rigid_modes);
  EXPECT_EQ(plan.nonzeros, r.nonzeros);
  EXPECT_EQ(plan.dofs, body.boundary.free);
  EXPECT_TRUE(plan.warnings.empty());
}

TEST(Plan, WarnsOfShortHorizonsIsolatedParticlesAndPieces) {
  EXPECT_EQ(plan_modes(build_body<2>(box_model({6, 6}, 0.1, 1.0)), lowest(3)).warnings.size(), 1U);
  Model m = box_model({12, 12}, 0.1, 3.0);
  add_crack(m, {{0.6, -0.1}, {0.6, 2.0}});
  EXPECT_EQ(plan_modes(build_body<2>(m), lowest(3)).pieces, 2);
  EXPECT_EQ(plan_modes(build_body<2>(m), lowest(3)).warnings.size(), 1U);
}

}  // namespace
}  // namespace perimode
