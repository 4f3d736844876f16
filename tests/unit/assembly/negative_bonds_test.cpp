// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <string>

#include "breaking_models.hpp"
#include "operator_checks.hpp"
#include "perimode/assembly/bond_forces.hpp"
#include "perimode/assembly/critical_stretches.hpp"
#include "perimode/assembly/multigrid.hpp"
#include "perimode/linalg/conjugate_gradients.hpp"

namespace perimode {
namespace {

using test::box_model;
using test::expect_forms_equal_the_matrix;
using test::for_negative_bodies;
using test::random_shells;
using test::random_vector;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(NegativeBonds, EveryFormEqualsTheMatrix) {
  const auto check = [](const auto& body) { expect_forms_equal_the_matrix(body); };
  for_negative_bodies<1>(40, check);
  for_negative_bodies<2>(40, check);
  for_negative_bodies<3>(15, check);
}

/// Bond by bond, independently of the matrix: where nothing is fixed K x is the internal force.
template <int Dim>
void expect_internal_forces(const Model& model) {
  const Body<Dim> body = build_body<Dim>(model);
  const Eigen::VectorXd x = random_vector(body.boundary.free, 3);
  const auto u = body.boundary.expand(x.data());
  const Eigen::VectorXd force =
      internal_force(body, Eigen::Map<const Eigen::VectorXd>(u.data(), static_cast<Eigen::Index>(u.size())));
  const Eigen::VectorXd y = multiply(stiffness_operator(body), x);
  // As expect_forms_equal_the_matrix: round-off of some hundred products whose sizes add up to `sizes`.
  EXPECT_TRUE(((y - force).array().abs() <= 2e-14 * test::sizes(body, x).array()).all());
}

TEST(NegativeBonds, TheStencilIsTheSumOverBonds) {
  Model plane = box_model({40, 30}, 0.5, 3.0);
  plane.periodic[0] = true;
  plane.material.micromodulus = random_shells<2>(0.5, 1.5, 5);
  test::add_crack(plane, {{5.0, -0.1}, {5.0, 6.5}});
  expect_internal_forces<2>(plane);
  Model solid = box_model({11, 12, 13}, 0.5, 2.5);
  solid.material.micromodulus = random_shells<3>(0.5, 1.25, 6);
  expect_internal_forces<3>(solid);
  Model bar = box_model({50}, 0.5, 4.0);
  bar.material.micromodulus = random_shells<1>(0.5, 2.0, 7);
  expect_internal_forces<1>(bar);
}

/// x^T K x <= 2 x^T D x with D of |k|, and no eigenvalue of K beyond Gershgorin's bound.
TEST(NegativeBonds, SmoothersAndBoundsHold) {
  for_negative_bodies<2>(12, [](const Body<2>& body) {
    const Index n = body.boundary.free;
    if (n == 0) return;
    const Eigen::MatrixXd k =
        multiply(stiffness_operator(body), Eigen::MatrixXd(Eigen::MatrixXd::Identity(n, n)));
    if ((k - k.transpose()).cwiseAbs().maxCoeff() > 1e-12 * k.cwiseAbs().maxCoeff()) return;
    const Eigen::VectorXd lambda = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues();
    EXPECT_LE(lambda.cwiseAbs().maxCoeff(), stiffness_bound(body) * (1.0 + 1e-12));
    const std::vector<double> blocks = absolute_blocks(body);
    Eigen::MatrixXd twice = Eigen::MatrixXd::Zero(n, n);
    for (std::size_t d = 0; d < body.boundary.free_number.size(); ++d) {
      for (std::size_t e = d / 2 * 2; e < d / 2 * 2 + 2; ++e) {
        const Index row = body.boundary.free_number[d], column = body.boundary.free_number[e];
        if (row >= 0 && column >= 0) twice(row, column) = 2.0 * blocks[d * 2 + e % 2];
      }
    }
    const double least = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(twice - k).eigenvalues().minCoeff();
    EXPECT_GE(least, -1e-12 * lambda.cwiseAbs().maxCoeff());
  });
}

/// The optimised plane between two held layers: multigrid and block Jacobi find what conjugate gradients
/// without either find.
TEST(NegativeBonds, PreconditionedGradientsConverge) {
  Model m = box_model({64, 64}, 1.0 / 64, 2.0);
  m.plane = Plane::strain;
  m.periodic = {true, true, false};
  m.material.micromodulus = test::optimised_two();
  test::fix_face(m, 0, false, 2, {0, 1});
  const Body<2> body = build_body<2>(m);
  const LinearOperator k = stiffness_operator(body);
  const Eigen::VectorXd b = random_vector(body.boundary.free, 2);
  const CgResult plain = conjugate_gradients(k, b, {}, {.tolerance = 1e-10});
  ASSERT_TRUE(plain.converged) << plain.message;
  const LinearOperator jacobi = block_jacobi(absolute_blocks(body), 2, body.boundary.free_number);
  const LinearOperator cycle = multigrid(body, k, {.coarsest_dofs = 300}).preconditioner;
  for (const LinearOperator* with : {&jacobi, &cycle}) {
    const CgResult found = conjugate_gradients(k, b, *with, {.tolerance = 1e-10});
    ASSERT_TRUE(found.converged) << found.message;
    // Residuals of 1e-10 through a condition number below 1e4.
    EXPECT_LT((found.x - plain.x).norm(), 1e-6 * plain.x.norm());
    if (with == &cycle) {
      EXPECT_LT(found.iterations, plain.iterations / 2);
    }
  }
}

/// Small turning forces are K u; the linear ones are to round-off.
TEST(NegativeBonds, ForcesOfBreakableBondsAreThoseOfTheStencil) {
  for_negative_bodies<2>(10, [](Body<2> body) {
    BondForces<2> forces(body, Kinematics::linear, std::vector<double>(body.density.size(), 100.0));
    const Eigen::VectorXd x = 1e-3 * random_vector(body.boundary.free, 4);
    const Eigen::VectorXd expected = multiply(stiffness_operator(body), x);
    const Eigen::VectorXd y = multiply(as_operator(forces.product()), x);
    EXPECT_TRUE(((y - expected).array().abs() <= 4e-14 * test::sizes(body, x).array()).all());
    EXPECT_EQ(forces.broken(), 0);
  });
}

TEST(NegativeBonds, BetweenBlocksOfOppositeSignAreRefused) {
  Model m = box_model({12, 8}, 0.5, 2.0);
  m.blocks.push_back({"half", Region{BoxRegion{{0.0, 0.0}, {3.0, 4.0}}, {}}});
  m.material.micromodulus = test::optimised_two();
  m.block_materials["half"] = m.material;
  m.block_materials["half"].youngs_modulus = 2.0;
  EXPECT_NO_THROW((void)build_body<2>(m));
  m.block_materials["half"].micromodulus = {Kernel::constant};
  EXPECT_THAT([&] { (void)build_body<2>(m); },
              ThrowsMessage<Error>(AllOf(HasSubstr("one sign for the bonds between two blocks"))));
}

/// Two blocks whose micromoduli are both 0 at the horizon, as those of the conical kernel are.
TEST(NegativeBonds, BondsBetweenBlocksThatHaveNoStiffnessCarryNoForce) {
  Model m = box_model({12, 8}, 0.5, 2.0);
  m.blocks.push_back({"half", Region{BoxRegion{{0.0, 0.0}, {3.0, 4.0}}, {}}});
  m.material.micromodulus = {Kernel::conical};
  m.block_materials["half"] = m.material;
  m.block_materials["half"].youngs_modulus = 2.0;
  Body<2> body = build_body<2>(m);
  BondForces<2> forces(body, Kinematics::linear, {100.0, 100.0});
  const Eigen::VectorXd x = 1e-3 * random_vector(body.boundary.free, 4);
  const Eigen::VectorXd y = multiply(as_operator(forces.product()), x);
  const Eigen::VectorXd expected = multiply(stiffness_operator(body), x);
  EXPECT_TRUE(((y - expected).array().abs() <= 4e-14 * test::sizes(body, x).array()).all());
}

TEST(NegativeBonds, LatticeKernelsAreRefusedWhereTheyDoNotFit) {
  Model m = box_model({12, 8}, 0.5, 2.0);
  m.material.micromodulus = test::optimised_two();
  m.calibration = Calibration::discrete;
  EXPECT_THAT([&] { (void)build_body<2>(m); }, ThrowsMessage<Error>(HasSubstr("calibration continuum")));
  m.calibration = Calibration::continuum;
  m.volume_correction = VolumeCorrection::linear;
  EXPECT_THAT([&] { (void)build_body<2>(m); }, ThrowsMessage<Error>(HasSubstr("volume_correction none")));
  m.volume_correction = VolumeCorrection::none;
  m.horizon.value = 3.0;
  EXPECT_THAT([&] { (void)build_body<2>(m); }, ThrowsMessage<Error>(HasSubstr("none for (2, 1)")));
  test::BreakingCloud cloud(2);
  cloud.model.material.micromodulus = {Kernel::fourier, 2.0, 1.0, {0.5}, 1.0, 0.5};
  EXPECT_THAT([&] { (void)build_body<2>(cloud.model); },
              ThrowsMessage<Error>(AllOf(HasSubstr("a grid for the kernel fourier"), HasSubstr("a cloud"))));
}

TEST(NegativeBonds, BreakOnlyWhenAskedTo) {
  Model m = box_model({12, 8}, 0.5, 2.0);
  m.plane = Plane::strain;
  m.material.micromodulus = test::optimised_two();
  const Body<2> body = build_body<2>(m);
  EXPECT_TRUE(std::isinf(critical_stretches(m, body)[0]));
  m.material.critical_stretch = 0.01;
  EXPECT_THAT([&] { (void)critical_stretches(m, body); },
              ThrowsMessage<Error>(AllOf(HasSubstr("negative energy"), HasSubstr("break_negative: true"))));
  m.material.break_negative = true;
  const auto stretches = critical_stretches(m, body);
  EXPECT_EQ(stretches[0], 0.01);
  EXPECT_TRUE(negative_bonds_may_break(body, stretches));
  // Fracture energy: (2, 0) counts twice, along axes alone, so what is left is hand arithmetic.
  m.material.critical_stretch.reset();
  m.material.fracture_energy = 1e-3;
  const double c0 = micromodulus_constant(m.material.micromodulus, 1.0, 1.0, {2, Plane::strain, 1.0});
  const double sum = 8.1746376428 * 1.0 * 1.0 + 2.0 * 1.4809609794 * std::sqrt(2.0) * 1.0 -
                     3.0401212702 * 2.0 * 2.0;  // alpha r xi_x in spacings
  const double h = 0.5;
  EXPECT_NEAR(sum, 0.2, 0.05);  // nearly nothing
  const double expected = std::sqrt(2.0 * 1e-3 / (c0 * sum * h * h * h * h));
  EXPECT_NEAR(critical_stretches(m, body)[0], expected, 1e-12 * expected);
  for (Shell& shell : m.material.micromodulus.shells)
    if (shell.offset[0] == 2) shell.alpha = -4.0;
  EXPECT_THAT([&] { (void)critical_stretches(m, body); },
              ThrowsMessage<Error>(HasSubstr("store energy where a crack crosses")));
}

}  // namespace
}  // namespace perimode
