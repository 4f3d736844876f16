// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/assembly/breakable_stiffness.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "breaking_models.hpp"
#include "operator_checks.hpp"
#include "perimode/assembly/assemble.hpp"
#include "perimode/linalg/threads.hpp"

namespace perimode {
namespace {

using test::all_ends;
using test::box_model;
using test::for_negative_bodies;
using test::for_random_bodies;
using test::random_vector;
using test::some_bonds;

template <int Dim>
Eigen::MatrixXd dense(const Body<Dim>& body) {
  const Csr k = scalar_csr(assemble_stiffness(body), body.boundary.free_number);
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(k.rows, k.rows);
  for (Index i = 0; i < k.rows; ++i)
    for (Offset e = k.row_start[i]; e < k.row_start[i + 1]; ++e) full(i, k.column[e]) = k.value[e];
  return full;
}

Eigen::MatrixXd dense(const SparseColumns& c) {
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(c.rows, c.count());
  for (Index k = 0; k < c.count(); ++k)
    for (Offset e = c.start[k]; e < c.start[k + 1]; ++e) full(c.row[e], k) = c.value[e];
  return full;
}

Eigen::MatrixXd squares(const BondColumns& c) {
  const Eigen::MatrixXd p = dense(c.positive), n = dense(c.negative);
  return p * p.transpose() - n * n.transpose();
}

template <int Dim>
void clear(Body<Dim>& body, const std::vector<BondRef>& bonds) {
  for (const BondRef& b : bonds) break_bond(body.bonds, b.particle, b.slot);
}

/// What the matrix loses is the sum of the columns' squares. Entries are sums of at most some hundred
/// products of the size of the largest one, each rounded.
template <int Dim>
void expect_columns_are_what_breaks(Body<Dim> body) {
  const Eigen::MatrixXd whole = dense(body);
  const double scale = 1e-300 + whole.cwiseAbs().maxCoeff();
  ASSERT_LT((whole - whole.transpose()).cwiseAbs().maxCoeff(), 1e-13 * scale);
  const auto some = some_bonds(body, 12, 3);
  const BondColumns columns = bond_columns(body, some);
  EXPECT_LE(columns.count(), static_cast<Index>(some.size()));
  EXPECT_TRUE(softening(body) || columns.negative.count() == 0);
  const Eigen::MatrixXd lost = squares(columns);
  clear(body, some);
  const Eigen::MatrixXd left = dense(body);
  EXPECT_LT((whole - left - lost).cwiseAbs().maxCoeff(), 1e-13 * scale);
  const auto rest = with_images(body, all_ends(body));
  EXPECT_EQ(static_cast<Offset>(rest.size()), count_bonds(body.bonds, body.count()));
  EXPECT_LT((left - squares(bond_columns(body, rest))).cwiseAbs().maxCoeff(), 1e-13 * scale);
  clear(body, rest);
  EXPECT_EQ(dense(body).cwiseAbs().maxCoeff(), 0.0);
}

TEST(BreakableStiffness, BondColumnsAreWhatTheMatrixLoses) {
  for_random_bodies<1>(40, expect_columns_are_what_breaks<1>);
  for_random_bodies<2>(40, expect_columns_are_what_breaks<2>);
  for_random_bodies<3>(20, expect_columns_are_what_breaks<3>);
}

TEST(BreakableStiffness, ColumnsOfNegativeBondsAreWhatTheMatrixGains) {
  for_negative_bodies<1>(30, expect_columns_are_what_breaks<1>);
  for_negative_bodies<2>(30, expect_columns_are_what_breaks<2>);
  for_negative_bodies<3>(10, expect_columns_are_what_breaks<3>);
}

/// Every way to name bonds gives the same list: each bond once, its image next to it.
template <int Dim>
void expect_one_list(const Body<Dim>& body) {
  const auto bonds = with_images(body, all_ends(body));
  auto again = bonds;
  std::reverse(again.begin(), again.end());
  EXPECT_EQ(with_images(body, again), bonds);
  // Half of the images name the other half.
  std::vector<BondRef> every_other;
  for (const BondRef& b : bonds) {
    const auto list = with_images(body, {b});
    ASSERT_GE(list.size(), 1U);
    ASSERT_LE(list.size(), 2U);
    EXPECT_TRUE(list[0] == b || list.back() == b);
    if (list[0] == b) every_other.push_back(b);
    const auto end = bond_end(body, b);
    if (end.neighbour < body.count()) {
      EXPECT_EQ(list.size(), 1U);
      EXPECT_LE(b.particle, end.neighbour);
      continue;
    }
    // A bond and its image are equally long and stiff, and the ghosts follow each other's particles.
    const BondRef image = list[0] == b ? list.back() : list[0];
    const auto other = bond_end(body, image);
    EXPECT_EQ(other.length, end.length);
    EXPECT_EQ(bond_stiffness(body, image.particle, other), bond_stiffness(body, b.particle, end));
    EXPECT_EQ(owner(body.bonds, other.neighbour, body.count()), b.particle);
    EXPECT_EQ(owner(body.bonds, end.neighbour, body.count()), image.particle);
  }
  EXPECT_EQ(with_images(body, every_other), bonds);
}

TEST(BreakableStiffness, BondsAreListedOnceWithTheirImages) {
  Model m = box_model({6, 5}, 0.5, 2.0);
  test::add_walls(m, 0, WallType::mirror);
  test::add_wall(m, 1, false, WallType::antimirror);
  expect_one_list(build_body<2>(m));
  m.periodic[1] = true;
  m.boundary.pop_back();
  expect_one_list(build_body<2>(m));
  Model solid = box_model({4, 3, 4}, 0.5, 1.8);
  test::add_walls(solid, 2, WallType::antimirror);
  test::add_walls(solid, 1, WallType::mirror);
  expect_one_list(build_body<3>(solid));
  Model bar = box_model({3}, 0.5, 5.0);  // shorter than its bonds: ghosts of ghosts
  test::add_walls(bar, 0, WallType::mirror);
  expect_one_list(build_body<1>(bar));
}

TEST(BreakableStiffness, NegativeBondsHaveColumnsOfTheirOwn) {
  Body<1> body = build_body<1>(box_model({8}, 0.5, 2.0));
  for (double& c : body.constants.kernel) c = -c;
  const BondColumns columns = bond_columns(body, with_images(body, {{0, 2}}));
  EXPECT_EQ(columns.positive.count(), 0);
  ASSERT_EQ(columns.negative.count(), 1);
  const BondEnd<1> end = bond_end(body, {0, 2});
  EXPECT_DOUBLE_EQ(columns.negative.value[0] * columns.negative.value[1], bond_stiffness(body, 0, end));
}

/// Each form after each of a few breaks equals the operator made anew: its bits, the stencil to round-off.
template <int Dim>
void expect_forms_follow(const Body<Dim>& whole, int breaks, std::size_t bonds) {
  for (auto form :
       {StiffnessForm::automatic, StiffnessForm::stencil, StiffnessForm::bonds, StiffnessForm::blocks}) {
    const bool grid = whole.particles.grid.has_value();
    if (form == StiffnessForm::stencil && !grid) continue;
    const bool bits = form == StiffnessForm::blocks || form == StiffnessForm::bonds || !grid;
    Body<Dim> body = whole;
    BreakableStiffness<Dim> first(body, form);
    const LinearOperator product = first.product();
    const RowProduct rows = first.rows();
    BreakableStiffness<Dim> k(std::move(first));  // products live on where it moves
    const Eigen::VectorXd x = random_vector(body.boundary.free, 5);
    for (int step = 0; step < breaks; ++step) {
      const auto gone = some_bonds(body, bonds, static_cast<unsigned>(step) + 11);
      k.break_bonds(gone);
      for (const BondRef& b : gone) {
        ASSERT_FALSE(
            std::visit([&](const auto& of) { return is_alive(of, b.particle, b.slot); }, body.bonds));
      }
      k.break_bonds(gone);  // twice: left alone
      const Body<Dim> copy = body;
      const Eigen::VectorXd expected = multiply(stiffness_operator(copy, form), x);
      const Eigen::VectorXd y = multiply(product, x);
      if (bits) {
        ASSERT_EQ(y, expected) << "form " << static_cast<int>(form) << ", break " << step;
      } else {
        const Eigen::ArrayXd excess = (y - expected).array().abs() - 2e-14 * test::sizes(body, x).array();
        ASSERT_TRUE((excess <= 0.0).all()) << "form " << static_cast<int>(form) << ", break " << step;
      }
      ASSERT_EQ(multiply(as_operator(rows), x), y);
    }
  }
}

TEST(BreakableStiffness, EveryFormFollowsAnySequenceOfBreaks) {
  for_random_bodies<1>(25, [](const Body<1>& body) { expect_forms_follow(body, 4, 5); });
  for_random_bodies<2>(25, [](const Body<2>& body) { expect_forms_follow(body, 4, 12); });
  for_random_bodies<3>(12, [](const Body<3>& body) { expect_forms_follow(body, 4, 12); });
}

TEST(BreakableStiffness, EveryFormFollowsBreaksOfNegativeBonds) {
  for_negative_bodies<1>(20, [](const Body<1>& body) { expect_forms_follow(body, 4, 5); });
  for_negative_bodies<2>(20, [](const Body<2>& body) { expect_forms_follow(body, 4, 12); });
  for_negative_bodies<3>(8, [](const Body<3>& body) { expect_forms_follow(body, 4, 12); });
}

TEST(BreakableStiffness, TheSameBitsForAnyNumberOfThreads) {
  const int before = threads();
  for (auto form : {StiffnessForm::stencil, StiffnessForm::bonds, StiffnessForm::blocks}) {
    Model m = box_model({61, 47}, 1.0, 3.0);  // more than one thread pays for
    test::add_wall(m, 1, false, WallType::mirror);
    const Body<2> whole = build_body<2>(m);
    const Eigen::VectorXd x = random_vector(whole.boundary.free, 5);
    std::vector<Eigen::VectorXd> results;
    for (const int count : {1, 2, 5}) {
      set_threads(count);
      Body<2> body = whole;
      BreakableStiffness<2> k(body, form);
      for (unsigned step = 0; step < 6; ++step) k.break_bonds(some_bonds(body, 20, step));
      results.push_back(multiply(k.product(), x));
    }
    set_threads(before);
    EXPECT_EQ(results[1], results[0]);
    EXPECT_EQ(results[2], results[0]);
  }
}

/// A row of cells that loses its families one after the other, from both ends and in between, until none is
/// whole: runs split, grow together and vanish.
TEST(BreakableStiffness, RunsOfTheStencilSplitAndGrowTogether) {
  Model m = box_model({100, 9}, 1.0, 2.0);
  m.calibration = Calibration::discrete;
  Body<2> body = build_body<2>(m);
  BreakableStiffness<2> k(body, StiffnessForm::stencil);
  const LinearOperator product = k.product();
  const Eigen::VectorXd x = random_vector(body.boundary.free, 5);
  for (Index t = 0; t < 100; ++t) {
    const Index column = t % 3 == 0 ? t / 3 : t % 3 == 1 ? 99 - t / 3 : 33 + t / 3;
    const Index particle = 4 * 100 + column;
    std::vector<BondRef> bonds;
    for_each_bond(body.bonds, particle, Which::alive, [&](const BondEnd<2>& end) {
      if (end.xi[1] > 0.0) bonds.push_back({particle, end.slot});
    });
    k.break_bonds(with_images(body, bonds));
    const Eigen::VectorXd expected = multiply(stiffness_operator(body, StiffnessForm::stencil), x);
    const Eigen::ArrayXd excess =
        (multiply(product, x) - expected).array().abs() - 2e-14 * test::sizes(body, x).array();
    ASSERT_TRUE((excess <= 0.0).all()) << t;
  }
}

TEST(BreakableStiffness, TheStencilOfACloudIsRefused) {
  const test::BreakingCloud cloud(2);
  Body<2> body = build_body<2>(cloud.model);
  EXPECT_THROW((void)BreakableStiffness<2>(body, StiffnessForm::stencil), Error);
}

}  // namespace
}  // namespace perimode
