// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>

#include "perimode/assembly/assemble.hpp"
#include "perimode/assembly/fields.hpp"
#include "perimode/assembly/operators.hpp"
#include "support/models.hpp"

namespace perimode {
namespace {

/// Cubes of 8 sizes, 1 to 128: a box of 4 x 4 x 4 cells whose corner of 2 x 2 x 2 is such a box of half the
/// size, and so on. A mesh whose nodes do not fit together, which particles do not mind.
class GradedBox : public testing::Test {
 protected:
  void SetUp() override {
    std::string nodes, elements;
    int node = 0, element = 0;
    double size = 1.0;
    for (int level = 0; level < 8; ++level, size *= 0.5) {
      const int inner = level < 7 ? 2 : 0;
      for (int c = 0; c < 64; ++c) {
        const int i = c % 4, j = c / 4 % 4, k = c / 16;
        if (i < inner && j < inner && k < inner) continue;
        elements += fmt::format("{} 5 0", ++element);
        for (const auto& [a, b, d] : {std::array{0, 0, 0},
                                      {1, 0, 0},
                                      {1, 1, 0},
                                      {0, 1, 0},
                                      {0, 0, 1},
                                      {1, 0, 1},
                                      {1, 1, 1},
                                      {0, 1, 1}}) {
          nodes += fmt::format("{} {} {} {}\n", ++node, size * (i + a), size * (j + b), size * (k + d));
          elements += fmt::format(" {}", node);
        }
        elements += "\n";
      }
    }
    std::ofstream(file_) << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n"
                         << node << "\n"
                         << nodes << "$EndNodes\n$Elements\n"
                         << element << "\n"
                         << elements << "$EndElements\n";
    model_ = test::box_model({1, 1, 1}, 1.0, 1.0);
    model_.particles = CloudSpec{file_};
    model_.horizon = {HorizonSpec::Rule::neighbours, 30.0, {}};
    model_.calibration = Calibration::discrete;
  }
  void TearDown() override { std::filesystem::remove(file_); }

  std::filesystem::path file_ =
      std::filesystem::temp_directory_path() /
      (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".msh");
  Model model_;
};

TEST_F(GradedBox, NeighboursAreThoseOfACountByHand) {
  const auto body = build_body<3>(model_);
  const auto& x = body.particles.position;
  const auto& bonds = std::get<CloudBonds<3>>(body.bonds);
  ASSERT_EQ(body.count(), 7 * 56 + 64);
  std::vector<double> horizon;
  for (const auto& here : x) {
    std::vector<double> distance;
    for (const auto& there : x) distance.push_back((there - here).norm());
    std::sort(distance.begin(), distance.end());
    horizon.push_back(distance[30]);  // its own comes first
  }
  EXPECT_GT(*std::max_element(horizon.begin(), horizon.end()),
            60.0 * *std::min_element(horizon.begin(), horizon.end()));
  for (Index i = 0; i < body.count(); ++i) {
    std::vector<Index> expected;
    for (Index j = 0; j < body.count(); ++j) {
      if (j != i && (x[j] - x[i]).norm() <= std::max(horizon[i], horizon[j]) * (1.0 + 1e-9))
        expected.push_back(j);
    }
    EXPECT_EQ(
        std::vector(bonds.neighbour.begin() + bonds.start[i], bonds.neighbour.begin() + bonds.start[i + 1]),
        expected);
  }
}

TEST_F(GradedBox, StiffnessIsSymmetricAndADilationHasItsEnergy) {
  for (const Kernel kernel : {Kernel::constant, Kernel::conical}) {
    for (const auto correction : {VolumeCorrection::none, VolumeCorrection::linear}) {
      model_.material.micromodulus.kernel = kernel;
      model_.volume_correction = correction;
      const auto body = build_body<3>(model_);
      EXPECT_NEAR(std::accumulate(body.particles.volume.begin(), body.particles.volume.end(), 0.0), 64.0,
                  1e-12);
      const LinearOperator k = stiffness_operator(body);
      EXPECT_LE(asymmetry(k), 1e-15);
      // Energy 3 E e^2 per volume: 9/2 times the bulk modulus 2 E / 3. Every family holds it, whatever the
      // sizes.
      Eigen::VectorXd u(body.boundary.free);
      for (Index i = 0; i < body.count(); ++i) u.segment<3>(3 * i) = 1e-3 * body.particles.position[i];
      const double energy = 0.5 * u.dot(multiply(k, u));
      EXPECT_NEAR(energy, 3e-6 * 64.0, 1e-12 * 3e-6 * 64.0);
      // No force on the whole: the sum of forces against that of their magnitudes.
      const Eigen::VectorXd force = internal_force(body, u);
      Point<3> net = Point<3>::Zero();
      for (Index i = 0; i < body.count(); ++i) net += force.segment<3>(3 * i);
      EXPECT_LE(net.norm(), 1e-13 * force.cwiseAbs().sum());
    }
  }
}

}  // namespace
}  // namespace perimode
