// SPDX-License-Identifier: BSD-3-Clause
// What turning, reflecting, scaling or describing a body in another way must not change.
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "perimode/assembly/assemble.hpp"
#include "verification/modes_of.hpp"

namespace perimode {
namespace {

using test::box_model;
using test::certified_modes;
using test::fix_face;
using test::lowest;

/// Share of a unit vector's mass norm that lies in the span of the modes with about the eigenvalue `value`.
double share_in_level(const ModalResult& r, const Eigen::VectorXd& mass, const Eigen::VectorXd& x,
                      double value) {
  double share = 0.0;
  for (Eigen::Index k = 0; k < r.count(); ++k) {
    if (std::abs(r.eigenvalue[k] - value) > 1e-8 * value) continue;
    share += std::pow(r.shape.col(k).dot(mass.cwiseProduct(x)), 2);
  }
  return share;
}

TEST(Symmetry, ModesOfARectangleAreSymmetricOrAntisymmetric) {
  constexpr int nx = 18, ny = 11;
  Model m = box_model({nx, ny}, 0.1, 3.0);
  fix_face(m, 1, false, 2, {0, 1});  // the clamped edge keeps the reflection of x
  const auto body = build_body<2>(m);
  const auto r = certified_modes<2>(m, lowest(16));
  for (Eigen::Index k = 0; k < r.count(); ++k) {
    Eigen::VectorXd reflected(r.shape.rows());
    for (int j = 2; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        const Index to = body.boundary.free_number[2 * (i + nx * j)];
        const Index from = body.boundary.free_number[2 * (nx - 1 - i + nx * j)];
        reflected[to] = -r.shape(from, k);
        reflected[to + 1] = r.shape(from + 1, k);
      }
    }
    const double even = (reflected - r.shape.col(k)).norm(), odd = (reflected + r.shape.col(k)).norm();
    EXPECT_LE(std::min(even, odd), 1e-7 * r.shape.col(k).norm()) << "mode " << k + 1;
  }
}

TEST(Symmetry, TurningASquareKeepsItsEigenspaces) {
  constexpr int n = 13;
  const Model m = box_model({n, n}, 0.1, 3.0);
  const auto body = build_body<2>(m);
  const auto mass = lumped_mass(body);
  const auto r = certified_modes<2>(m, lowest(24, ModalSolver::lanczos));
  for (Eigen::Index k = 3; k < 21; ++k) {  // a level cut by the count has no copy left to turn into
    Eigen::VectorXd turned(r.shape.rows());
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const Index to = 2 * (n - 1 - j + n * i), from = 2 * (i + n * j);
        turned[to] = -r.shape(from + 1, k);
        turned[to + 1] = r.shape(from, k);
      }
    }
    EXPECT_NEAR(share_in_level(r, mass, turned, r.eigenvalue[k]), 1.0, 1e-9) << "mode " << k + 1;
  }
}

TEST(Symmetry, FrequenciesScaleAsTheyMust) {
  Model m = box_model({12, 7}, 0.1, 3.0);
  fix_face(m, 0, false, 3, {0, 1});
  const auto base = certified_modes<2>(m, lowest(20));
  Model stiff = m;
  stiff.material.youngs_modulus = 49.0;
  Model heavy = m;
  heavy.material.density = 9.0;
  Model thick = m;
  thick.thickness = 0.3;
  Model large = box_model({12, 7}, 0.4, 3.0);
  fix_face(large, 0, false, 3, {0, 1});
  const std::pair<const Model*, double> expected[] = {
      {&stiff, 7.0}, {&heavy, 1.0 / 3.0}, {&thick, 1.0}, {&large, 0.25}};
  for (const auto& [model, factor] : expected) {
    const auto r = certified_modes<2>(*model, lowest(20));
    for (int k = 0; k < 20; ++k) {
      const double omega = factor * base.angular_frequency[k];
      EXPECT_NEAR(r.angular_frequency[k], omega, 1e-11 * omega);
    }
  }
}

class CloudOfAGrid : public ::testing::Test {
 protected:
  void SetUp() override {
    file_ = std::filesystem::temp_directory_path() / ("perimode_cloud_" + std::to_string(getpid()) + ".csv");
  }
  void TearDown() override { std::filesystem::remove(file_); }

  /// The particles of a grid body in random order, turned by `angle` about the z axis, as a cloud with the
  /// same horizon; boundary conditions are left to the caller.
  template <int Dim>
  Model cloud_of(const Model& model, double angle = 0.0) {
    const auto body = build_body<Dim>(model);
    std::vector<Index> order(body.count());
    for (Index i = 0; i < body.count(); ++i) order[i] = i;
    std::mt19937 gen(5);
    for (Index i = body.count() - 1; i > 0; --i) std::swap(order[i], order[gen() % (i + 1)]);
    std::ofstream out(file_);
    out.precision(17);
    out << (Dim == 1 ? "x" : Dim == 2 ? "x,y" : "x,y,z") << ",volume,block\n";
    for (Index i : order) {
      Point<Dim> x = body.particles.position[i];
      if constexpr (Dim > 1) {
        const double x0 = x[0];
        x[0] = std::cos(angle) * x0 - std::sin(angle) * x[1];
        x[1] = std::sin(angle) * x0 + std::cos(angle) * x[1];
      }
      for (int a = 0; a < Dim; ++a) out << x[a] << ',';
      out << body.particles.volume[i] << ',' << body.particles.block_names[body.particles.block[i]] << '\n';
    }
    Model cloud = model;
    cloud.particles = CloudSpec{file_, {}};
    cloud.blocks.clear();
    cloud.boundary.clear();
    cloud.horizon = {
        HorizonSpec::Rule::length, model.horizon.value * std::get<GridSpec>(model.particles).spacing, {}};
    return cloud;
  }

  template <int Dim>
  void expect_same(const Model& grid, const Model& cloud, int modes, double relative) {
    const auto expected = certified_modes<Dim>(grid, lowest(modes));
    const auto got = certified_modes<Dim>(cloud, lowest(modes));
    ASSERT_EQ(got.count(), expected.count());
    EXPECT_EQ(got.rigid_modes, expected.rigid_modes);
    for (Eigen::Index k = 0; k < got.count(); ++k) {
      EXPECT_NEAR(got.eigenvalue[k], expected.eigenvalue[k], relative * expected.eigenvalue[k])
          << "mode " << k + 1;
    }
  }

  std::filesystem::path file_;
};

void clamp_cloud(Model& m, double depth, std::vector<int> components) {
  m.boundary.push_back({Fix{std::move(components), Region{FaceRegion{{0, false}, 0, depth}, {}}}, {}});
}

TEST_F(CloudOfAGrid, HasItsModesForEveryKernelCalibrationAndCorrection) {
  for (auto kernel : {Kernel::constant, Kernel::conical, Kernel::gaussian, Kernel::inverse_distance}) {
    for (auto calibration : {Calibration::continuum, Calibration::discrete}) {
      for (auto correction : {VolumeCorrection::none, VolumeCorrection::linear}) {
        Model m = box_model({12, 7}, 0.1, 3.0);
        m.thickness = 0.02;
        m.material.micromodulus.kernel = kernel;
        m.calibration = calibration;
        m.volume_correction = correction;
        Model cloud = cloud_of<2>(m);
        fix_face(m, 0, false, 3, {0, 1});
        clamp_cloud(cloud, 0.25, {0, 1});
        expect_same<2>(m, cloud, 40, 1e-10);
      }
    }
  }
}

TEST_F(CloudOfAGrid, HasItsModesWithBlocksAndCracks) {
  Model m = box_model({14, 9}, 0.1, 3.0);
  m.blocks.push_back({"core", Region{BallRegion{{0.9, 0.4}, 0.25}, {}}});
  m.block_materials["core"] = m.material;
  m.block_materials["core"].youngs_modulus = 5.0;
  m.block_materials["core"].density = 3.0;
  m.calibration = Calibration::discrete;
  test::add_crack(m, {{0.5, -0.1}, {0.5, 0.42}});
  expect_same<2>(m, cloud_of<2>(m), 30, 1e-10);
}

TEST_F(CloudOfAGrid, HasItsModesInOneAndThreeDimensions) {
  Model bar = box_model({60}, 0.01, 3.0);
  bar.volume_correction = VolumeCorrection::linear;
  bar.area = 0.5;
  expect_same<1>(bar, cloud_of<1>(bar), 60, 1e-9);
  Model block = box_model({6, 5, 4}, 0.1, 2.0);
  block.volume_correction = VolumeCorrection::linear;
  block.calibration = Calibration::discrete;
  expect_same<3>(block, cloud_of<3>(block), 40, 1e-10);
}

/// The cloud of a grid repeats itself where the grid does, after the length of its box.
void make_periodic(Model& grid, Model& cloud, const std::array<bool, 3>& axes) {
  const auto& box = std::get<GridSpec>(grid.particles);
  grid.periodic = cloud.periodic = axes;
  auto& period = std::get<CloudSpec>(cloud.particles).period;
  for (std::size_t a = 0; a < box.upper.size(); ++a) period.push_back(box.upper[a] - box.lower[a]);
}

TEST_F(CloudOfAGrid, HasItsModesWherePeriodic) {
  Model bar = box_model({40}, 0.01, 3.0);
  bar.volume_correction = VolumeCorrection::linear;
  Model cloud = cloud_of<1>(bar);
  make_periodic(bar, cloud, {true, false, false});
  expect_same<1>(bar, cloud, 40, 1e-9);
  for (const bool both : {false, true}) {
    Model plate = box_model({14, 9}, 0.1, 3.0);
    plate.blocks.push_back({"core", Region{BallRegion{{1.3, 0.4}, 0.25}, {}}});
    plate.block_materials["core"] = plate.material;
    plate.block_materials["core"].youngs_modulus = 5.0;
    plate.block_materials["core"].density = 3.0;
    plate.calibration = Calibration::discrete_cut;
    test::add_crack(plate, {{1.2, 0.25}, {1.75, 0.42}});
    cloud = cloud_of<2>(plate);
    make_periodic(plate, cloud, {true, both, false});
    expect_same<2>(plate, cloud, 40, 1e-10);
  }
  Model block = box_model({6, 5, 5}, 0.1, 2.0);
  cloud = cloud_of<3>(block);
  make_periodic(block, cloud, {true, true, true});
  expect_same<3>(block, cloud, 40, 1e-10);
}

// No angle is special: the distances of the lattice, and with them the ties at the horizon, stay.
TEST_F(CloudOfAGrid, KeepsItsFrequenciesWhenItIsTurned) {
  for (double angle : {0.1, 0.7, 2.9}) {
    Model m = box_model({12, 7}, 0.1, 3.0);
    m.calibration = Calibration::discrete;
    expect_same<2>(m, cloud_of<2>(m, angle), 30, 1e-9);
  }
}

TEST_F(CloudOfAGrid, CountedNeighboursKeepTheFourNearest) {
  Model m = box_model({12, 9}, 0.1, 1.0);
  Model cloud = cloud_of<2>(m);
  cloud.horizon = {HorizonSpec::Rule::neighbours, 4, {}};
  const auto body = build_body<2>(cloud);
  // Inner particles reach their 4 axis neighbours; border ones reach further, corner ones to their fourth.
  EXPECT_GT(count_bonds(body.bonds, body.count()), 11 * 9 + 12 * 8);
  const auto r = solve_modes(body, lowest(10));
  EXPECT_EQ(r.rigid_modes, 3);
}

}  // namespace
}  // namespace perimode
