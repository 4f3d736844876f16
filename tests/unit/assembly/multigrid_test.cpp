// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/assembly/multigrid.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <random>
#include <string>

#include "grid_models.hpp"
#include "perimode/assembly/assemble.hpp"
#include "perimode/assembly/operators.hpp"
#include "perimode/core/error.hpp"
#include "perimode/linalg/conjugate_gradients.hpp"
#include "perimode/linalg/factor.hpp"
#include "perimode/linalg/threads.hpp"

namespace perimode {
namespace {

/// A shear and a pull on the last layer of the right face.
template <int Dim>
Eigen::VectorXd load_on_the_right(const Body<Dim>& body) {
  Eigen::VectorXd b = Eigen::VectorXd::Zero(body.boundary.free);
  const Grid<Dim>& grid = *body.particles.grid;
  for (Index i = 0; i < body.count(); ++i) {
    if (body.particles.position[i][0] < grid.upper()[0] - grid.spacing) continue;
    for (int a = 0; a < Dim; ++a) {
      const Index free = body.boundary.free_number[static_cast<std::size_t>(i) * Dim + a];
      if (free >= 0) b[free] = a == Dim - 1 ? 1.0 : 0.3;
    }
  }
  return b;
}

template <int Dim>
CgResult solve(const Body<Dim>& body, const Eigen::VectorXd& b, const MultigridOptions& options) {
  const LinearOperator k = stiffness_operator(body);
  return conjugate_gradients(k, b, multigrid(body, k, options).preconditioner,
                             {.tolerance = 1e-8, .most_iterations = 200});
}

/// The whole spectrum of the V-cycle: symmetric to round-off and positive.
TEST(Multigrid, IsSymmetricPositiveDefinite) {
  for (const auto& cells : {std::pair{16, 16}, {15, 17}}) {
    for (const auto& [name, m] : test::plane_models(cells.first, cells.second)) {
      const auto body = build_body<2>(m);
      const LinearOperator k = stiffness_operator(body);
      const Multigrid mg = multigrid(body, k, {.coarsest_dofs = 40});
      EXPECT_EQ(mg.dofs.size(), 3U) << name;
      const Index n = k.size;
      const Eigen::MatrixXd dense =
          multiply(mg.preconditioner, Eigen::MatrixXd(Eigen::MatrixXd::Identity(n, n)));
      // A shifted coarsest level (free, periodic) answers 1e8 times louder than the rest.
      EXPECT_LT((dense - dense.transpose()).cwiseAbs().maxCoeff(), 1e-13 * dense.cwiseAbs().maxCoeff())
          << name;
      const Eigen::VectorXd values =
          Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense, Eigen::EigenvaluesOnly).eigenvalues();
      const double round_off = name == "free" || name == "periodic" ? 1e-14 * values.maxCoeff() : 0.0;
      EXPECT_GT(values.minCoeff(), -round_off) << name;
    }
  }
}

/// No eigenvalue of D^-1 K lies above 2, also where bonds are broken down to pairs and single particles: the
/// bound that the smoother rests on. K and its coarse ones are singular then.
TEST(Multigrid, StaysPositiveWhereNearlyAllBondsAreBroken) {
  for (const double share : {0.3, 0.6, 0.8}) {
    auto body = build_body<2>(test::clamped({16, 16}));
    std::mt19937 random(11);
    std::bernoulli_distribution broken(share);
    for (Index i = 0; i < body.count(); ++i) {
      for (int k = 0; k < std::get<GridBonds<2>>(body.bonds).family.size(); ++k)
        if (broken(random)) break_bond(body.bonds, i, k);
    }
    const LinearOperator k = stiffness_operator(body);
    const Index n = k.size;
    const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(n, n);
    const LinearOperator jacobi = block_jacobi(diagonal_blocks(body), 2, body.boundary.free_number);
    const Eigen::MatrixXd stiffness = multiply(k, identity), inverse = multiply(jacobi, identity);
    const Eigen::VectorXd scaled = Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(
                                       stiffness, inverse.inverse(), Eigen::EigenvaluesOnly)
                                       .eigenvalues();
    EXPECT_LT(scaled.maxCoeff(), 2.0 * (1.0 + 1e-12)) << share;
    const Eigen::MatrixXd cycle =
        multiply(multigrid(body, k, {.coarsest_dofs = 40}).preconditioner, identity);
    const Eigen::VectorXd values =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(cycle, Eigen::EigenvaluesOnly).eigenvalues();
    EXPECT_GT(values.minCoeff(), -1e-14 * values.maxCoeff()) << share;  // 1e8 of a shift times round-off
  }
}

template <int Dim>
void expect_symmetric_and_positive(const Model& m, const char* name) {
  const auto body = build_body<Dim>(m);
  const LinearOperator k = stiffness_operator(body);
  const Multigrid mg = multigrid(body, k, {.coarsest_dofs = 200});
  EXPECT_GE(mg.dofs.size(), 2U) << name;
  EXPECT_LT(asymmetry(mg.preconditioner), 1e-13) << name;
  for (unsigned seed = 0; seed < 5; ++seed) {
    const Eigen::VectorXd x = test::random_vector(k.size, seed);
    EXPECT_GT(x.dot(multiply(mg.preconditioner, x)), 0.0) << name;
    const Eigen::VectorXd rough = multiply(k, multiply(k, x));  // the upper end of the spectrum
    EXPECT_GT(rough.dot(multiply(mg.preconditioner, rough)), 0.0) << name;
  }
}

TEST(Multigrid, IsSymmetricPositiveDefiniteInSpaceAndOnALine) {
  expect_symmetric_and_positive<3>(test::clamped({10, 9, 8}), "clamped");
  expect_symmetric_and_positive<3>(test::box({9, 8, 8}), "free");
  for (const WallType type : {WallType::mirror, WallType::antimirror, WallType::zero_layer}) {
    Model m = test::box({9, 8, 7});
    for (int a = 0; a < 3; ++a) test::add_walls(m, a, type);
    expect_symmetric_and_positive<3>(m, "walls");
  }
  Model m = test::clamped({10, 9, 8});
  m.periodic = {false, true, true};
  test::add_crack(m, {{0.5, -0.1, -0.1}, {0.5, 0.5, -0.1}, {0.5, 0.5, 0.9}, {0.5, -0.1, 0.9}});
  expect_symmetric_and_positive<3>(m, "cracked periodic");
  expect_symmetric_and_positive<1>(test::clamped({1001}), "line");
}

template <int Dim>
void expect_the_solution_of_a_factor(const Model& m, const std::string& name) {
  const auto body = build_body<Dim>(m);
  const Csr k = scalar_csr(assemble_stiffness(body), body.boundary.free_number);
  CholeskyFactor factor(k, particle_of_free_dof(body));
  ASSERT_EQ(factor.factorize(k, 0.0, Eigen::VectorXd::Zero(k.rows)), FactorStatus::done) << name;
  const Eigen::VectorXd b = load_on_the_right(body);
  const Eigen::VectorXd exact = factor.solve(b);
  const LinearOperator a = stiffness_operator(body);
  const Multigrid mg = multigrid(body, a, {.coarsest_dofs = 200});
  // The error is up to the condition number, 1e4 here, times the residual.
  const CgResult r = conjugate_gradients(a, b, mg.preconditioner, {.tolerance = 1e-12});
  EXPECT_TRUE(r.converged) << name << ": " << r.message;
  EXPECT_LT((r.x - exact).norm(), 1e-8 * exact.norm()) << name;
}

TEST(Multigrid, LeadsToTheSolutionOfACholeskyFactor) {
  for (const auto& [name, m] : test::plane_models(24, 23)) {
    if (name == "free" || name == "periodic") continue;  // singular
    expect_the_solution_of_a_factor<2>(m, name);
  }
  expect_the_solution_of_a_factor<3>(test::clamped({10, 9, 8}), "3D");
  expect_the_solution_of_a_factor<1>(test::clamped({999}), "1D");
}

/// Rigid motions are the null space; b = K x has no part in it.
TEST(Multigrid, SolvesFreeBodies) {
  for (const auto& m : {test::box({48, 48}), test::box({45, 47})}) {
    const auto body = build_body<2>(m);
    const CgResult r =
        solve(body, multiply(stiffness_operator(body), test::random_vector(body.boundary.free, 5)),
              {.coarsest_dofs = 500});
    EXPECT_TRUE(r.converged) << r.message;
    EXPECT_LE(r.iterations, 15);
  }
}

/// Measured when written: 2D 8, 9, 10, 11; 3D 8, 8, 9 iterations.
TEST(Multigrid, TakesNearlyTheSameIterationsForAnySize) {
  for (const int n : {32, 64, 128, 256}) {
    const auto body = build_body<2>(test::clamped({n, n}));
    const CgResult r = solve(body, load_on_the_right(body), {.coarsest_dofs = 500});
    EXPECT_TRUE(r.converged) << r.message;
    EXPECT_LE(r.iterations, 14) << n;
  }
  for (const int n : {8, 16, 32}) {
    const auto body = build_body<3>(test::clamped({n, n, n}));
    const CgResult r = solve(body, load_on_the_right(body), {.coarsest_dofs = 500});
    EXPECT_TRUE(r.converged) << r.message;
    EXPECT_LE(r.iterations, 14) << n;
  }
}

TEST(Multigrid, HoldsOutWithCracksAndBrokenBonds) {
  for (const int n : {64, 101, 128}) {
    Model m = test::clamped({n, n});
    test::add_crack(m, {{0.5, -0.1}, {0.5, 0.7}});
    auto body = build_body<2>(m);
    const CgResult cracked = solve(body, load_on_the_right(body), {.coarsest_dofs = 500});
    EXPECT_TRUE(cracked.converged) << n << ": " << cracked.message;
    EXPECT_LT(cracked.iterations, 60) << n;
    std::mt19937 random(7);
    std::bernoulli_distribution broken(0.15);  // of both ends: more than a quarter of the bonds
    const int size = std::get<GridBonds<2>>(body.bonds).family.size();
    for (Index i = 0; i < body.count(); ++i) {
      for (int k = 0; k < size; ++k) {
        if (body.particles.position[i][0] > 0.3 && broken(random)) break_bond(body.bonds, i, k);
      }
    }
    const CgResult damaged = solve(body, load_on_the_right(body), {.coarsest_dofs = 500});
    EXPECT_TRUE(damaged.converged) << n << ": " << damaged.message;
    EXPECT_LT(damaged.iterations, 60) << n;
  }
}

TEST(Multigrid, GivesTheSameBitsForAnyNumberOfThreads) {
  Model m = test::clamped({97, 90});
  std::get<GridSpec>(m.particles).remove.push_back(Region{BallRegion{{0.5, 0.4}, 0.15}, {}});
  test::add_wall(m, 1, false, WallType::mirror);
  const auto body = build_body<2>(m);
  const Eigen::VectorXd b = test::random_vector(body.boundary.free, 9);
  const LinearOperator k = stiffness_operator(body);
  const int before = threads();
  set_threads(1);
  const Eigen::VectorXd one = multiply(multigrid(body, k).preconditioner, b);
  set_threads(2);
  const Eigen::VectorXd two = multiply(multigrid(body, k).preconditioner, b);
  set_threads(before);
  EXPECT_EQ(one, two);
}

TEST(Multigrid, FactorsBodiesTooSmallOrTooThinToCoarsen) {
  for (const auto& cells : {std::vector<int>{10, 10}, {900, 3}}) {
    const auto body = build_body<2>(test::clamped(cells));
    const LinearOperator k = stiffness_operator(body);
    const Multigrid mg = multigrid(body, k);
    EXPECT_EQ(mg.dofs, std::vector<Index>{k.size});
    const CgResult r = conjugate_gradients(k, test::random_vector(k.size, 3), mg.preconditioner, {});
    EXPECT_TRUE(r.converged) << r.message;
    EXPECT_LE(r.iterations, 2);  // a slender strip loses digits in its factor
  }
}

TEST(Multigrid, RefusesWhatDoesNotBelongTogether) {
  const auto body = build_body<2>(test::clamped({16, 16}));
  EXPECT_THROW((void)multigrid(body, LinearOperator{3, {}}), Error);
  EXPECT_THROW((void)multigrid(body, stiffness_operator(body), {.smoothing = 0}), Error);
}

}  // namespace
}  // namespace perimode
