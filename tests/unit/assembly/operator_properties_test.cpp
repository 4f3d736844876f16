// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "operator_checks.hpp"
#include "perimode/assembly/assemble.hpp"
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
using test::sizes;

TEST(Operators, TranslationsGiveNoForce) {
  const auto force = [](const Model& model, StiffnessForm form) {
    const auto body = build_body<2>(model);
    Eigen::VectorXd shift(2 * body.count());
    for (Index i = 0; i < body.count(); ++i) shift.segment<2>(2 * i) << 0.3, -0.7;
    return multiply(stiffness_operator(body, form), shift).cwiseAbs().maxCoeff();
  };
  Model m = box_model({25, 21}, 0.1, 3.0);
  for (auto calibration : {Calibration::continuum, Calibration::discrete}) {
    m.calibration = calibration;
    EXPECT_EQ(force(m, StiffnessForm::bonds), 0.0);  // sums of differences
    EXPECT_EQ(force(m, StiffnessForm::stencil), 0.0);
    EXPECT_LE(force(m, StiffnessForm::blocks), 1e-13);  // diagonal entries of K are below 10
  }
  m.periodic = {true, true, false};
  EXPECT_EQ(force(m, StiffnessForm::stencil), 0.0);
}

TEST(Operators, AnyNumberOfThreadsGivesTheSameBits) {
  const int before = threads();
  for (const auto& cells : {std::vector{3000}, std::vector{61, 47}, std::vector{15, 14, 17}}) {
    Model m = of_blocks(cells, Calibration::discrete);
    std::get<GridSpec>(m.particles).remove.clear();
    add_wall(m, 0, false, WallType::mirror);
    const auto check = [&](const auto& body) {
      const Eigen::VectorXd x = random_vector(body.boundary.free, 5);
      for (auto form : {StiffnessForm::stencil, StiffnessForm::bonds, StiffnessForm::blocks}) {
        set_threads(1);
        const auto k = stiffness_operator(body, form);  // made for one thread, used by more
        const Eigen::VectorXd one = multiply(k, x);
        for (int count : {2, 3}) {
          set_threads(count);
          EXPECT_TRUE((multiply(k, x).array() == one.array()).all()) << count << " threads";
        }
      }
    };
    if (m.dimension == 1) check(build_body<1>(m));
    if (m.dimension == 2) check(build_body<2>(m));
    if (m.dimension == 3) check(build_body<3>(m));
  }
  set_threads(before);
}

TEST(Operators, InternalForceIsTheOperatorOnFreeBodies) {
  Model m = box_model({19, 14}, 0.5, 3.0);
  add_walls(m, 1, WallType::odd);
  m.calibration = Calibration::discrete;
  const auto body = build_body<2>(m);
  const Eigen::VectorXd x = random_vector(body.boundary.free, 2);
  const Eigen::VectorXd difference = internal_force(body, x) - multiply(stiffness_operator(body), x);
  EXPECT_TRUE((difference.array().abs() <= 2e-14 * sizes(body, x).array()).all());
}

TEST(Operators, InternalForceTakesGivenValuesOfGhosts) {
  Model bar = box_model({20}, 1.0, 3.0);
  test::add_surface_nodes(bar, 0, false, {"0.0"});
  test::add_surface_nodes(bar, 0, true, {"2.0"});
  const auto body = build_body<1>(bar);
  Eigen::VectorXd stretched(20);
  for (int i = 0; i < 20; ++i) stretched[i] = 0.1 * (i + 0.5);
  // Uniform strain through both surface points is in equilibrium; forces of single bonds are about 1.
  EXPECT_LE(internal_force(body, stretched).cwiseAbs().maxCoeff(), 1e-13);
}

template <int Dim>
void expect_blocks_and_bound(const Model& model) {
  const auto body = build_body<Dim>(model);
  const BlockCsr k = assemble_stiffness(body);
  const auto blocks = diagonal_blocks(body);
  double largest = 0.0;
  double worst = 0.0;
  for (Index i = 0; i < k.rows; ++i) {
    for (Offset e = k.row_start[i]; e < k.row_start[i + 1]; ++e) {
      for (int c = 0; k.column[e] == i && c < Dim * Dim; ++c) {
        largest = std::max(largest, std::abs(k.value[e * Dim * Dim + c]));
        worst = std::max(worst, std::abs(k.value[e * Dim * Dim + c] -
                                         blocks[static_cast<std::size_t>(i) * Dim * Dim + c]));
      }
    }
  }
  EXPECT_LE(worst, 1e-13 * largest);
  const double norm = norm_inf(scalar_csr(k, body.boundary.free_number));
  EXPECT_GE(stiffness_bound(body), norm * (1.0 - 1e-13));
  if (body.boundary.image.empty()) {
    EXPECT_NEAR(stiffness_bound(body), norm, 1e-13 * norm);
  }
}

TEST(Operators, DiagonalBlocksAndTheBoundAreThoseOfTheMatrix) {
  for (auto calibration : {Calibration::continuum, Calibration::discrete}) {
    Model bar = box_model({20}, 0.5, 3.0);
    Model plate = of_blocks({19, 17}, calibration);
    std::get<GridSpec>(plate.particles).remove.clear();
    fix_face(plate, 0, false, 2, {1});
    Model block = box_model({7, 6, 8}, 0.5, 2.0);
    block.calibration = calibration;
    expect_blocks_and_bound<1>(bar);
    expect_blocks_and_bound<2>(plate);
    expect_blocks_and_bound<3>(block);
    add_wall(bar, 0, true, WallType::surface_nodes);
    add_wall(plate, 1, false, WallType::antimirror);
    add_walls(plate, 0, WallType::surface_nodes);
    add_walls(block, 2, WallType::odd);
    expect_blocks_and_bound<1>(bar);
    expect_blocks_and_bound<2>(plate);
    expect_blocks_and_bound<3>(block);
    test::add_surface_traction(bar, false, 1.0);
    expect_blocks_and_bound<1>(bar);
  }
}

TEST(Operators, BytesCountWhatIsStored) {
  Model m = box_model({40, 30}, 1.0, 3.0);
  const auto body = build_body<2>(m);
  const double ends = 2.0 * static_cast<double>(count_bonds(body.bonds, body.count()));
  // Beside the arrays per bond end there are row starts: 8 bytes for some 26 ends.
  EXPECT_NEAR(operator_bytes(body, StiffnessForm::bonds), 20.0 * ends, 0.03 * 20.0 * ends);
  EXPECT_NEAR(operator_bytes(body, StiffnessForm::blocks), 36.0 * (ends + 1200.0), 0.01 * 36.0 * ends);
  // The stencil keeps 7 layers of 46 cells and two components, 48 (odd: 56) numbers each, and a short plan.
  EXPECT_LT(operator_bytes(body, StiffnessForm::stencil), 0.1 * operator_bytes(body, StiffnessForm::bonds));
  add_walls(m, 0, WallType::mirror);
  const auto walls = build_body<2>(m);
  const BlockCsr k = assemble_stiffness(walls);
  EXPECT_NEAR(operator_bytes(walls, StiffnessForm::blocks), 36.0 * static_cast<double>(k.blocks()),
              0.01 * 36.0 * static_cast<double>(k.blocks()));
}

}  // namespace
}  // namespace perimode
