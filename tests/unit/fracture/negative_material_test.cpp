// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <string>
#include <vector>

#include "perimode/assembly/assemble.hpp"
#include "perimode/assembly/operators.hpp"
#include "perimode/dynamics/transient.hpp"
#include "perimode/modal/modes.hpp"
#include "perimode/statics/static.hpp"
#include "quasistatic_models.hpp"
#include "support/negative_shells.hpp"

// Bodies of materials whose bonds of some lengths have negative stiffness, through every analysis.
namespace perimode {
namespace {

using test::box_model;
using test::face;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// A plate of the optimised lattice, stable where it is periodic.
Model optimised_plate(int nx, int ny) {
  Model m = box_model({nx, ny}, 1.0, 2.0);
  m.plane = Plane::strain;
  m.periodic = {true, true, false};
  m.material.micromodulus = test::optimised_two();
  return m;
}

/// Slightly negative bonds of the longest orbit, which free surfaces bear.
Model mild_plate(int n) {
  Model m = test::cracked_plate(n, 0.3);
  m.plane = Plane::strain;
  m.horizon.value = 2.0;
  m.material.micromodulus.kernel = Kernel::shells;
  m.material.micromodulus.shells = {{{1, 0, 0}, 2.0}, {{1, 1, 0}, 1.5}, {{2, 0, 0}, -0.1}};
  m.material.break_negative = true;
  return m;
}

Eigen::MatrixXd dense_stiffness(const Body<2>& body) {
  const Index n = body.boundary.free;
  return multiply(as_operator(scalar_csr(assemble_stiffness(body), body.boundary.free_number)),
                  Eigen::MatrixXd(Eigen::MatrixXd::Identity(n, n)));
}

TEST(NegativeMaterial, EveryStaticSolverFindsTheSameDisplacements) {
  Model m = optimised_plate(24, 16);
  test::fix_face(m, 0, false, 2, {0, 1});
  const Body<2> body = build_body<2>(m);
  StaticOptions options;
  options.tolerance = 1e-11;
  options.loads = {{BodyForce{{2e-3, -1e-3}}, Region{BallRegion{{12.0, 8.0}, 3.0}, {}}}};
  const Eigen::MatrixXd k = dense_stiffness(body);
  Eigen::VectorXd load(body.boundary.free);
  const Eigen::VectorXd all = load_vector(body.particles, options.loads);
  for (Eigen::Index d = 0; d < all.size(); ++d) {
    const Index number = body.boundary.free_number[static_cast<std::size_t>(d)];
    if (number >= 0) load[number] = all[d];
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(k);
  ASSERT_EQ(factor.info(), Eigen::Success);
  const Eigen::VectorXd expected = factor.solve(load);
  for (const auto solver : {StaticSolver::cholesky, StaticSolver::multigrid, StaticSolver::jacobi}) {
    options.solver = solver;
    const StaticResult r = solve_static(body, m.boundary, options);
    ASSERT_EQ(r.status, StaticStatus::converged) << r.message;
    EXPECT_NEAR(r.strain_energy, 0.5 * load.dot(expected), 1e-8 * std::abs(r.strain_energy));
    double worst = 0.0;
    for (std::size_t d = 0; d < body.boundary.free_number.size(); ++d) {
      const Index number = body.boundary.free_number[d];
      if (number >= 0)
        worst = std::max(worst, std::abs(r.displacement[static_cast<Eigen::Index>(d)] - expected[number]));
    }
    // Residuals of 1e-11 through a condition number of some thousands.
    EXPECT_LT(worst, 1e-6 * expected.cwiseAbs().maxCoeff()) << r.solver;
  }
}

/// Negative enough to make a free surface unstable: every solver says so instead of giving numbers.
TEST(NegativeMaterial, AnUnstableBodyIsReportedByEveryStaticSolver) {
  Model m = optimised_plate(24, 16);
  m.periodic = {false, false, false};
  m.material.micromodulus.shells[2].alpha = -6.0;
  test::fix_face(m, 0, false, 2, {0, 1});
  const Body<2> body = build_body<2>(m);
  ASSERT_LT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense_stiffness(body)).eigenvalues()[0], 0.0);
  StaticOptions options;
  options.loads = {{Traction{{2e-3, -1e-3}}, face(0, true)}};
  for (const auto solver : {StaticSolver::cholesky, StaticSolver::multigrid, StaticSolver::jacobi}) {
    options.solver = solver;
    try {
      EXPECT_NE(solve_static(body, m.boundary, options).status, StaticStatus::converged);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
      EXPECT_THAT(error.what(), HasSubstr("negative stiffness"));
    }
  }
}

TEST(NegativeMaterial, EveryEigenSolverFindsTheSameModes) {
  const Body<2> body = build_body<2>(optimised_plate(14, 12));
  const Eigen::VectorXd mass = lumped_mass(body);
  const Eigen::VectorXd exact =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense_stiffness(body)).eigenvalues() / mass[0];
  for (const auto solver : {ModalSolver::dense, ModalSolver::lanczos, ModalSolver::arpack,
                            ModalSolver::chebyshev, ModalSolver::inverse}) {
    ModalOptions options;
    options.modes = 12;
    options.solver = solver;
    const ModalResult r = solve_modes(body, options);
    ASSERT_EQ(r.status, EigenStatus::converged) << r.message;
    EXPECT_EQ(r.unstable, 0);
    EXPECT_EQ(r.rigid_modes, 2);
    for (Eigen::Index k = 2; k < 12; ++k) EXPECT_NEAR(r.eigenvalue[k], exact[k], 1e-9 * exact[k]) << r.solver;
  }
}

TEST(NegativeMaterial, UnstableModesAreFoundCountedAndNamed) {
  Model m = optimised_plate(14, 12);
  m.periodic = {false, false, false};
  m.material.micromodulus.shells[2].alpha = -6.0;
  const Body<2> body = build_body<2>(m);
  const Eigen::VectorXd exact =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense_stiffness(body)).eigenvalues() /
      lumped_mass(body)[0];
  ASSERT_LT(exact[0], 0.0);
  for (const auto solver : {ModalSolver::dense, ModalSolver::lanczos}) {
    ModalOptions options;
    options.modes = 8;
    options.solver = solver;
    std::vector<std::string> warnings;
    Sink sink;
    sink.warning = [&](std::string_view text) { warnings.emplace_back(text); };
    const ModalResult r = solve_modes(body, options, sink);
    EXPECT_TRUE(r.frequency_hz.allFinite());
    EXPECT_NEAR(r.eigenvalue.minCoeff(), exact[0], 1e-8 * std::abs(exact[0])) << r.solver;
    EXPECT_EQ(r.unstable, std::min<Eigen::Index>(8 - r.rigid_modes, (exact.array() < -1e-9).count()));
    EXPECT_THAT(warnings, testing::Contains(HasSubstr("the body is unstable")));
  }
  TransientOptions modal;
  modal.method = TimeMethod::modal;
  modal.end = 1.0;
  modal.dt = 0.01;
  Body<2> moving = build_body<2>(m);
  EXPECT_THAT([&] { (void)run_transient(moving, modal, {}); },
              ThrowsMessage<Error>(HasSubstr("a material that resists every motion")));
}

struct Waves {
  TransientResult result;
  double imbalance = 0.0;
};

Waves waves_of(const Model& model, TransientOptions options) {
  Body<2> body = build_body<2>(model);
  InitialState initial;
  initial.displacement.resize(static_cast<Eigen::Index>(body.count()) * 2);
  for (Index i = 0; i < body.count(); ++i) {
    const Point<2> r = body.particles.position[i] - Point<2>(9.0, 7.0);
    initial.displacement.segment<2>(2 * static_cast<Eigen::Index>(i)) =
        1e-3 * std::exp(-r.squaredNorm() / 6.0) * Point<2>(1.0, 0.5);
  }
  Waves r;
  double scale = 0.0;
  TransientObserver<2> observer;
  observer.history = [&](const HistoryRow& row) {
    r.imbalance = std::max(r.imbalance, std::abs(row.energies.balance()));
    scale = std::max(scale, row.energies.kinetic + row.energies.strain);
  };
  r.result = run_transient(body, options, initial, observer);
  r.imbalance /= scale;
  return r;
}

/// Waves on a periodic lattice keep their energy in every form of K, explicit and implicit steps.
TEST(NegativeMaterial, WavesKeepTheirEnergy) {
  const Model m = optimised_plate(18, 14);
  TransientOptions options;
  options.end = 20.0;
  const Waves stencil = waves_of(m, options);
  EXPECT_EQ(stencil.result.plan.form, "stencil");
  EXPECT_TRUE(stencil.result.plan.warnings.empty());
  EXPECT_LT(stencil.imbalance, 1e-12);
  for (const auto form : {StiffnessForm::bonds, StiffnessForm::blocks}) {
    options.form = form;
    const Waves other = waves_of(m, options);
    EXPECT_LT(other.imbalance, 1e-12);
    EXPECT_LT((other.result.displacement - stencil.result.displacement).cwiseAbs().maxCoeff(), 1e-13);
  }
  options.form = StiffnessForm::automatic;
  options.method = TimeMethod::newmark;
  options.dt = 0.1;
  EXPECT_LT(waves_of(m, options).imbalance, 1e-10);  // conjugate gradients or a factor, step by step
}

/// Bonds that may break but do not: the forces of turning bonds give the same waves, and the plan warns.
TEST(NegativeMaterial, BreakableBondsMoveLikeTheOthersAndWarn) {
  const Model m = optimised_plate(18, 14);
  TransientOptions options;
  options.end = 10.0;
  const Waves whole = waves_of(m, options);
  options.critical_stretch = {0.5};
  const Waves breakable = waves_of(m, options);
  EXPECT_THAT(breakable.result.plan.warnings, ElementsAre(HasSubstr("gains energy")));
  EXPECT_EQ(breakable.result.broken_bonds, 0);
  EXPECT_LT((whole.result.displacement - breakable.result.displacement).cwiseAbs().maxCoeff(), 1e-13);
  options.method = TimeMethod::newmark;
  options.dt = 0.1;
  EXPECT_THAT([&] { (void)waves_of(m, options); }, ThrowsMessage<Error>(HasSubstr("negative parts")));
}

/// Cracks grow the same way whether the factor follows the breaks (negative terms are added), is made anew
/// or not made at all.
TEST(NegativeMaterial, QuasistaticBreaksFollowInEveryWay) {
  Model m = mild_plate(10);
  std::vector<std::vector<QuasistaticRow>> curves;
  for (const SolveWay way : {SolveWay::update, SolveWay::refactor, SolveWay::stale, SolveWay::iterate}) {
    Body<2> body = build_body<2>(m);
    QuasistaticOptions options = test::options_of(m, body);
    options.loads = {test::pull({0.0, 1.0}, face(1, true))};
    options.stop.events = 25;
    options.solver.only = way;
    options.solver.tolerance = 1e-12;
    std::vector<std::string> warnings;
    Sink sink;
    sink.warning = [&](std::string_view text) { warnings.emplace_back(text); };
    test::Told<2> told;
    const QuasistaticResult r = run_quasistatic(body, options, told.observer(), nullptr, sink);
    EXPECT_NE(r.status, QuasistaticStatus::not_converged) << r.message;
    EXPECT_THAT(warnings, testing::Contains(HasSubstr("gains energy")));
    EXPECT_LT(r.worst_balance, 1e-8);
    curves.push_back(told.rows);
  }
  bool some_negative = false;
  for (std::size_t c = 1; c < curves.size(); ++c) {
    ASSERT_EQ(curves[c].size(), curves[0].size());
    for (std::size_t e = 0; e < curves[0].size(); ++e) {
      EXPECT_EQ(curves[c][e].broken_bonds, curves[0][e].broken_bonds);
      EXPECT_NEAR(curves[c][e].load_factor, curves[0][e].load_factor, 1e-7 * curves[0][e].load_factor);
    }
  }
  for (std::size_t e = 1; e < curves[0].size(); ++e)
    some_negative =
        some_negative || curves[0][e].bond_energy_released < curves[0][e - 1].bond_energy_released;
  EXPECT_TRUE(some_negative);  // a broken bond took negative energy with it
  m.material.break_negative = false;
  const Body<2> body = build_body<2>(m);
  EXPECT_THAT([&] { (void)test::options_of(m, body); }, ThrowsMessage<Error>(HasSubstr("break_negative")));
}

}  // namespace
}  // namespace perimode
