// SPDX-License-Identifier: BSD-3-Clause
// The engine slepc against lanczos: two factorisations (MUMPS, CHOLMOD), two iterations, two counts.
#include <gtest/gtest.h>

#include "matrices.hpp"
#include "perimode/modal/modes.hpp"
#include "support/models.hpp"

namespace perimode {
namespace {

template <int Dim>
ModalResult modes_of(const Model& model, ModalOptions options, ModalSolver solver) {
  options.solver = solver;
  return solve_modes(build_body<Dim>(model), options);
}

/// Frequencies equal to 1e-9, as many of each kind; both complete by inertia.
template <int Dim>
ModalResult expect_agreement(const Model& model, ModalOptions options) {
  options.certificate = CertificateMethod::inertia;
  ModalResult slepc = modes_of<Dim>(model, options, ModalSolver::slepc);
  const ModalResult lanczos = modes_of<Dim>(model, options, ModalSolver::lanczos);
  EXPECT_EQ(slepc.solver, "slepc");
  EXPECT_EQ(lanczos.solver, "lanczos");
  EXPECT_EQ(slepc.status, EigenStatus::converged) << slepc.message;
  EXPECT_TRUE(slepc.certificate.complete);
  EXPECT_EQ(slepc.certificate.method, "inertia");
  EXPECT_EQ(slepc.kind, lanczos.kind);
  EXPECT_EQ(slepc.count(), lanczos.count());
  if (slepc.count() != lanczos.count()) return slepc;
  for (Eigen::Index k = 0; k < slepc.count(); ++k) {
    EXPECT_NEAR(slepc.frequency_hz[k], lanczos.frequency_hz[k], 1e-9 * lanczos.frequency_hz[k]) << k;
    EXPECT_LE(slepc.residual[k], 1e-8) << k;
  }
  return slepc;
}

/// Square or cube with all faces mirrored: every frequency of unequal wave numbers is repeated.
Model mirrored_box(const std::vector<int>& cells) {
  Model model = test::box_model(cells, 0.1, 3.0);
  for (int axis = 0; axis < model.dimension; ++axis) test::add_walls(model, axis, WallType::mirror);
  return model;
}

TEST(Slepc, FindsTheRepeatedModesOfASquareAndACube) {
  expect_agreement<2>(mirrored_box({24, 24}), {.modes = 40});
  expect_agreement<3>(mirrored_box({9, 9, 9}), {.modes = 30});
}

TEST(Slepc, CountsTheRigidModesOfFreeBodiesOnce) {
  const ModalResult plate = expect_agreement<2>(test::box_model({24, 24}, 0.1, 3.0), {.modes = 20});
  EXPECT_EQ(plate.rigid_modes, 3);
  EXPECT_GE(plate.certificate.count, 20);  // the rigid ones are among those counted
  EXPECT_EQ(expect_agreement<3>(test::box_model({8, 8, 8}, 0.1, 2.0), {.modes = 20}).rigid_modes, 6);
}

TEST(Slepc, AgreesOnACrackedPlate) {
  Model model = test::box_model({30, 20}, 0.1, 3.0);
  test::fix_face(model, 0, false, 3, {0, 1});
  test::add_crack(model, {{1.5, 0.0}, {1.5, 1.0}});
  expect_agreement<2>(model, {.modes = 25});
}

TEST(Slepc, FindsAllModesOfARangeAndTheNearestToAFrequency) {
  const Model model = mirrored_box({24, 24});
  const ModalResult lowest = modes_of<2>(model, {.modes = 60}, ModalSolver::lanczos);
  const auto between = [&](int k) { return 0.5 * (lowest.frequency_hz[k] + lowest.frequency_hz[k + 1]); };
  const auto gap_after = [&](int k) {
    while (lowest.frequency_hz[k + 1] < 1.001 * lowest.frequency_hz[k]) ++k;
    return k;
  };
  expect_agreement<2>(model, {.range = {{between(gap_after(10)), between(gap_after(40))}}});
  expect_agreement<2>(model, {.range = {{0.0, between(gap_after(20))}}});
  // Off the middle of a gap: which modes are nearest is then plain.
  const int k = gap_after(30);
  const double f = 0.7 * lowest.frequency_hz[k] + 0.3 * lowest.frequency_hz[k + 1];
  expect_agreement<2>(model, {.modes = 9, .shift = f});
}

TEST(Slepc, MayLeaveTheCertificateOut) {
  const Csr k = test::chain(700, true);
  const Eigen::VectorXd mass = test::random_mass(700, 3);
  EigenOptions options{.count = 5, .engine = EigenEngine::slepc, .check = CompletenessCheck::none};
  const EigenResult result = solve_eigen({.stiffness = &k, .mass = &mass}, options);
  EXPECT_EQ(result.status, EigenStatus::converged);
  EXPECT_FALSE(result.certificate.asked);
  const Eigen::VectorXd all = test::reference_eigenvalues(k, mass);
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(result.value[i], all[i], 1e-9 * all[i]);
}

}  // namespace
}  // namespace perimode
