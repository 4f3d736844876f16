// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/assembly/operators.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "operator_checks.hpp"
#include "perimode/assembly/assemble.hpp"
#include "support/models.hpp"

namespace perimode {
namespace {

using test::add_crack;
using test::add_wall;
using test::add_walls;
using test::box_model;
using test::expect_forms_equal_the_matrix;
using test::fix_face;
using test::of_blocks;
using test::random_vector;
using test::sizes;

constexpr std::array kernels = {Kernel::constant, Kernel::conical, Kernel::gaussian,
                                Kernel::inverse_distance};
constexpr std::array calibrations = {Calibration::continuum, Calibration::discrete,
                                     Calibration::discrete_cut};
constexpr std::array wall_types = {WallType::odd, WallType::even, WallType::mirror, WallType::antimirror,
                                   WallType::zero_layer};

void expect_any(const Model& model, unsigned seed = 1) {
  if (model.dimension == 1) expect_forms_equal_the_matrix(build_body<1>(model), seed);
  if (model.dimension == 2) expect_forms_equal_the_matrix(build_body<2>(model), seed);
  if (model.dimension == 3) expect_forms_equal_the_matrix(build_body<3>(model), seed);
}

TEST(Operators, EveryFormEqualsTheMatrixForEveryKernelAndCalibration) {
  for (auto kernel : kernels) {
    for (auto calibration : calibrations) {
      for (auto correction : {VolumeCorrection::none, VolumeCorrection::linear}) {
        for (const auto& cells : {std::vector{57}, std::vector{35, 23}, std::vector{13, 11, 12}}) {
          Model m = box_model(cells, 0.5, cells.size() == 3 ? 2.0 : 3.0);
          m.material.micromodulus.kernel = kernel;
          m.calibration = calibration;
          m.volume_correction = correction;
          if (cells.size() == 1) add_crack(m, {{10.0}});
          if (cells.size() == 2) add_crack(m, {{5.0, -0.1}, {5.0, 4.5}});
          if (cells.size() == 3) {
            add_crack(m, {{3.0, -1.0, -1.0}, {3.0, 3.0, -1.0}, {3.0, 3.0, 9.0}, {3.0, -1.0, 9.0}});
          }
          expect_any(m);
        }
      }
    }
  }
}

TEST(Operators, EveryFormEqualsTheMatrixForEveryWall) {
  for (auto type : wall_types) {
    for (auto other : {WallType::mirror, WallType::odd}) {
      for (const auto& cells : {std::vector{31}, std::vector{26, 17}, std::vector{9, 12, 10}}) {
        Model m = box_model(cells, 0.5, cells.size() == 3 ? 2.0 : 3.0);
        add_wall(m, 0, false, type);
        add_wall(m, static_cast<int>(cells.size()) - 1, true, other);
        expect_any(m);
        if (cells.size() > 1) add_wall(m, 1, false, type);
        m.calibration = Calibration::discrete;
        expect_any(m);
      }
    }
  }
}

TEST(Operators, EveryFormEqualsTheMatrixAtSurfaceNodes) {
  for (int cells : {1, 2, 5, 40}) {
    for (auto type : {WallType::odd, WallType::surface_nodes}) {
      Model bar = box_model({cells}, 0.5, 3.0);
      add_wall(bar, 0, false, type);
      test::add_surface_nodes(bar, 0, true, {"0.25"});
      expect_any(bar);
      bar.calibration = Calibration::discrete;
      expect_any(bar);
    }
  }
  Model pulled = box_model({40}, 0.5, 3.0);
  test::add_surface_traction(pulled, false, 2.0);
  fix_face(pulled, 0, true, 1, {0});
  expect_any(pulled);
  for (const auto& cells : {std::vector{23, 9}, std::vector{6, 9, 7}}) {
    Model m = box_model(cells, 0.5, cells.size() == 3 ? 2.0 : 3.0);
    add_walls(m, 0, WallType::surface_nodes);
    add_wall(m, 1, false, WallType::mirror);
    add_wall(m, 1, true, WallType::surface_nodes);
    expect_any(m);
    m.calibration = Calibration::discrete;
    m.periodic[2] = true;
    expect_any(m);
  }
}

TEST(Operators, EveryFormEqualsTheMatrixForTinyAndPeriodicBodies) {
  for (int n = 1; n <= 5; ++n) {
    for (bool periodic : {false, true}) {
      for (const auto& cells : {std::vector{n}, std::vector{n, 3}, std::vector{3, n}, std::vector{n, 2, 3},
                                std::vector{2, 3, n}, std::vector{4, n, 1}}) {
        Model m = box_model(cells, 1.0, 3.0);
        m.periodic[0] = periodic;
        if (cells.size() > 1) m.periodic[cells.size() - 1] = periodic;
        expect_any(m);
        if (cells.size() > 1 && !periodic) {
          add_walls(m, 1, WallType::antimirror);
          expect_any(m);
        }
      }
    }
  }
}

TEST(Operators, EveryFormEqualsTheMatrixForFixedDofs) {
  for (const auto& cells : {std::vector{30}, std::vector{29, 18}, std::vector{12, 11, 13}}) {
    const int dim = static_cast<int>(cells.size());
    for (int c = 0; c < dim; ++c) {
      Model m = box_model(cells, 1.0, 2.0);
      fix_face(m, 0, false, 3, {c});
      fix_face(m, dim - 1, true, 2, dim == 1 ? std::vector{0} : std::vector{0, 1});
      if (dim == 2) fix_face(m, 1, false, 1, {0, 1});
      expect_any(m);
    }
  }
  Model still = box_model({3, 2}, 1.0, 3.0);  // nothing left to move
  fix_face(still, 0, false, 3, {0, 1});
  const auto body = build_body<2>(still);
  const auto k = stiffness_operator(body);
  EXPECT_EQ(k.size, 0);
  k.apply(nullptr, nullptr);
}

TEST(Operators, EveryFormEqualsTheMatrixForBlocksAndHoles) {
  for (auto calibration : calibrations) {
    for (const auto& cells : {std::vector{33}, std::vector{29, 18}, std::vector{14, 11, 12}}) {
      Model m = of_blocks(cells, calibration);
      auto& ball = std::get<BallRegion>(std::get<GridSpec>(m.particles).remove[0].shape);
      ball.centre.resize(cells.size());
      expect_any(m);
      m.periodic[0] = true;
      expect_any(m);
    }
  }
}

TEST(Operators, EveryFormEqualsTheMatrixAfterBondsBreak) {
  for (auto calibration : {Calibration::continuum, Calibration::discrete}) {
    Model m = box_model({31, 22}, 1.0, 3.0);
    add_walls(m, 0, WallType::mirror);
    m.calibration = calibration;
    auto body = build_body<2>(m);
    std::mt19937 generator(3);
    for (int k = 0; k < 400; ++k)
      break_bond(body.bonds, static_cast<Index>(generator() % 682), generator() % 28);
    expect_forms_equal_the_matrix(body);
  }
}

/// A cloud file for the life of the test.
struct CloudFile {
  std::filesystem::path path =
      std::filesystem::path(testing::TempDir()) / ("operators_cloud_" + std::to_string(getpid()) + ".csv");
  explicit CloudFile(int dim) {
    std::ofstream out(path);
    out << (dim == 1 ? "x" : dim == 2 ? "x,y" : "x,y,z") << ",volume,block\n";
    std::mt19937 generator(7);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (int i = 0; i < 300; ++i) {
      for (int a = 0; a < dim; ++a) out << 5.0 * uniform(generator) << ',';
      out << 0.5 + uniform(generator) << ',' << (i % 3 == 0 ? "one" : "two") << '\n';
    }
  }
  ~CloudFile() { std::filesystem::remove(path); }
};

template <int Dim>
void expect_cloud() {
  const CloudFile file(Dim);
  for (auto calibration : {Calibration::continuum, Calibration::discrete}) {
    Model m;
    m.dimension = Dim;
    m.particles = CloudSpec{file.path, {}};
    m.horizon = {HorizonSpec::Rule::neighbours, 12.0, {}};
    m.material.youngs_modulus = m.material.density = 1.0;
    m.block_materials["one"] = m.material;
    m.block_materials["one"].youngs_modulus = 3.0;
    m.calibration = calibration;
    expect_forms_equal_the_matrix(build_body<Dim>(m));
    m.boundary.push_back({Fix{{0}, Region{FaceRegion{{0, false}, 0, 0.6}, {}}}, {}});
    expect_forms_equal_the_matrix(build_body<Dim>(m));
    std::get<CloudSpec>(m.particles).period.assign(Dim, 5.0);
    m.periodic[Dim - 1] = true;
    expect_forms_equal_the_matrix(build_body<Dim>(m));
  }
}

TEST(Operators, EveryFormEqualsTheMatrixOnClouds) {
  expect_cloud<1>();
  expect_cloud<2>();
  expect_cloud<3>();
}

TEST(Operators, TheStencilOfACloudIsRefused) {
  const CloudFile file(2);
  Model m;
  m.particles = CloudSpec{file.path, {}};
  m.horizon = {HorizonSpec::Rule::neighbours, 12.0, {}};
  m.material.youngs_modulus = m.material.density = 1.0;
  const auto body = build_body<2>(m);
  EXPECT_THROW((void)stiffness_operator(body, StiffnessForm::stencil), Error);
  EXPECT_THROW((void)operator_bytes(body, StiffnessForm::stencil), Error);
}

/// Any mixture of what a model can have, small.
Model random_model(unsigned seed) {
  std::mt19937 generator(seed);
  const auto upto = [&](int n) { return static_cast<int>(generator() % static_cast<unsigned>(n)); };
  const int dim = 1 + upto(3);
  std::vector<int> cells;
  for (int a = 0; a < dim; ++a) cells.push_back(1 + upto(dim == 3 ? 10 : dim == 2 ? 30 : 70));
  Model m = box_model(cells, 0.25, 1.5 + 0.3 * upto(dim == 3 ? 5 : 10));
  m.material.micromodulus.kernel = kernels[upto(4)];
  m.volume_correction = upto(2) ? VolumeCorrection::none : VolumeCorrection::linear;
  for (int a = 0; a < dim; ++a) {
    m.periodic[a] = upto(4) == 0;
    for (bool upper : {false, true})
      if (!m.periodic[a] && upto(3) == 0) add_wall(m, a, upper, wall_types[upto(5)]);
  }
  for (int k = upto(3); k > 0; --k) fix_face(m, upto(dim), upto(2) == 0, 1 + upto(2), {upto(dim)});
  if (cells[0] > 3 && upto(2)) {
    Coordinates upper;
    for (int n : cells) upper.push_back(0.25 * n);
    upper[0] *= 0.5;
    m.blocks.push_back({"left", Region{BoxRegion{Coordinates(cells.size(), 0.0), upper}, {}}});
    m.block_materials["left"] = m.material;
    if (upto(2)) m.block_materials["left"].youngs_modulus = 2.5;
    Coordinates lower(cells.size(), 0.0);
    lower[0] = 0.25 * (cells[0] - 1);
    for (int a = 1; a < dim; ++a) upper[a] = 0.3;
    upper[0] = 0.25 * cells[0];
    if (dim > 1 && cells[1] > 1 && upto(2))
      std::get<GridSpec>(m.particles).remove.push_back(Region{BoxRegion{lower, upper}, {}});
  }
  m.calibration =
      m.horizon.value >= 2.0 && dim > 1 && cells[0] > 2 ? calibrations[upto(2)] : Calibration::continuum;
  return m;
}

TEST(Operators, EveryFormEqualsTheMatrixForRandomModels) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    expect_any(random_model(seed), seed);
  }
}

}  // namespace
}  // namespace perimode
