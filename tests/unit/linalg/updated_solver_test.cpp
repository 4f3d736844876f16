// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/linalg/updated_solver.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <memory>
#include <numeric>
#include <random>

#include "bond_terms.hpp"
#include "matrices.hpp"
#include "perimode/core/error.hpp"
#include "perimode/linalg/conjugate_gradients.hpp"
#include "support/models.hpp"

namespace perimode {
namespace {

using test::chosen;
using test::no_columns;

/// A plate held at its left edge, its bonds in random order, and the matrix as it loses them.
struct Plate {
  Csr k;
  std::vector<Index> order;
  SparseColumns bonds;
  std::vector<Index> sequence;

  explicit Plate(int n) {
    Model m = test::box_model({n, n}, 1.0 / n, 3.0);
    test::fix_face(m, 0, false, 3, {0, 1});
    const auto body = build_body<2>(m);
    k = scalar_csr(assemble_stiffness(body), body.boundary.free_number, Zeros::keep);
    order = dissection_order(k, particle_of_free_dof(body), particle_positions(body));
    bonds = test::bond_terms(body, [](Index, Index) { return true; });
    sequence.resize(bonds.count());
    std::iota(sequence.begin(), sequence.end(), 0);
    std::shuffle(sequence.begin(), sequence.end(), std::mt19937(7));
  }

  [[nodiscard]] SparseColumns some(Index first, Index count) const {
    return chosen(bonds, {sequence.begin() + first, sequence.begin() + first + count});
  }
};

Eigen::MatrixXd loads(Index n, int columns) {
  return Eigen::MatrixXd::NullaryExpr(
      n, columns, [](Eigen::Index i, Eigen::Index j) { return std::sin(1.0 + 3.0 * i + 0.1 * j * i); });
}

Eigen::MatrixXd exact(const Csr& k, const Eigen::MatrixXd& b) { return test::dense(k).ldlt().solve(b); }

double residual(const Csr& k, const Eigen::MatrixXd& x, const Eigen::MatrixXd& b) {
  const Eigen::MatrixXd r = b - multiply(k, x);
  return (r.colwise().norm().array() / b.colwise().norm().array()).maxCoeff();
}

constexpr UpdatedSolverOptions tight = {.tolerance = 1e-13};

UpdatedSolverOptions only(SolveWay way) {
  UpdatedSolverOptions options = tight;
  options.only = way;
  return options;
}

TEST(UpdatedSolver, EveryWayGivesTheSameSolution) {
  const Plate plate(16);
  for (const int columns : {1, 3}) {
    const Eigen::MatrixXd b = loads(plate.k.rows, columns);
    for (const SolveWay way : {SolveWay::update, SolveWay::stale, SolveWay::refactor, SolveWay::iterate}) {
      Csr k = plate.k;
      UpdatedSolver solver(as_operator(k), k, plate.order, only(way));
      Eigen::MatrixXd x;
      Index broken = 0;
      for (const Index count : {0, 1, 10, 60}) {
        const SparseColumns lost = plate.some(broken, count);
        broken += count;
        test::add_products(k, lost, -1.0);
        solver.change(no_columns(k.rows), lost);
        const SolveOutcome outcome = solver.solve(b, x);
        EXPECT_TRUE(outcome.converged) << name(way) << ": " << outcome.message;
        EXPECT_FALSE(outcome.singular);
        EXPECT_EQ(outcome.dof, -1);
        EXPECT_EQ(outcome.way, count > 0 || way == SolveWay::iterate ? way : SolveWay::refactor);
        EXPECT_NEAR(outcome.residual, residual(k, x, b), 1e-13);
        const Eigen::MatrixXd y = exact(k, b);
        EXPECT_LE((x - y).norm(), 1e-10 * y.norm()) << name(way) << ", " << broken << " broken";
      }
      Offset solves = 0, changed = 0;
      for (const WayTotals& total : solver.totals()) {
        solves += total.solves;
        changed += total.columns;
      }
      EXPECT_EQ(solves, 4);
      EXPECT_EQ(changed, broken);
      EXPECT_EQ(solver.totals()[static_cast<int>(way)].columns, broken) << name(way);
    }
  }
}

/// The policy may take any way: every solution is as good as that of a fresh factor. The load changes now and
/// then, and bonds come back.
TEST(UpdatedSolver, FollowsARandomSequenceOfChanges) {
  const Plate plate(14);
  Csr k = plate.k;
  UpdatedSolver solver(as_operator(k), k, plate.order, tight);
  std::mt19937 random(3);
  Eigen::MatrixXd b = loads(k.rows, 1), x;
  Index broken = 0;
  for (int step = 0; step < 40; ++step) {
    const auto count = static_cast<Index>(step % 7 == 6 ? 40 : random() % 4);
    const SparseColumns lost = plate.some(broken, count);
    const SparseColumns gained = step % 5 == 4 ? plate.some(broken - 1, 1) : no_columns(k.rows);
    broken += count;
    test::add_products(k, lost, -1.0);
    test::add_products(k, gained, 1.0);
    solver.change(gained, lost);
    if (step % 6 == 5) b *= -0.7;
    if (step == 20) b = loads(k.rows, 2);
    const SolveOutcome outcome = solver.solve(b, x);
    ASSERT_TRUE(outcome.converged) << outcome.message;
    EXPECT_LE(outcome.residual, std::max(10.0 * solver.fresh_residual(), 1e-12));
    EXPECT_LE(residual(k, x, b), 2.0 * std::max(10.0 * solver.fresh_residual(), 1e-12));
    const Eigen::MatrixXd y = exact(k, b);
    EXPECT_LE((x - y).norm(), 1e-10 * y.norm()) << "step " << step << " by " << name(outcome.way);
  }
  EXPECT_GT(solver.factor_seconds(), 0.0);
  EXPECT_GT(solver.factor_nonzeros(), k.rows);
}

/// With the load unchanged only the rows that changed are taken through the forward substitution; the error
/// that stays in x from before never grows over what the check of the residual lets pass.
TEST(UpdatedSolver, CorrectsTheLastSolutionHundredsOfTimes) {
  const Plate plate(20);
  Csr k = plate.k;
  UpdatedSolver solver(as_operator(k), k, plate.order, only(SolveWay::update));
  const Eigen::MatrixXd b = loads(k.rows, 1);
  Eigen::MatrixXd x;
  static_cast<void>(solver.solve(b, x));
  for (Index bond = 0; bond < 300; ++bond) {
    const SparseColumns lost = plate.some(bond, 1);
    test::add_products(k, lost, -1.0);
    solver.change(no_columns(k.rows), lost);
    const SolveOutcome outcome = solver.solve(b, x);
    ASSERT_EQ(outcome.way, SolveWay::update);
    ASSERT_LE(outcome.residual, std::max(10.0 * solver.fresh_residual(), 1e-12));
  }
  const Eigen::MatrixXd y = exact(k, b);
  EXPECT_LE((x - y).norm(), 1e-10 * y.norm());
}

/// A wrong guess is not built upon.
TEST(UpdatedSolver, TakesAnyGuess) {
  const Plate plate(12);
  Csr k = plate.k;
  UpdatedSolver solver(as_operator(k), k, plate.order, only(SolveWay::update));
  const Eigen::MatrixXd b = loads(k.rows, 1);
  Eigen::MatrixXd x;
  static_cast<void>(solver.solve(b, x));
  for (const double guess : {0.0, 1e12, std::numeric_limits<double>::quiet_NaN()}) {
    x.setConstant(guess);
    ASSERT_TRUE(solver.solve(b, x).converged);
    EXPECT_LE((x - exact(k, b)).norm(), 1e-10 * x.norm());
  }
}

/// A chain held at both ends that loses two springs: the masses between float, until one spring is back.
TEST(UpdatedSolver, NamesTheLooseDofAndRecovers) {
  constexpr Index n = 40;
  for (const std::optional<SolveWay> way :
       {std::optional<SolveWay>(), {SolveWay::update}, {SolveWay::stale}, {SolveWay::refactor}}) {
    UpdatedSolverOptions options = tight;
    options.only = way;
    options.most_iterations = 200;
    Csr k = test::chain(n, true);
    std::vector<Index> order(n);
    std::iota(order.begin(), order.end(), 0);
    UpdatedSolver solver(as_operator(k), k, order, options);
    const Eigen::MatrixXd b = loads(n, 1);
    Eigen::MatrixXd x;
    ASSERT_TRUE(solver.solve(b, x).converged);
    SparseColumns springs = no_columns(n);
    test::append(springs, {{9, 1.0}, {10, -1.0}});
    test::append(springs, {{24, 1.0}, {25, -1.0}});
    test::add_products(k, springs, -1.0);
    solver.change(no_columns(n), springs);
    SolveOutcome outcome = solver.solve(b, x);
    EXPECT_TRUE(outcome.singular);
    EXPECT_FALSE(outcome.converged);
    EXPECT_EQ(outcome.dof, 24);  // the last of the floating masses to be eliminated
    EXPECT_FALSE(outcome.message.empty());
    outcome = solver.solve(b, x);  // still singular, seen by a fresh factor
    EXPECT_TRUE(outcome.singular);
    EXPECT_EQ(outcome.dof, 24);

    const SparseColumns first = chosen(springs, {0});
    test::add_products(k, first, 1.0);
    solver.change(first, no_columns(n));
    outcome = solver.solve(b, x);
    EXPECT_FALSE(outcome.singular);
    EXPECT_EQ(outcome.way, SolveWay::refactor);
    EXPECT_LE((x - exact(k, b)).norm(), 1e-10 * x.norm());
  }
}

TEST(UpdatedSolver, ShowsASingularMatrixInTheFirstSolution) {
  const Csr free = test::chain(20, false);
  std::vector<Index> order(20);
  std::iota(order.begin(), order.end(), 0);
  UpdatedSolver solver(as_operator(free), free, order, {});
  Eigen::MatrixXd x;
  const SolveOutcome outcome = solver.solve(loads(20, 1), x);
  EXPECT_TRUE(outcome.singular);
  EXPECT_EQ(outcome.dof, 19);
}

TEST(UpdatedSolver, RefreshedGivesTheBitsOfAnotherThatCameTheSameWay) {
  const Plate plate(12);
  Csr k = plate.k;
  const Eigen::MatrixXd b = loads(k.rows, 2);
  UpdatedSolver busy(as_operator(k), k, plate.order, tight), idle(as_operator(k), k, plate.order, tight);
  Eigen::MatrixXd x, y;
  for (Index bond = 0; bond < 20; ++bond) {
    const SparseColumns lost = plate.some(bond, 1);
    test::add_products(k, lost, -1.0);
    busy.change(no_columns(k.rows), lost);
    idle.change(no_columns(k.rows), lost);
    static_cast<void>(busy.solve(b, x));
  }
  busy.refresh();
  idle.refresh();
  EXPECT_EQ(busy.solve(b, x).way, SolveWay::refactor);
  static_cast<void>(idle.solve(b, y));
  EXPECT_EQ(x, y);
  EXPECT_EQ(busy.fresh_residual(), idle.fresh_residual());
}

TEST(UpdatedSolver, IteratesWithoutAFactor) {
  const Plate plate(12);
  Csr k = plate.k;
  int made = 0;
  const auto none = [&] {
    ++made;
    return LinearOperator{};
  };
  UpdatedSolver solver(as_operator(k), none, tight);
  const Eigen::MatrixXd b = loads(k.rows, 1);
  Eigen::MatrixXd x;
  const int cold = solver.solve(b, x).iterations;
  const SparseColumns lost = plate.some(0, 2);
  test::add_products(k, lost, -1.0);
  solver.change(no_columns(k.rows), lost);
  const SolveOutcome outcome = solver.solve(b, x);
  EXPECT_TRUE(outcome.converged);
  EXPECT_EQ(outcome.way, SolveWay::iterate);
  EXPECT_LE(outcome.iterations, cold);
  EXPECT_EQ(made, 1);
  EXPECT_LE((x - exact(k, b)).norm(), 1e-9 * x.norm());
  solver.refresh();
  static_cast<void>(solver.solve(b, x));
  EXPECT_EQ(made, 2);
  EXPECT_EQ(solver.factor_nonzeros(), 0);
  EXPECT_EQ(solver.factor_seconds(), 0.0);
  EXPECT_EQ(solver.totals()[static_cast<int>(SolveWay::iterate)].solves, 3);
}

TEST(UpdatedSolver, RefusesWhatDoesNotFit) {
  const Csr k = test::chain(20, true);
  std::vector<Index> order(20);
  std::iota(order.begin(), order.end(), 0);
  UpdatedSolver solver(as_operator(k), k, order, {});
  SparseColumns far = no_columns(20), longer = no_columns(21);
  test::append(far, {{2, 1.0}, {17, -1.0}});
  test::append(longer, {{2, 1.0}, {3, -1.0}});
  Eigen::MatrixXd x;
  EXPECT_THROW(solver.change(far, no_columns(20)), Error);
  EXPECT_THROW(solver.change(no_columns(20), longer), Error);
  EXPECT_THROW(static_cast<void>(solver.solve(loads(21, 1), x)), Error);
  EXPECT_THROW(UpdatedSolver(as_operator(k), test::chain(21, true), order, {}), Error);
  EXPECT_THROW(UpdatedSolver(
                   as_operator(k), [] { return LinearOperator{}; }, only(SolveWay::update)),
               Error);
}

}  // namespace
}  // namespace perimode
