// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/reference/closed_form.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

#include "perimode/dispersion/symbol.hpp"
#include "support/relative.hpp"

namespace perimode {
namespace {

using std::numbers::pi;
using test::expect_relative;
using ::testing::HasSubstr;

Model grid_model(const std::vector<int>& cells, double spacing, double ratio) {
  Model model;
  model.dimension = static_cast<int>(cells.size());
  GridSpec grid;
  for (const int n : cells) {
    grid.lower.push_back(-0.3);
    grid.upper.push_back(-0.3 + n * spacing);
  }
  grid.spacing = spacing;
  model.particles = grid;
  model.horizon = {HorizonSpec::Rule::ratio, ratio, {}};
  model.material.youngs_modulus = 1.0;
  model.material.density = 1.0;
  model.volume_correction = VolumeCorrection::linear;
  return model;
}

void add_wall(Model& model, int axis, bool upper, WallType type) {
  model.boundary.push_back({Wall{{axis, upper}, type, {}}, {}});
}

std::vector<ClosedFormMode> modes_of(const Model& model, int count) {
  std::string why_not;
  const auto modes = closed_form_modes(model, count, why_not);
  EXPECT_TRUE(modes.has_value()) << why_not;
  return modes.value_or(std::vector<ClosedFormMode>{});
}

// How one axis of the brute-force body ends: a wall type on each side, or periodic.
struct AxisCase {
  int cells;
  bool periodic;
  WallType lower, upper;
};

// The stiffness over the mass built particle by particle: every offset of the family is followed from
// particle to particle, one step at a time, through images and reflections.
template <int Dim>
Eigen::MatrixXd follow_bonds(const Model& model, const std::vector<AxisCase>& axes) {
  const auto& grid = std::get<GridSpec>(model.particles);
  const double horizon = model.horizon.value * grid.spacing;
  const double section = Dim == 1 ? model.area : (Dim == 2 ? model.thickness : 1.0);
  const Medium medium = {model.material, {Dim, model.plane, section}, horizon};
  const Family<Dim> family =
      make_family<Dim>(grid.spacing, horizon, model.volume_correction, model.self_cell);
  const std::vector<double> rates = bond_rates<Dim>(medium, family, model.calibration);
  int particles = 1;
  for (const AxisCase& axis : axes) particles *= axis.cells;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(Dim * particles, Dim * particles);
  for (int i = 0; i < particles; ++i) {
    for (std::size_t j = 0; j < family.offset.size(); ++j) {
      Point<Dim> n;
      Point<Dim> sign = Point<Dim>::Ones();  // of each component at the far end, in terms of its original
      int target = 0, stride = 1, rest = i;
      for (int a = 0; a < Dim; ++a) {
        const AxisCase& axis = axes[static_cast<std::size_t>(a)];
        const int o = family.offset[j][static_cast<std::size_t>(a)];
        n[a] = grid.spacing * o / family.length[j];
        int place = rest % axis.cells + o;
        rest /= axis.cells;
        while (place < 0 || place >= axis.cells) {
          if (axis.periodic) {
            place += place < 0 ? axis.cells : -axis.cells;
            continue;
          }
          const WallType wall = place < 0 ? axis.lower : axis.upper;
          place = place < 0 ? -1 - place : 2 * axis.cells - 1 - place;
          for (int b = 0; b < Dim; ++b) {
            const bool odd = wall == WallType::odd || (wall == WallType::mirror && a == b) ||
                             (wall == WallType::antimirror && a != b);
            if (odd) sign[b] = -sign[b];
          }
        }
        target += stride * place;
        stride *= axis.cells;
      }
      const Eigen::Matrix<double, Dim, Dim> block = rates[j] * n * n.transpose();
      matrix.template block<Dim, Dim>(Dim * i, Dim * i) += block;
      matrix.template block<Dim, Dim>(Dim * i, Dim * target) -= block * sign.asDiagonal();
    }
  }
  return matrix;
}

struct SeparableCase {
  std::string name;
  std::vector<AxisCase> axes;
  Kernel kernel = Kernel::constant;
  double ratio = 2.0;
  Calibration calibration = Calibration::continuum;
  VolumeCorrection correction = VolumeCorrection::linear;
  friend std::ostream& operator<<(std::ostream& out, const SeparableCase& c) { return out << c.name; }
};

Model model_of(const SeparableCase& c) {
  std::vector<int> cells;
  for (const AxisCase& axis : c.axes) cells.push_back(axis.cells);
  Model model = grid_model(cells, 0.1, c.ratio);
  model.thickness = 0.3;
  model.area = 0.2;
  model.material.density = 2.0;
  model.material.micromodulus.kernel = c.kernel;
  model.calibration = c.calibration;
  model.volume_correction = c.correction;
  for (std::size_t a = 0; a < c.axes.size(); ++a) {
    if (c.axes[a].periodic) {
      model.periodic[a] = true;
    } else {
      add_wall(model, static_cast<int>(a), false, c.axes[a].lower);
      add_wall(model, static_cast<int>(a), true, c.axes[a].upper);
    }
  }
  return model;
}

class SeparableBodies : public ::testing::TestWithParam<SeparableCase> {};

TEST_P(SeparableBodies, HaveAllTheEigenvaluesOfTheAssembledMatrix) {
  const SeparableCase& c = GetParam();
  const Model model = model_of(c);
  const Eigen::MatrixXd matrix = c.axes.size() == 1   ? follow_bonds<1>(model, c.axes)
                                 : c.axes.size() == 2 ? follow_bonds<2>(model, c.axes)
                                                      : follow_bonds<3>(model, c.axes);
  const double scale = matrix.cwiseAbs().maxCoeff();
  ASSERT_LT((matrix - matrix.transpose()).cwiseAbs().maxCoeff(), 1e-14 * scale);
  const Eigen::VectorXd exact =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
  const auto modes = modes_of(model, static_cast<int>(exact.size()) + 5);
  ASSERT_EQ(static_cast<Eigen::Index>(modes.size()), exact.size());
  for (Eigen::Index i = 0; i < exact.size(); ++i) {
    const double omega = modes[static_cast<std::size_t>(i)].discrete;
    EXPECT_NEAR(omega * omega, exact[i], 1e-13 * exact[exact.size() - 1]) << "mode " << i;
  }
}

constexpr AxisCase odd_odd(int n) { return {n, false, WallType::odd, WallType::odd}; }
constexpr AxisCase even_even(int n) { return {n, false, WallType::even, WallType::even}; }
constexpr AxisCase odd_even(int n) { return {n, false, WallType::odd, WallType::even}; }
constexpr AxisCase mirror(int n) { return {n, false, WallType::mirror, WallType::mirror}; }
constexpr AxisCase antimirror(int n) { return {n, false, WallType::antimirror, WallType::antimirror}; }
constexpr AxisCase mirror_antimirror(int n) { return {n, false, WallType::mirror, WallType::antimirror}; }
constexpr AxisCase antimirror_mirror(int n) { return {n, false, WallType::antimirror, WallType::mirror}; }
constexpr AxisCase images(int n) { return {n, true, WallType::odd, WallType::odd}; }

INSTANTIATE_TEST_SUITE_P(
    ClosedForm, SeparableBodies,
    ::testing::Values(
        SeparableCase{"bar_odd", {odd_odd(12)}, Kernel::inverse_distance, 5.0},
        SeparableCase{"bar_even", {even_even(11)}, Kernel::gaussian, 3.0},
        SeparableCase{"bar_odd_even", {odd_even(12)}, Kernel::conical, 4.0, Calibration::discrete},
        SeparableCase{"bar_exact",
                      {odd_odd(12)},
                      Kernel::constant,
                      2.3,
                      Calibration::continuum,
                      VolumeCorrection::exact},
        SeparableCase{"bar_periodic", {images(13)}},
        SeparableCase{"bar_periodic_thin", {images(4)}, Kernel::constant, 6.0},
        SeparableCase{"bar_odd_thin", {odd_odd(3)}, Kernel::constant, 5.0},
        SeparableCase{"plate_mirror", {mirror(7), mirror(5)}, Kernel::constant, 3.0},
        SeparableCase{"plate_antimirror", {antimirror(7), antimirror(5)}, Kernel::gaussian, 3.0},
        SeparableCase{"plate_mirror_by_antimirror",
                      {mirror(6), antimirror(5)},
                      Kernel::conical,
                      2.0,
                      Calibration::discrete},
        SeparableCase{"plate_mixed", {mirror_antimirror(6), antimirror_mirror(5)}},
        SeparableCase{"plate_mixed_by_mirror", {mirror_antimirror(6), mirror(5)}},
        SeparableCase{"plate_periodic_by_mirror", {images(6), mirror(5)}, Kernel::inverse_distance, 2.0},
        SeparableCase{"plate_periodic",
                      {images(6), images(7)},
                      Kernel::constant,
                      3.0,
                      Calibration::continuum,
                      VolumeCorrection::none},
        SeparableCase{
            "plate_periodic_thin", {images(9), images(1)}, Kernel::constant, 3.0, Calibration::discrete},
        SeparableCase{"cube_mirror", {mirror(4), mirror(4), mirror(4)}},
        SeparableCase{"block_antimirror", {antimirror(5), antimirror(4), antimirror(3)}, Kernel::gaussian},
        SeparableCase{
            "block_of_everything", {mirror_antimirror(4), images(5), antimirror(3)}, Kernel::conical},
        SeparableCase{"block_mirror_mixed_antimirror", {mirror(4), antimirror_mirror(3), antimirror(4)}},
        SeparableCase{"block_periodic",
                      {images(4), images(5), images(3)},
                      Kernel::inverse_distance,
                      2.0,
                      Calibration::discrete},
        SeparableCase{"block_periodic_thin", {images(6), images(6), images(1)}}),
    [](const auto& param) { return param.param.name; });

TEST(ClosedForm, SelfCellBarMatchesTheAssembledMatrix) {
  SeparableCase c{"", {odd_odd(20)}, Kernel::inverse_distance, 4.0};
  Model model = model_of(c);
  model.self_cell = true;
  const Eigen::VectorXd exact =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(follow_bonds<1>(model, c.axes), Eigen::EigenvaluesOnly)
          .eigenvalues();
  const auto modes = modes_of(model, 20);
  for (std::size_t i = 0; i < 20; ++i) {
    expect_relative(modes[i].discrete, std::sqrt(exact[static_cast<Eigen::Index>(i)]), 1e-12);
  }
}

// Lowest levels of the periodic unit cube, 8^3 cells, m = 2 (80 bonds), E = rho = 1, with multiplicities.
TEST(ClosedForm, LevelsOfThePeriodicCube) {
  Model model = grid_model({8, 8, 8}, 0.125, 2.0);
  model.periodic = {true, true, true};
  struct Level {
    double omega;
    int multiplicity;
  };
  const std::vector<Level> levels = {
      {0.0, 3},          {3.9734185936, 12}, {5.4439114988, 12}, {5.7582203886, 12}, {6.6866647117, 16},
      {6.9893880835, 6}, {7.1602627591, 12}, {7.7851177468, 24}, {8.0704556194, 24}, {8.4005598673, 24}};
  const auto modes = modes_of(model, 146);
  std::size_t i = 0;
  for (const Level& level : levels) {
    for (int copy = 0; copy < level.multiplicity; ++copy, ++i)
      expect_relative(modes[i].discrete, level.omega, 1e-10);
    EXPECT_GT(modes[i].discrete, 1.001 * modes[i - 1].discrete);  // the level ends here
  }
}

TEST(ClosedForm, RigidTranslationsAreThereWhereTheWallsAllowThem) {
  Model slab = grid_model({6, 5, 4}, 0.1, 2.0);
  slab.periodic = {true, true, false};
  add_wall(slab, 2, false, WallType::mirror);
  add_wall(slab, 2, true, WallType::mirror);
  const auto modes = modes_of(slab, 3);
  EXPECT_EQ(modes[0].discrete, 0.0);
  EXPECT_EQ(modes[1].discrete, 0.0);
  EXPECT_EQ(modes[0].classical, 0.0);
  EXPECT_EQ(modes[0].nonlocal, 0.0);
  EXPECT_GT(modes[2].discrete, 0.1);
}

TEST(ClosedForm, BarCarriesAllThreeFrequencies) {
  Model bar = grid_model({1000}, 1e-3, 10.0);
  bar.material.youngs_modulus = 68e9;
  bar.material.density = 2700.0;
  add_wall(bar, 0, false, WallType::odd);
  add_wall(bar, 0, true, WallType::odd);
  const auto modes = modes_of(bar, 5);
  const double speed = std::sqrt(68e9 / 2700.0);
  const Medium medium = {bar.material, {1, Plane::stress, 1.0}, 1e-2};
  for (int n = 1; n <= 5; ++n) {
    const ClosedFormMode& mode = modes[static_cast<std::size_t>(n - 1)];
    expect_relative(mode.classical, n * pi * speed, 1e-14);
    expect_relative(mode.nonlocal, continuum_frequency(medium, Branch::pressure, n * pi), 1e-14);
    EXPECT_LT(mode.nonlocal, mode.classical);
    expect_relative(mode.discrete, mode.nonlocal, 1e-5);
  }
}

TEST(ClosedForm, PlateModesAreSortedAndKeepTheirBranch) {
  Model plate = grid_model({32, 16}, 1.0 / 32.0, 3.0);
  for (const int axis : {0, 1}) {
    add_wall(plate, axis, false, WallType::mirror);
    add_wall(plate, axis, true, WallType::mirror);
  }
  const auto modes = modes_of(plate, 20);
  const auto by_frequency = [](const ClosedFormMode& a, const ClosedFormMode& b) {
    return a.discrete < b.discrete;
  };
  EXPECT_TRUE(std::is_sorted(modes.begin(), modes.end(), by_frequency));
  // The lowest is sin(pi x) along x, a pressure wave of k = pi; then (1,1), a shear wave of k = pi sqrt 5.
  expect_relative(modes[0].classical, pi * std::sqrt(1.125), 1e-14);
  expect_relative(modes[1].discrete, 4.3403612835, 1e-10);
  expect_relative(modes[1].nonlocal, 4.2785676741, 1e-10);
  expect_relative(modes[1].classical, pi * std::sqrt(5.0 * 0.375), 1e-14);
  for (const ClosedFormMode& mode : modes) EXPECT_NEAR(mode.discrete / mode.nonlocal, 1.0, 0.05);
}

TEST(ClosedForm, AHorizonGivenAsALengthIsTheSameHorizon) {
  Model by_ratio = grid_model({10}, 0.1, 3.0);
  by_ratio.periodic[0] = true;
  Model by_length = by_ratio;
  by_length.horizon = {HorizonSpec::Rule::length, 0.3, {}};
  expect_relative(modes_of(by_length, 4)[3].discrete, modes_of(by_ratio, 4)[3].discrete, 1e-14);
}

std::string reason(const Model& model) {
  std::string why_not;
  EXPECT_FALSE(closed_form_modes(model, 3, why_not).has_value());
  return why_not;
}

TEST(ClosedForm, SaysWhyABodyDoesNotSeparate) {
  Model plate = grid_model({8, 8}, 0.1, 3.0);
  plate.periodic = {true, true, false};
  EXPECT_EQ(modes_of(plate, 2).size(), 2U);

  Model free_face = plate;
  free_face.periodic[1] = false;
  add_wall(free_face, 1, false, WallType::mirror);
  EXPECT_THAT(reason(free_face), HasSubstr("y+"));

  Model clamped = free_face;
  add_wall(clamped, 1, true, WallType::odd);  // reflects both components: not separable in 2D
  EXPECT_THAT(reason(clamped), HasSubstr("y+"));

  Model fixed = plate;
  fixed.boundary.push_back({Fix{{0, 1}, {FaceRegion{{0, false}, 3, 0.0}, {}}}, {}});
  EXPECT_THAT(reason(fixed), HasSubstr("fixed"));

  Model holed = plate;
  std::get<GridSpec>(holed.particles).remove.push_back({BallRegion{{0.0, 0.0}, 0.1}, {}});
  EXPECT_THAT(reason(holed), HasSubstr("removed"));

  Model cracked = plate;
  cracked.precracks.push_back({{{0.0, 0.0}, {0.1, 0.0}}, {}});
  EXPECT_THAT(reason(cracked), HasSubstr("pre-cracks"));

  Model inclusion = plate;
  inclusion.block_materials["core"] = plate.material;
  EXPECT_THAT(reason(inclusion), HasSubstr("material"));

  Model cloud = plate;
  cloud.particles = CloudSpec{"cloud.csv", {}};
  EXPECT_THAT(reason(cloud), HasSubstr("cloud"));

  Model neighbours = plate;
  neighbours.horizon.rule = HorizonSpec::Rule::neighbours;
  EXPECT_THAT(reason(neighbours), HasSubstr("neighbours"));
}

TEST(ClosedForm, ABarWithSurfaceNodesOrAZeroLayerDoesNotSeparate) {
  for (const WallType type : {WallType::surface_nodes, WallType::zero_layer}) {
    Model bar = grid_model({20}, 0.05, 3.0);
    add_wall(bar, 0, false, WallType::odd);
    add_wall(bar, 0, true, type);
    EXPECT_THAT(reason(bar), HasSubstr("x+"));
  }
}

}  // namespace
}  // namespace perimode
