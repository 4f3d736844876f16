// SPDX-License-Identifier: BSD-3-Clause
// Bodies whose discrete modes are known in closed form: bars, plates and blocks between reflecting
// walls or periodic images (docs/theory/05_closed_forms.md).
#include <ostream>

#include "verification/modes_of.hpp"

namespace perimode {
namespace {

using test::add_wall;
using test::add_walls;
using test::box_model;
using test::expect_closed_form;
using test::lowest;

// Frequencies are square roots of Rayleigh quotients of converged vectors: about 1e-13 of the largest
// eigenvalue over the smallest, which is below 1e3 for these bodies.
constexpr double tight = 1e-10;

struct MediumCase {
  std::string name;
  Kernel kernel;
  Calibration calibration;
  VolumeCorrection correction;
  friend std::ostream& operator<<(std::ostream& out, const MediumCase& c) { return out << c.name; }
};

class EveryMedium : public ::testing::TestWithParam<MediumCase> {
 protected:
  static Model body(const std::vector<int>& cells, double spacing, double ratio) {
    Model m = box_model(cells, spacing, ratio);
    m.material.youngs_modulus = 68e9;
    m.material.density = 2700.0;
    m.material.micromodulus.kernel = GetParam().kernel;
    m.calibration = GetParam().calibration;
    m.volume_correction = GetParam().correction;
    return m;
  }
  static void between(Model& m, int axis, WallType lower, WallType upper) {
    add_wall(m, axis, false, lower);
    add_wall(m, axis, true, upper);
  }
};

TEST_P(EveryMedium, BarBetweenOddWallsHasAllItsModes) {
  Model m = body({100}, 0.01, 10.0);
  add_walls(m, 0, WallType::odd);
  expect_closed_form<1>(m, lowest(100), tight);
}

TEST_P(EveryMedium, BarBetweenEvenWallsHasAllItsModes) {
  Model m = body({80}, 0.01, 3.0);
  add_walls(m, 0, WallType::even);
  expect_closed_form<1>(m, lowest(80), tight);
}

TEST_P(EveryMedium, BarBetweenAnOddAndAnEvenWallHasAllItsModes) {
  Model m = body({100}, 0.01, 5.0);
  between(m, 0, WallType::odd, WallType::even);
  expect_closed_form<1>(m, lowest(100), tight);
}

TEST_P(EveryMedium, BarThinnerThanItsHorizonHasAllItsModes) {
  Model m = body({3}, 0.01, 5.0);
  between(m, 0, WallType::odd, WallType::even);
  expect_closed_form<1>(m, lowest(3), tight);
}

TEST_P(EveryMedium, PeriodicBarHasAllItsModesInPairs) {
  Model m = body({61}, 0.01, 5.0);
  m.periodic[0] = true;
  expect_closed_form<1>(m, lowest(61), tight);
}

TEST_P(EveryMedium, PlateBetweenMirrorsHasAllItsModes) {
  Model m = body({16, 8}, 1.0 / 16, 3.0);
  for (int axis : {0, 1}) add_walls(m, axis, WallType::mirror);
  expect_closed_form<2>(m, lowest(256), tight);
}

TEST_P(EveryMedium, PlateBetweenAntimirrorsHasAllItsModes) {
  Model m = body({16, 8}, 1.0 / 16, 3.0);
  for (int axis : {0, 1}) add_walls(m, axis, WallType::antimirror);
  expect_closed_form<2>(m, lowest(256), tight);
}

TEST_P(EveryMedium, PlateOfMixedWallsAndImages) {
  Model m = body({16, 8}, 1.0 / 16, 3.0);
  between(m, 0, WallType::mirror, WallType::antimirror);
  m.periodic[1] = true;
  expect_closed_form<2>(m, lowest(256), tight);
}

TEST_P(EveryMedium, ThinPlatesBetweenWallsAndImages) {
  Model walls = body({32, 2}, 1.0 / 32, 3.0);
  between(walls, 1, WallType::mirror, WallType::antimirror);
  walls.periodic[0] = true;
  expect_closed_form<2>(walls, lowest(128), tight);
  Model images = body({20, 2}, 1.0 / 20, 3.0);
  images.periodic = {true, true, false};
  expect_closed_form<2>(images, lowest(80), tight);
}

TEST_P(EveryMedium, BlockOfMixedWallsAndImages) {
  Model m = body({6, 5, 4}, 1.0 / 8, 2.0);
  between(m, 0, WallType::mirror, WallType::mirror);
  between(m, 1, WallType::antimirror, WallType::mirror);
  m.periodic[2] = true;
  expect_closed_form<3>(m, lowest(360), tight);
}

std::vector<MediumCase> media() {
  const std::pair<const char*, Kernel> kernels[] = {{"constant", Kernel::constant},
                                                    {"conical", Kernel::conical},
                                                    {"gaussian", Kernel::gaussian},
                                                    {"inverse_distance", Kernel::inverse_distance}};
  std::vector<MediumCase> all;
  for (const auto& [name, kernel] : kernels) {
    for (bool linear : {false, true}) {
      for (bool discrete : {false, true}) {
        all.push_back({std::string(name) + (linear ? "_linear" : "_none") + (discrete ? "_discrete" : ""),
                       kernel, discrete ? Calibration::discrete : Calibration::continuum,
                       linear ? VolumeCorrection::linear : VolumeCorrection::none});
      }
    }
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(ClosedForms, EveryMedium, ::testing::ValuesIn(media()),
                         [](const auto& instance) { return instance.param.name; });

TEST(ClosedForms, LargerPlatesByBlockLanczosAndArpack) {
  for (auto type : {WallType::mirror, WallType::antimirror}) {
    Model m = box_model({64, 32}, 1.0 / 64, 3.0);
    m.volume_correction = VolumeCorrection::linear;
    for (int axis : {0, 1}) add_walls(m, axis, type);
    for (auto solver : {ModalSolver::lanczos, ModalSolver::arpack}) {
      expect_closed_form<2>(m, lowest(20, solver), tight);
    }
  }
}

TEST(ClosedForms, PlateInPlaneStrainWithThickness) {
  Model m = box_model({16, 8}, 1.0 / 16, 3.0);
  m.plane = Plane::strain;
  m.thickness = 0.02;
  for (int axis : {0, 1}) add_walls(m, axis, WallType::mirror);
  expect_closed_form<2>(m, lowest(256), tight);
}

// Plane stress, E = rho = 1, 1 x 0.5 with 32 x 16 cells, m = 3: the (1,1) waves of an independent
// computation from the 2 x 2 symbol.
TEST(ClosedForms, PlateWavesOneOne) {
  struct Row {
    Kernel kernel;
    double shear, pressure;
  };
  for (const Row& row : {Row{Kernel::constant, 4.3403612835, 7.4406788624},
                         Row{Kernel::gaussian, 4.2562018334, 7.2335196688}}) {
    for (auto type : {WallType::mirror, WallType::antimirror}) {
      Model m = box_model({32, 16}, 1.0 / 32, 3.0);
      m.material.micromodulus.kernel = row.kernel;
      m.volume_correction = VolumeCorrection::linear;
      for (int axis : {0, 1}) add_walls(m, axis, type);
      const auto r = test::certified_modes<2>(m, lowest(20, ModalSolver::lanczos));
      for (double expected : {row.shear, row.pressure}) {
        const double nearest = (r.angular_frequency.array() - expected).abs().minCoeff();
        EXPECT_LE(nearest, 1e-10 * expected) << "the digits given";
      }
    }
  }
}

struct Level {
  double omega;
  int copies;
};
// The periodic unit cube of 8^3 cells, m = 2 (80 bonds), E = rho = 1: lowest levels and how often each
// occurs, from the 3 x 3 symbol and the star of each wave vector.
const std::vector<Level> cube_levels = {
    {0.0, 3},          {3.9734185936, 12}, {5.4439114988, 12}, {5.7582203886, 12}, {6.6866647117, 16},
    {6.9893880835, 6}, {7.1602627591, 12}, {7.7851177468, 24}, {8.0704556194, 24}, {8.4005598673, 24}};

class PeriodicCube : public ::testing::TestWithParam<ModalSolver> {};

TEST_P(PeriodicCube, HasEveryCopyOfItsLevels) {
  Model m = box_model({8, 8, 8}, 0.125, 2.0);
  m.volume_correction = VolumeCorrection::linear;
  m.periodic = {true, true, true};
  std::vector<double> expected;
  for (const Level& level : cube_levels) expected.insert(expected.end(), level.copies, level.omega);
  ModalOptions options = lowest(static_cast<int>(expected.size()), GetParam());
  if (GetParam() == ModalSolver::lanczos) options.block_size = 4;
  const auto r = test::certified_modes<3>(m, options);
  EXPECT_EQ(r.rigid_modes, 3);
  test::expect_frequencies(r.angular_frequency, expected, 1e-9);
}

// A cut through the middle of a level: what is returned is right and complete all the same.
TEST_P(PeriodicCube, MayBeCutInTheMiddleOfALevel) {
  Model m = box_model({8, 8, 8}, 0.125, 2.0);
  m.volume_correction = VolumeCorrection::linear;
  m.periodic = {true, true, true};
  const auto r = test::certified_modes<3>(m, lowest(20, GetParam()));
  ASSERT_EQ(r.count(), 20);
  EXPECT_NEAR(r.angular_frequency[14], 3.9734185936, 4e-9);
  EXPECT_NEAR(r.angular_frequency[19], 5.4439114988, 5e-9);
}

INSTANTIATE_TEST_SUITE_P(ClosedForms, PeriodicCube,
                         ::testing::Values(ModalSolver::lanczos, ModalSolver::arpack, ModalSolver::dense),
                         [](const auto& instance) {
                           return instance.param == ModalSolver::lanczos  ? "lanczos"
                                  : instance.param == ModalSolver::arpack ? "arpack"
                                                                          : "dense";
                         });

}  // namespace
}  // namespace perimode
