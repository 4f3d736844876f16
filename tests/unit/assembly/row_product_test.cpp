// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/linalg/row_product.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "operator_checks.hpp"
#include "perimode/assembly/operators.hpp"
#include "perimode/linalg/threads.hpp"
#include "support/models.hpp"

namespace perimode {
namespace {

using test::add_wall;
using test::add_walls;
using test::box_model;
using test::fix_face;
using test::of_blocks;
using test::random_vector;

/// Rows handed out piece by piece are the product to the last bit, every row once, in the same pieces for any
/// number of threads; where x is left to `take`, it may be overwritten.
template <int Dim>
void expect_rows_equal_the_product(const Body<Dim>& body) {
  const int before = threads();
  for (auto form :
       {StiffnessForm::automatic, StiffnessForm::stencil, StiffnessForm::bonds, StiffnessForm::blocks}) {
    if (form == StiffnessForm::stencil && !body.particles.grid) continue;
    const RowProduct rows = stiffness_rows(body, form);
    ASSERT_EQ(rows.size, body.boundary.free);
    const Eigen::VectorXd x = random_vector(rows.size, 5);
    const Eigen::VectorXd expected = multiply(stiffness_operator(body, form), x);
    ASSERT_EQ(multiply(as_operator(rows), x), expected);
    std::vector<std::vector<Index>> pieces;
    for (const int count : {1, 2, 5}) {
      set_threads(count);
      Eigen::VectorXd changing = x;
      Eigen::VectorXd y = Eigen::VectorXd::Constant(rows.size, std::nan(""));
      std::vector<Index> piece(static_cast<std::size_t>(rows.size), -1);
      rows.apply(changing.data(), [&](const RowPiece& p) {
        y.segment(p.first, p.count) = Eigen::Map<const Eigen::VectorXd>(p.y, p.count);
        std::fill_n(piece.begin() + p.first, p.count, p.piece);
        if (rows.in_place) changing.segment(p.first, p.count).setConstant(std::nan(""));
      });
      EXPECT_EQ(y, expected) << "form " << static_cast<int>(form) << ", " << count << " threads";
      EXPECT_TRUE(
          std::all_of(piece.begin(), piece.end(), [&](Index p) { return p >= 0 && p < rows.pieces; }));
      pieces.push_back(std::move(piece));
    }
    set_threads(before);
    EXPECT_EQ(pieces[1], pieces[0]);
    EXPECT_EQ(pieces[2], pieces[0]);
  }
}

TEST(RowProduct, PieceByPieceIsTheProduct) {
  Model walled = box_model({39, 35}, 0.5, 3.0);  // periodic along the layers' axis, mirrored along the other
  walled.periodic[1] = true;
  add_wall(walled, 0, false, WallType::mirror);
  fix_face(walled, 0, true, 2, {1});
  expect_rows_equal_the_product(build_body<2>(walled));

  Model solid = of_blocks({17, 13, 11}, Calibration::discrete);
  add_walls(solid, 2, WallType::antimirror);
  fix_face(solid, 1, true, 1, {0, 2});
  expect_rows_equal_the_product(build_body<3>(solid));

  Model surfaces = box_model({33, 37}, 0.5, 3.0);
  for (const bool upper : {false, true}) {
    test::add_surface_nodes(surfaces, 0, upper);
    test::add_surface_nodes(surfaces, 1, upper);
  }
  expect_rows_equal_the_product(build_body<2>(surfaces));

  Model bar = box_model({1500}, 0.5, 3.0);
  add_walls(bar, 0, WallType::odd);
  expect_rows_equal_the_product(build_body<1>(bar));

  expect_rows_equal_the_product(build_body<2>(box_model({300, 5}, 0.5, 2.0)));
}

}  // namespace
}  // namespace perimode
