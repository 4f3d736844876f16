// SPDX-License-Identifier: BSD-3-Clause
// Bodies with repeated eigenvalues, where single-vector Krylov solvers lose copies while every residual is
// small: all copies have to be there, against LAPACK. large_test.cpp has the same at full size.
#include "verification/modes_of.hpp"

namespace perimode {
namespace {

using test::box_model;
using test::certified_modes;
using test::fix_face;
using test::lowest;

template <int Dim>
void expect_every_engine_complete(const Model& model, int modes) {
  const auto expected = certified_modes<Dim>(model, lowest(modes, ModalSolver::dense));
  for (auto solver : {ModalSolver::lanczos, ModalSolver::arpack}) {
    for (auto method : {CertificateMethod::inertia, CertificateMethod::restart}) {
      ModalOptions options = lowest(modes, solver);
      options.certificate = method;
      const auto r = certified_modes<Dim>(model, options);
      ASSERT_EQ(r.count(), modes);
      EXPECT_EQ(r.rigid_modes, expected.rigid_modes);
      for (int k = 0; k < modes; ++k) {
        EXPECT_NEAR(r.eigenvalue[k], expected.eigenvalue[k], 1e-10 * expected.eigenvalue[k])
            << r.solver << " " << k + 1;
      }
    }
  }
}

TEST(Completeness, ClampedCube) {
  Model m = box_model({10, 10, 10}, 1.0, 3.0);
  fix_face(m, 0, false, 3, {0, 1, 2});
  expect_every_engine_complete<3>(m, 20);
}

TEST(Completeness, FreeSquare) { expect_every_engine_complete<2>(box_model({30, 30}, 1.0, 3.0), 20); }

TEST(Completeness, CubeHeldOnAllSides) {
  Model m = box_model({11, 11, 11}, 1.0, 2.0);
  for (int axis : {0, 1, 2}) {
    for (bool upper : {false, true}) fix_face(m, axis, upper, 2, {0, 1, 2});
  }
  expect_every_engine_complete<3>(m, 30);
}

// Two equal plates, cut apart: every level twice, six rigid motions.
TEST(Completeness, TwoEqualPieces) {
  Model m = box_model({32, 14}, 1.0, 3.0);
  test::add_crack(m, {{16.0, -1.0}, {16.0, 15.0}});
  expect_every_engine_complete<2>(m, 24);
}

TEST(Completeness, RangeCountsEveryCopyOfALevel) {
  Model m = box_model({8, 8, 8}, 0.125, 2.0);
  m.volume_correction = VolumeCorrection::linear;
  m.periodic = {true, true, true};
  ModalOptions range;
  // Levels 6.6867 (16 copies) and 6.9894 (6) rad/s lie inside, 5.7582 and 7.1603 outside.
  range.range = {6.5 / 6.283185307179586, 7.1 / 6.283185307179586};
  for (auto solver : {ModalSolver::lanczos, ModalSolver::arpack, ModalSolver::dense}) {
    range.solver = solver;
    const auto r = certified_modes<3>(m, range);
    EXPECT_EQ(r.count(), 22) << r.solver;
  }
}

}  // namespace
}  // namespace perimode
