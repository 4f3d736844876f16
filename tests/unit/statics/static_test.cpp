// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/statics/static.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "perimode/linalg/threads.hpp"
#include "perimode/statics/static_plan.hpp"
#include "unit/statics/loaded_models.hpp"

namespace perimode {
namespace {

using test::add_wall;
using test::box_model;
using test::cantilever;
using test::end_load;
using test::face;
using test::fix_face;
using test::loaded;
using test::prescribe;
using test::solved;

double relative(const Eigen::VectorXd& a, const Eigen::VectorXd& b) { return (a - b).norm() / b.norm(); }

TEST(Static, AllSolversAgree) {
  const StaticResult exact = solved<2>(cantilever(), loaded(end_load(), StaticSolver::cholesky));
  EXPECT_EQ(exact.solver, "cholesky");
  for (StaticSolver solver : {StaticSolver::multigrid, StaticSolver::jacobi, StaticSolver::lu}) {
    const StaticResult other = solved<2>(cantilever(), loaded(end_load(), solver));
    EXPECT_EQ(other.reason, "asked for");
    EXPECT_LE(relative(other.displacement, exact.displacement), 1e-8);
    EXPECT_NEAR(other.strain_energy, exact.strain_energy, 1e-8 * exact.strain_energy);
  }
  Model block = box_model({5, 4, 4}, 0.1, 2.0);
  fix_face(block, 2, false, 1, {0, 1, 2});
  const std::vector<Load> weight = {{BodyForce{{0.0, 1e-3, -1e-2}}}};
  const StaticResult factor = solved<3>(block, loaded(weight, StaticSolver::cholesky));
  for (StaticSolver solver : {StaticSolver::multigrid, StaticSolver::jacobi, StaticSolver::lu})
    EXPECT_LE(relative(solved<3>(block, loaded(weight, solver)).displacement, factor.displacement), 1e-8);
}

/// Clapeyron: the strain energy is half the work of loads and reactions.
TEST(Static, StrainEnergyIsTheExternalWork) {
  Model pulled = cantilever();
  prescribe(pulled, {{1, 1e-3}}, face(0, true, 1));
  Model walled = box_model({10, 7}, 0.1, 3.0);
  add_wall(walled, 0, false, WallType::mirror);
  add_wall(walled, 1, false, WallType::mirror);
  prescribe(walled, {{0, 2e-3}}, face(0, true, 2));
  for (const Model& m : {cantilever(), pulled, walled}) {
    const StaticResult r = solved<2>(m, loaded(end_load()));
    EXPECT_GT(r.strain_energy, 0.0);
    EXPECT_NEAR(r.strain_energy, r.external_work, 1e-11 * r.strain_energy);
  }
}

TEST(Static, GivenValuesAreKeptAndTheRestIsLinearInThem) {
  Model m = cantilever();
  prescribe(m, {{0, 1e-3}, {1, -2e-3}}, face(0, true, 2));
  const StaticResult once = solved<2>(m, loaded({}));
  for (auto& condition : m.boundary) {
    if (auto* p = std::get_if<Prescribe>(&condition.what)) p->components = {{0, 2e-3}, {1, -4e-3}};
  }
  const StaticResult twice = solved<2>(m, loaded({}));
  EXPECT_LE(relative(twice.displacement, 2.0 * once.displacement), 1e-12);
  EXPECT_EQ(once.displacement[2 * 11], 1e-3);
  EXPECT_EQ(once.displacement[2 * 11 + 1], -2e-3);
  EXPECT_EQ(once.displacement[0], 0.0);
}

TEST(Static, ABodyWithEveryComponentGivenOnlyTakesReactions) {
  Model m = box_model({6}, 0.1, 2.0);
  prescribe(m, {{0, 0.0}}, Region{BoxRegion{{0.0}, {0.6}}, {}});
  prescribe(m, {{0, 1e-3}}, face(0, true, 1));
  const StaticResult r = solved<1>(m, loaded({}));
  EXPECT_EQ(r.displacement[5], 1e-3);
  EXPECT_EQ(r.displacement[4], 0.0);
  EXPECT_GT(r.strain_energy, 0.0);
  EXPECT_NEAR(r.strain_energy, r.external_work, 1e-14 * r.strain_energy);
}

TEST(Static, LoadsOnHeldParticlesMoveNothing) {
  const StaticResult r = solved<2>(cantilever(), loaded({{TotalForce{{3.0, 4.0}}, face(0, false, 1)}}));
  EXPECT_EQ(r.displacement, Eigen::VectorXd::Zero(r.displacement.size()));
  EXPECT_NEAR(r.reactions[0].force[0], -3.0, 1e-14);
  EXPECT_NEAR(r.reactions[0].force[1], -4.0, 1e-14);
}

TEST(Static, AFreeBodyUnderLoadsInEquilibriumHasNoMeanMotion) {
  const Model m = box_model({11, 6}, 0.1, 3.0);
  const std::vector<Load> pull = {{Traction{{1e-3, 0.0}}, face(0, true, 1)},
                                  {Traction{{-1e-3, 0.0}}, face(0, false, 1)}};
  std::string said;
  Sink sink;
  sink.info = [&](std::string_view text) { said += text; };
  const auto body = build_body<2>(m);
  const StaticResult factor = solve_static(body, m.boundary, loaded(pull, StaticSolver::cholesky), sink);
  EXPECT_THAT(said, testing::HasSubstr("3 rigid motions"));
  const StaticResult iterated = solved<2>(m, loaded(pull, StaticSolver::jacobi));
  const StaticResult cycled = solved<2>(m, loaded(pull, StaticSolver::multigrid));
  for (const StaticResult& r : {factor, iterated, cycled}) {
    EXPECT_EQ(r.rigid_modes, 3);
    EXPECT_NEAR(r.strain_energy, r.external_work, 1e-10 * r.strain_energy);
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (Index i = 0; i < body.count(); ++i) {
      const Eigen::Vector2d u = r.displacement.segment<2>(2 * i);
      const Eigen::Vector2d x = body.particles.position[i] - Eigen::Vector2d(0.55, 0.3);
      mean += Eigen::Vector3d(u[0], u[1], x[0] * u[1] - x[1] * u[0]);
    }
    EXPECT_LE(mean.norm(), 1e-11 * r.displacement.norm());
  }
  EXPECT_LE(relative(iterated.displacement, factor.displacement), 1e-8);
  EXPECT_LE(relative(cycled.displacement, factor.displacement), 1e-8);
}

TEST(Static, APeriodicBodyUnderASelfEquilibratedBodyForce) {
  Model m = box_model({12, 5}, 0.1, 3.0);
  m.periodic = {true, true, false};
  const Region left{BoxRegion{{0.0, 0.0}, {0.6, 0.5}}, {}};
  const Region right{BoxRegion{{0.6, 0.0}, {1.2, 0.5}}, {}};
  const StaticResult r =
      solved<2>(m, loaded({{BodyForce{{0.0, 1.0}}, left}, {BodyForce{{0.0, -1.0}}, right}}));
  EXPECT_EQ(r.rigid_modes, 2);
  EXPECT_NEAR(r.displacement.sum(), 0.0, 1e-12 * r.displacement.norm());
}

TEST(Static, UnsymmetricWallsAreSolvedByLu) {
  Model m = box_model({8, 7}, 0.1, 3.0);
  add_wall(m, 0, false, WallType::odd);
  const std::vector<Load> load = {{BodyForce{{1e-3, 2e-3}}}};
  EXPECT_EQ(solved<2>(m, loaded(load)).solver, "lu");
  Model nodes = box_model({20}, 0.05, 3.0);
  test::add_surface_nodes(nodes, 0, false, {"0.0"});
  test::add_surface_nodes(nodes, 0, true, {"0.01"});
  const StaticResult bar = solved<1>(nodes, loaded({}));
  EXPECT_EQ(bar.solver, "lu");
  // Linear extrapolation lets a linear field through exactly: u = 0.01 x.
  for (int i = 0; i < 20; ++i) EXPECT_NEAR(bar.displacement[i], 0.01 * 0.05 * (i + 0.5), 1e-14);
}

template <int Dim>
void expect_refusal(const Model& m, const StaticOptions& options, const std::vector<const char*>& words) {
  try {
    (void)solve_static(build_body<Dim>(m), m.boundary, options);
    ADD_FAILURE() << "no error: " << words.front();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::invalid_input) << error.what();
    for (const char* part : words) EXPECT_THAT(error.what(), testing::HasSubstr(part));
  }
}

TEST(Static, WhatCannotStandStillIsRefusedAndTheFreeMotionNamed) {
  expect_refusal<2>(cantilever(), loaded({}), {"something that loads or moves the body"});
  const Model free = box_model({8, 6}, 0.1, 3.0);
  expect_refusal<2>(free, loaded(end_load()), {"translation along x", "translation along y"});
  Model sliding = box_model({8, 6}, 0.1, 3.0);
  fix_face(sliding, 0, false, 1, {0});
  expect_refusal<2>(sliding, loaded(end_load()), {"free translation along y;"});
  EXPECT_EQ(solved<2>(sliding, loaded({{Traction{{1.0, 0.0}}, face(0, true, 1)}})).rigid_modes, 1);
  Model hinged = box_model({7, 7}, 0.1, 3.0);
  hinged.boundary.push_back({Fix{{0, 1}, Region{NearestRegion{{0.35, 0.35}}, {}}}, {}});
  expect_refusal<2>(hinged, loaded({{TotalForce{{0.0, 1.0}}, face(0, true, 1)}}), {"free rotation"});
  Model torn = cantilever();
  test::add_crack(torn, {{0.6, -1.0}, {0.6, 2.0}});
  expect_refusal<2>(torn, loaded(end_load()), {"of the piece at (0.65, "});
  Model walled = box_model({8, 7}, 0.1, 3.0);
  add_wall(walled, 0, false, WallType::even);
  expect_refusal<2>(walled, loaded({{BodyForce{{0.0, 1.0}}}}), {"unsymmetric", "translation along"});
}

TEST(Static, MechanismsAreRefused) {
  // Nearest neighbours only: columns slide along each other. All are held but the fourth.
  Model m = box_model({8, 6}, 0.1, 1.0);
  fix_face(m, 0, false, 1, {0, 1});
  m.boundary.push_back({Fix{{1}, Region{BoxRegion{{0.0, 0.0}, {0.3, 0.1}}, {}}}, {}});
  m.boundary.push_back({Fix{{1}, Region{BoxRegion{{0.4, 0.0}, {0.8, 0.1}}, {}}}, {}});
  const std::vector<Load> weight = {{BodyForce{{0.0, 1.0}}}};
  for (StaticSolver solver :
       {StaticSolver::cholesky, StaticSolver::lu, StaticSolver::jacobi, StaticSolver::multigrid})
    expect_refusal<2>(m, loaded(weight, solver), {"stretches no bond", "longer horizon"});
}

TEST(Static, ASolverThatDoesNotFitTheBoundaryIsRefused) {
  Model m = box_model({8, 7}, 0.1, 3.0);
  add_wall(m, 0, false, WallType::odd);
  for (StaticSolver solver : {StaticSolver::cholesky, StaticSolver::multigrid, StaticSolver::jacobi})
    expect_refusal<2>(m, loaded({{BodyForce{{1.0, 0.0}}}}, solver), {"unsymmetric", "lu"});
}

TEST(Static, AtATolerancePastRoundingTheResidualOfRoundingIsEnough) {
  for (StaticSolver solver : {StaticSolver::cholesky, StaticSolver::jacobi}) {
    StaticOptions options = loaded(end_load(), solver);
    options.tolerance = 1e-30;
    EXPECT_LE(solved<2>(cantilever(), options).residual, 1e-12);
  }
}

TEST(Static, HasTheSameBitsForAnyNumberOfThreads) {
  const int before = threads();
  const auto with = [&](int count, StaticSolver solver) {
    set_threads(count);
    StaticResult result = solved<2>(cantilever(), loaded(end_load(), solver));
    set_threads(before);
    return result;
  };
  const StaticResult one = with(1, StaticSolver::jacobi);
  const StaticResult two = with(2, StaticSolver::jacobi);
  EXPECT_EQ(one.displacement, two.displacement);
  EXPECT_EQ(one.strain_energy, two.strain_energy);
  // The dense kernels inside a factor add in another order with other threads.
  EXPECT_LE(
      relative(with(1, StaticSolver::cholesky).displacement, with(2, StaticSolver::cholesky).displacement),
      1e-13);
}

TEST(StaticPlan, ChoosesBySizeAndSaysWhy) {
  const auto plan = [](const auto& body) { return plan_static(body, loaded({{BodyForce{{1.0, 0.0}}}})); };
  Model small = box_model({30, 30}, 0.1, 3.0);
  fix_face(small, 0, false, 1, {0, 1});
  const StaticPlan few = plan(build_body<2>(small));
  EXPECT_EQ(few.solver, StaticSolver::cholesky);
  EXPECT_GT(few.fill.nonzeros, 0);
  EXPECT_THAT(few.reason, testing::HasSubstr("few"));
  Model bar = box_model({40000}, 0.1, 3.0);
  fix_face(bar, 0, false, 1, {0});
  EXPECT_EQ(plan_static(build_body<1>(bar), loaded({{BodyForce{{1.0}}}})).solver, StaticSolver::cholesky);
  Model large = box_model({130, 130}, 0.1, 3.0);
  fix_face(large, 0, false, 1, {0, 1});
  const StaticPlan many = plan(build_body<2>(large));
  EXPECT_EQ(many.solver, StaticSolver::multigrid);
  EXPECT_EQ(many.fill.nonzeros, 0);
  EXPECT_GT(many.memory_bytes, few.memory_bytes);
  Model walled = box_model({8, 7}, 0.1, 3.0);
  add_wall(walled, 0, false, WallType::odd);
  EXPECT_EQ(plan(build_body<2>(walled)).solver, StaticSolver::lu);
}

}  // namespace
}  // namespace perimode
