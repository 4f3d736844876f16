// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/modal/solver_choice.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "perimode/assembly/assemble.hpp"
#include "perimode/core/error.hpp"
#include "perimode/linalg/factor.hpp"
#include "perimode/modal/plan.hpp"
#include "support/models.hpp"

namespace perimode {
namespace {

using test::box_model;
using test::fix_face;

/// A box clamped at one face, the size that the cost model sees and the fill that an ordering really gives.
template <int Dim>
struct Sample {
  explicit Sample(const std::vector<int>& cells) : body(make(cells)), size(modal_size(body, true)) {}

  static Body<Dim> make(const std::vector<int>& cells) {
    Model m = box_model(cells, 0.1, 3.0);
    std::vector<int> all;
    for (int a = 0; a < Dim; ++a) all.push_back(a);
    fix_face(m, 0, false, 3, all);
    return build_body<Dim>(m);
  }
  [[nodiscard]] FillEstimate fill() const {
    const Csr k = scalar_csr(assemble_stiffness(body), body.boundary.free_number);
    const Eigen::Map<const Eigen::MatrixXd> place(body.particles.position[0].data(), Dim, body.count());
    return predict_fill_with_order(k, dissection_order(k, particle_of_free_dof(body), place));
  }

  Body<Dim> body;
  ModalSize size;
};

TEST(SolverChoice, CountsWhatABodyHas) {
  const Sample<2> plate({30, 20});
  EXPECT_EQ(plate.size.dofs, 27 * 20 * 2);
  EXPECT_EQ(plate.size.particles, 27 * 20);
  EXPECT_NEAR(plate.size.cells[0], 27.0, 1e-9);
  EXPECT_NEAR(plate.size.cells[1], 20.0, 1e-9);
  EXPECT_EQ(plate.size.reach, 3.0);
  EXPECT_LT(plate.size.bond_ends, 27.0 * 20.0 * 28.0);
  EXPECT_GT(plate.size.bond_ends, 21.0 * 14.0 * 28.0);
}

template <int Dim>
void expect_fill_within(double factor, const std::vector<int>& cells) {
  const Sample<Dim> sample(cells);
  const FillEstimate truth = sample.fill();
  const DissectionCost model = dissection_cost(sample.size.cells, sample.size.reach, Dim);
  EXPECT_LT(model.nonzeros, factor * static_cast<double>(truth.nonzeros));
  EXPECT_GT(model.nonzeros, static_cast<double>(truth.nonzeros) / factor);
  EXPECT_LT(model.flops, factor * factor * truth.flops);
  EXPECT_GT(model.flops, truth.flops / (factor * factor));
}

TEST(SolverChoice, PredictsTheFillOfBoxes) {
  expect_fill_within<2>(1.5, {60, 60});
  expect_fill_within<2>(1.6, {200, 20});
  expect_fill_within<3>(1.5, {13, 13, 13});
  expect_fill_within<3>(1.6, {30, 8, 6});
}

TEST(SolverChoice, WeighsTheSolversAndSaysWhy) {
  const Sample<3> block({16, 16, 16});
  const SolverChoice in_3d = choose_solver(block.size, 1.0, {});
  EXPECT_EQ(in_3d.engine, ModalSolver::chebyshev);
  ASSERT_EQ(in_3d.considered.size(), 3U);
  EXPECT_LE(in_3d.considered[0].seconds, in_3d.considered[1].seconds);
  EXPECT_THAT(in_3d.reason, testing::HasSubstr("lanczos"));

  ModalSize bar;  // long and thin: a factor costs next to nothing, an iteration sees a condition of 1e7
  bar.dimension = 1;
  bar.dofs = bar.particles = bar.cells[0] = 10000;
  bar.bond_ends = 6 * bar.particles;
  EXPECT_EQ(choose_solver(bar, 1.0, {}).engine, ModalSolver::lanczos);

  ModalOptions inside;
  inside.range = {1.0, 2.0};
  EXPECT_EQ(choose_solver(block.size, 1.0, inside).engine, ModalSolver::lanczos);
  ModalOptions inertia;
  inertia.certificate = CertificateMethod::inertia;
  EXPECT_EQ(choose_solver(block.size, 1.0, inertia).engine, ModalSolver::lanczos);
  inertia.solver = ModalSolver::chebyshev;
  EXPECT_THROW((void)choose_solver(block.size, 1.0, inertia), Error);
}

TEST(SolverChoice, KeepsWithinTheMemoryLimit) {
  ModalSize bar;
  bar.dimension = 1;
  bar.dofs = bar.particles = bar.cells[0] = 1e6;
  bar.bond_ends = 6 * bar.particles;
  ModalOptions options;
  const SolverChoice freely = choose_solver(bar, 1.0, options);
  ASSERT_EQ(freely.engine, ModalSolver::lanczos);
  options.memory_limit = 0.99 * freely.considered[0].bytes;
  ASSERT_LT(freely.considered[1].bytes, options.memory_limit);
  EXPECT_EQ(choose_solver(bar, 1.0, options).engine, ModalSolver::chebyshev);
}

}  // namespace
}  // namespace perimode
