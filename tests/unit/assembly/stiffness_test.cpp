// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <omp.h>

#include <Eigen/Dense>
#include <random>

#include "perimode/assembly/assemble.hpp"
#include "support/models.hpp"

namespace perimode {
namespace {

using test::add_crack;
using test::add_wall;
using test::add_walls;
using test::box_model;

Eigen::MatrixXd dense(const BlockCsr& m) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(m.rows * m.block, m.rows * m.block);
  for (Index i = 0; i < m.rows; ++i) {
    for (Offset e = m.row_start[i]; e < m.row_start[i + 1]; ++e) {
      for (int r = 0; r < m.block; ++r) {
        for (int c = 0; c < m.block; ++c) {
          a(i * m.block + r, m.column[e] * m.block + c) = m.value[(e * m.block + r) * m.block + c];
        }
      }
    }
  }
  return a;
}

Eigen::MatrixXd dense(const Csr& m) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(m.rows, m.cols);
  for (Index i = 0; i < m.rows; ++i) {
    for (Offset e = m.row_start[i]; e < m.row_start[i + 1]; ++e) a(i, m.column[e]) += m.value[e];
  }
  return a;
}

/// R K_all T with K_all summed bond by bond as rank-one matrices over particles and ghosts.
template <int Dim>
Eigen::MatrixXd by_bonds(const Body<Dim>& body) {
  const auto maps = boundary_matrices(body.boundary);
  const Index n = body.count();
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(maps.t.rows, maps.t.rows);
  for (Index i = 0; i < n; ++i) {
    for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<Dim>& e) {
      Eigen::VectorXd b = Eigen::VectorXd::Zero(maps.t.rows);
      b.segment<Dim>(i * Dim) += e.xi / e.length;
      b.segment<Dim>(e.neighbour * Dim) -= e.xi / e.length;
      const double once = e.neighbour < n ? 0.5 : 1.0;  // both ends of an inner bond are visited
      all += once * bond_stiffness(body, i, e) * b * b.transpose();
    });
  }
  return dense(maps.r) * all * dense(maps.t);
}

template <int Dim>
void expect_equals_bonds(const Model& model) {
  const auto body = build_body<Dim>(model);
  const Eigen::MatrixXd expected = by_bonds(body);
  const Eigen::MatrixXd got = dense(scalar_csr(assemble_stiffness(body), body.boundary.free_number));
  EXPECT_LE((got - expected).cwiseAbs().maxCoeff(), 1e-13 * expected.cwiseAbs().maxCoeff());
}

TEST(Stiffness, EqualsTheSumOfRankOneMatricesForEveryKernelAndCalibration) {
  for (auto kernel : {Kernel::constant, Kernel::conical, Kernel::gaussian, Kernel::inverse_distance}) {
    for (auto calibration : {Calibration::continuum, Calibration::discrete, Calibration::discrete_cut}) {
      Model m = box_model({9, 7}, 0.5, 2.0);
      m.material.micromodulus.kernel = kernel;
      m.calibration = calibration;
      m.volume_correction = VolumeCorrection::linear;
      add_crack(m, {{2.0, -0.1}, {2.0, 1.5}});
      expect_equals_bonds<2>(m);
    }
  }
}

TEST(Stiffness, EqualsTheSumOfRankOneMatricesForEveryWall) {
  for (auto type :
       {WallType::odd, WallType::even, WallType::mirror, WallType::antimirror, WallType::zero_layer}) {
    Model m = box_model({6, 5}, 0.5, 2.0);
    add_wall(m, 0, false, type);
    add_wall(m, 1, true, WallType::mirror);
    m.calibration = Calibration::discrete;
    add_crack(m, {{-0.1, 1.0}, {1.0, 1.0}});
    expect_equals_bonds<2>(m);
    Model bar = box_model({12}, 0.5, 3.0);
    add_wall(bar, 0, false, type);
    test::add_surface_nodes(bar, 0, true);
    expect_equals_bonds<1>(bar);
    bar.boundary.clear();
    test::add_surface_traction(bar, false, 1.0);
    expect_equals_bonds<1>(bar);
  }
}

TEST(Stiffness, EqualsTheSumOfRankOneMatricesForThinAndPeriodicBodies) {
  Model thin = box_model({2, 3, 5}, 1.0, 2.0);
  thin.periodic = {true, true, false};
  expect_equals_bonds<3>(thin);
  Model walls = box_model({1, 2}, 1.0, 3.0);  // thinner than the horizon between two walls
  add_walls(walls, 0, WallType::mirror);
  add_walls(walls, 1, WallType::antimirror);
  expect_equals_bonds<2>(walls);
}

TEST(Stiffness, EqualsTheSumOfRankOneMatricesForBlocksAndHoles) {
  Model m = box_model({10, 8}, 1.0, 2.0);
  m.blocks.push_back({"stiff", Region{BallRegion{{3.0, 3.0}, 2.0}, {}}});
  m.block_materials["stiff"] = m.material;
  m.block_materials["stiff"].youngs_modulus = 7.0;
  m.block_materials["stiff"].micromodulus.kernel = Kernel::gaussian;
  std::get<GridSpec>(m.particles).remove.push_back(Region{BallRegion{{7.0, 5.0}, 1.2}, {}});
  m.calibration = Calibration::discrete;
  expect_equals_bonds<2>(m);
}

template <int Dim>
void expect_rigid_motions_free(const Model& model) {
  const auto body = build_body<Dim>(model);
  const Eigen::MatrixXd k = dense(assemble_stiffness(body));
  const double scale = k.cwiseAbs().maxCoeff();
  EXPECT_EQ((k - k.transpose()).cwiseAbs().maxCoeff(), 0.0) << "symmetric to the last bit";
  Eigen::MatrixXd q = Eigen::MatrixXd::Zero(k.rows(), Dim * (Dim + 1) / 2);
  for (Index i = 0; i < body.count(); ++i) {
    const auto& x = body.particles.position[i];
    for (int a = 0; a < Dim; ++a) q(i * Dim + a, a) = 1.0;
    int column = Dim;
    for (int a = 0; a < Dim; ++a) {
      for (int b = a + 1; b < Dim; ++b, ++column) {
        q(i * Dim + a, column) = -x[b];
        q(i * Dim + b, column) = x[a];
      }
    }
  }
  // Each entry of K q sums about 100 products of size scale * |q|.
  EXPECT_LE((k * q).cwiseAbs().maxCoeff(), 1e-13 * scale * q.cwiseAbs().maxCoeff());
}

TEST(Stiffness, IsSymmetricAndLeavesRigidMotionsFree) {
  for (auto kernel : {Kernel::constant, Kernel::conical, Kernel::gaussian, Kernel::inverse_distance}) {
    for (double ratio : {1.0, 2.0, 3.0}) {
      Model bar = box_model({40}, 0.1, ratio);
      Model plate = box_model({11, 9}, 0.1, ratio);
      Model block = box_model({5, 6, 4}, 0.1, ratio);
      for (Model* m : {&bar, &plate, &block}) {
        m->material.micromodulus.kernel = kernel;
        m->calibration = ratio == 2.0 ? Calibration::discrete : Calibration::continuum;
        m->volume_correction = ratio == 3.0 ? VolumeCorrection::linear : VolumeCorrection::none;
      }
      expect_rigid_motions_free<1>(bar);
      expect_rigid_motions_free<2>(plate);
      expect_rigid_motions_free<3>(block);
    }
  }
}

TEST(Stiffness, HasTheSameBitsForAnyNumberOfThreads) {
  Model m = box_model({40, 30}, 1.0, 3.0);
  m.calibration = Calibration::discrete;
  add_wall(m, 0, false, WallType::odd);
  add_crack(m, {{20.0, -1.0}, {20.0, 15.0}});
  const auto body = build_body<2>(m);
  omp_set_num_threads(1);
  const auto one = assemble_stiffness(body);
  omp_set_num_threads(2);
  const auto two = assemble_stiffness(body);
  EXPECT_EQ(one.column, two.column);
  EXPECT_EQ(one.value, two.value);
}

/// Energy of pure dilation over the continuum's, at an inner and at a corner particle.
template <int Dim>
std::pair<double, double> dilation_ratio(const Model& model) {
  const auto body = build_body<Dim>(model);
  const double continuum = dilation_energy(1.0, {Dim, model.plane, 1.0});
  const auto ratio = [&](Index i) {
    double w = 0.0;  // 1/4 sum k_b |xi| |xi| / V_i per unit volume, stretch 1
    for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<Dim>& e) {
      w += 0.25 * bond_stiffness(body, i, e) * e.length * e.length / body.particles.volume[i];
    });
    return w / continuum;
  };
  return {ratio(body.count() / 2), ratio(0)};
}

TEST(Calibration, DiscreteStoresTheDilationEnergyOfCompleteFamilies) {
  for (double ratio : {2.0, 3.0, 2.5}) {
    Model m = box_model({6, 6, 6}, 1.0, ratio);
    m.periodic = {true, true, true};
    m.calibration = Calibration::discrete;
    m.material.micromodulus.kernel = Kernel::inverse_distance;
    EXPECT_NEAR(dilation_ratio<3>(m).first, 1.0, 1e-13);
    Model walls = box_model({7, 7}, 1.0, ratio);
    add_walls(walls, 0, WallType::mirror);
    add_walls(walls, 1, WallType::zero_layer);
    walls.calibration = Calibration::discrete;
    EXPECT_NEAR(dilation_ratio<2>(walls).first, 1.0, 1e-13);
    EXPECT_NEAR(dilation_ratio<2>(walls).second, 1.0, 1e-13);
  }
}

TEST(Calibration, SelfImagesOfThinPeriodicBodiesCount) {
  // One particle: all its bonds are to its own images, so none is left to carry energy, but a second one
  // makes the family complete: its energy with the missing self-images added is the continuum's.
  Model m = box_model({2}, 1.0, 3.0);
  m.periodic[0] = true;
  m.calibration = Calibration::discrete;
  const auto body = build_body<1>(m);
  Model open = box_model({60}, 1.0, 3.0);
  open.calibration = Calibration::discrete;
  const auto bulk = build_body<1>(open);
  EXPECT_NEAR(body.constants.factor[0], bulk.constants.factor[30], 1e-14);
}

TEST(Calibration, DiscreteIgnoresTheCrackAndDiscreteCutDoesNot) {
  Model m = box_model({20, 20}, 1.0, 3.0);
  add_crack(m, {{10.0, -1.0}, {10.0, 10.0}});
  m.calibration = Calibration::discrete;
  const auto whole = build_body<2>(m);
  m.calibration = Calibration::discrete_cut;
  const auto cut = build_body<2>(m);
  const Index beside = 9 + 20 * 4;
  const Index away = 4 + 20 * 10;
  EXPECT_NEAR(whole.constants.factor[beside], whole.constants.factor[away], 1e-14);
  EXPECT_GT(cut.constants.factor[beside], 1.2 * whole.constants.factor[beside]);
}

TEST(Calibration, StrainEnergyErrorsOfTheLattice) {
  // [ganzenmueller2013] original calibration, 3D, delta^2/dx^2: relative energy error N/((4/3) pi m^3) - 1.
  const std::vector<std::pair<double, double>> table = {{3, .19454594},  {4, -.04507034}, {5, .19576107},
                                                        {6, .29949467},  {8, -.02934647}, {9, .07871684},
                                                        {12, .02225566}, {16, -.04507034}};
  for (const auto& [square, error] : table) {
    Model m = box_model({12, 12, 12}, 1.0, std::sqrt(square));
    m.periodic = {true, true, true};
    m.material.micromodulus.kernel = Kernel::inverse_distance;
    EXPECT_NEAR(dilation_ratio<3>(m).first - 1.0, error, 1e-8) << square;
    m.calibration = Calibration::discrete;
    EXPECT_NEAR(dilation_ratio<3>(m).first, 1.0, 1e-12) << square;
  }
}

TEST(Calibration, BondsBetweenBlocksTakeTheHarmonicMean) {
  Model m = box_model({4}, 1.0, 1.0);
  m.blocks.push_back({"right", Region{BoxRegion{{2.0}, {4.0}}, {}}});
  m.block_materials["right"] = m.material;
  m.block_materials["right"].youngs_modulus = 3.0;
  const auto body = build_body<1>(m);
  const auto k = [&](Index i) {
    double value = 0.0;
    for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<1>& e) {
      if (e.neighbour == i + 1) value = bond_stiffness(body, i, e);
    });
    return value;
  };
  EXPECT_NEAR(k(1) / k(0), 2.0 * 1.0 * 3.0 / (1.0 + 3.0), 1e-14);
  EXPECT_NEAR(k(2) / k(0), 3.0, 1e-14);
}

TEST(BondEnergy, IsHalfTheQuadraticFormOfK) {
  for (auto type : {WallType::mirror, WallType::antimirror, WallType::zero_layer}) {
    Model m = box_model({9, 8}, 1.0, 2.0);
    add_wall(m, 0, false, type);
    m.periodic[1] = true;
    const auto body = build_body<2>(m);
    const Eigen::MatrixXd k = dense(assemble_stiffness(body));
    std::mt19937 gen(3);
    std::normal_distribution<double> normal;
    Eigen::MatrixXd u(k.rows(), 3);
    for (auto& x : u.reshaped()) x = normal(gen);
    const Eigen::VectorXd energy = bond_energy(body, u);
    for (int f = 0; f < 3; ++f) EXPECT_NEAR(energy[f], 0.5 * u.col(f).dot(k * u.col(f)), 1e-13 * energy[f]);
  }
}

TEST(UniformStrain, LeavesNoForceOnParticlesWithCompleteFamilies) {
  Model m = box_model({15, 13}, 1.0, 3.0);
  m.volume_correction = VolumeCorrection::linear;
  const auto body = build_body<2>(m);
  const Eigen::MatrixXd k = dense(assemble_stiffness(body));
  Eigen::Matrix2d strain;
  strain << 1.0, 0.4, -0.2, 0.7;
  Eigen::VectorXd u(k.rows());
  for (Index i = 0; i < body.count(); ++i) u.segment<2>(2 * i) = strain * body.particles.position[i];
  const Eigen::VectorXd force = k * u;
  for (Index i = 0; i < body.count(); ++i) {
    const auto& x = body.particles.position[i];
    if (x[0] < 4 || x[0] > 11 || x[1] < 4 || x[1] > 9) continue;
    EXPECT_LE(force.segment<2>(2 * i).norm(), 1e-13 * k.cwiseAbs().maxCoeff() * u.cwiseAbs().maxCoeff());
  }
}

}  // namespace
}  // namespace perimode
