// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/dynamics/shifted_solver.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "dense_motion.hpp"
#include "perimode/core/error.hpp"
#include "support/models.hpp"

namespace perimode {
namespace {

Body<2> plate() {
  Model model = test::box_model({14, 11}, 0.1, 2.0);
  test::fix_face(model, 0, false, 1, {0});
  return build_body<2>(model);
}

template <int Dim>
std::string chosen(const Body<Dim>& body, bool symmetric, ImplicitSolver which, double ratio) {
  return plan_shifted_solver(body, symmetric, which, ratio, 1e-12).description;
}

TEST(ShiftedSolver, FactorAndIterationsSolveTheSameEquations) {
  const Body<2> body = plate();
  const Eigen::MatrixXd k = test::dense_stiffness(body);
  const Eigen::Index n = k.rows();
  const Eigen::VectorXd d = Eigen::VectorXd::LinSpaced(n, 0.5, 1.5);
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(n, -1.0, 2.0);
  const Eigen::VectorXd exact = (k + Eigen::MatrixXd(d.asDiagonal())).ldlt().solve(b);
  for (const ImplicitSolver which : {ImplicitSolver::factor, ImplicitSolver::cg}) {
    std::string description;
    const ShiftedSolve solve =
        make_shifted_solver(body, stiffness_operator(body), true, which, 5.0, 1e-12, description)(d);
    EXPECT_THAT(description, testing::HasSubstr("asked for"));
    Eigen::VectorXd x;
    const int iterations = solve(b, Eigen::VectorXd::Zero(n), x);
    EXPECT_EQ(iterations > 0, which == ImplicitSolver::cg);
    EXPECT_LT((x - exact).norm(), 1e-11 * exact.norm());
    EXPECT_LE(solve(b, exact, x), iterations / 4);
    // A right-hand side that is no number is answered in kind, for the run to end as unstable.
    solve(std::numeric_limits<double>::infinity() * b, exact, x);
    EXPECT_TRUE(x.array().isNaN().all());
  }
}

TEST(ShiftedSolver, SameTrajectoryByFactorAndByIterations) {
  const Body<2> body = plate();
  const Motion motion = test::free_motion(body);
  const Eigen::Index n = motion.mass.size();
  Eigen::VectorXd reached;
  for (const ImplicitSolver which : {ImplicitSolver::factor, ImplicitSolver::cg}) {
    std::string description;
    const auto scheme =
        newmark(motion, 0.5, {},
                make_shifted_solver(body, stiffness_operator(body), true, which, 5.0, 1e-13, description));
    scheme->start(Eigen::VectorXd::LinSpaced(n, 0.0, 1.0), Eigen::VectorXd::Zero(n));
    for (int step = 0; step < 200; ++step) scheme->advance(step == 199);
    if (which == ImplicitSolver::factor) reached = scheme->displacement();
    EXPECT_LT((scheme->displacement() - reached).norm(), 1e-10 * reached.norm());
    EXPECT_LT(std::abs(scheme->energies().balance()), 1e-11 * scheme->energies().initial);
  }
}

TEST(ShiftedSolver, ChoosesByCountedCost) {
  const Body<2> body = plate();
  EXPECT_THAT(chosen(build_body<1>(test::box_model({50}, 0.1, 3.0)), true, ImplicitSolver::automatic, 5.0),
              testing::StartsWith("cholesky: the factor of a bar"));
  EXPECT_THAT(chosen(body, true, ImplicitSolver::automatic, 1000.0), testing::StartsWith("cholesky: about"));
  EXPECT_THAT(
      chosen(build_body<3>(test::box_model({12, 12, 12}, 0.1, 2.0)), true, ImplicitSolver::automatic, 1.0),
      testing::StartsWith("cg block jacobi: about"));
  EXPECT_THAT(chosen(body, false, ImplicitSolver::automatic, 1.0), testing::StartsWith("lu"));
  EXPECT_THROW((void)chosen(body, false, ImplicitSolver::cg, 1.0), Error);
}

TEST(ShiftedSolver, RefusesAStiffnessThatIsNoneInAFactor) {
  Body<2> body = plate();
  for (double& c : body.constants.kernel) c = -c;
  std::string description;
  const ShiftedSolver solver = make_shifted_solver(body, stiffness_operator(body), true,
                                                   ImplicitSolver::factor, 5.0, 1e-12, description);
  EXPECT_THROW((void)solver(Eigen::VectorXd::Constant(body.boundary.free, 1e-3)), Error);
}

}  // namespace
}  // namespace perimode
