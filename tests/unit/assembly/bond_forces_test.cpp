// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/assembly/bond_forces.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "perimode/assembly/assemble.hpp"
#include "perimode/assembly/fields.hpp"
#include "perimode/assembly/operators.hpp"
#include "perimode/linalg/threads.hpp"
#include "unit/assembly/plain_bond_forces.hpp"

namespace perimode {
namespace {

using test::add_crack;
using test::add_wall;
using test::add_walls;
using test::alive_bits;
using test::both;
using test::box_model;
using test::energy_at;
using test::expect_plain;
using test::fix_face;
using test::force;
using test::of_blocks;
using test::random_vector;
using test::shaken;

constexpr double infinite = std::numeric_limits<double>::infinity();

TEST(BondForces, EqualThePlainSumInOneDimension) {
  expect_plain<1>(box_model({37}, 0.1, 3.0));
  Model m = box_model({37}, 0.1, 4.0);
  m.volume_correction = VolumeCorrection::linear;
  add_wall(m, 0, false, WallType::odd);
  add_wall(m, 0, true, WallType::surface_nodes);
  expect_plain<1>(m);
  m = box_model({5}, 0.1, 4.0);  // images of images
  m.periodic = {true, false, false};
  expect_plain<1>(m);
}

TEST(BondForces, EqualThePlainSumInTwoDimensions) {
  Model m = box_model({21, 13}, 0.1, 3.0);
  add_crack(m, {{0.85, 0.4}, {1.45, 0.4}});
  fix_face(m, 0, false, 3, {0, 1});
  fix_face(m, 1, false, 2, {1});
  expect_plain<2>(m);
  m = box_model({21, 13}, 0.1, 3.0);
  add_walls(m, 0, WallType::mirror);
  add_wall(m, 1, false, WallType::antimirror);
  add_wall(m, 1, true, WallType::zero_layer);
  expect_plain<2>(m);
  m.calibration = Calibration::discrete;
  expect_plain<2>(m);
  m = box_model({9, 4}, 0.1, 3.0);
  m.periodic = {true, true, false};
  expect_plain<2>(m);
}

TEST(BondForces, EqualThePlainSumInThreeDimensions) {
  Model m = box_model({11, 7, 6}, 0.1, 3.0);
  expect_plain<3>(m);
  add_walls(m, 2, WallType::mirror);
  m.periodic = {false, true, false};
  fix_face(m, 0, true, 2, {0, 2});
  m.volume_correction = VolumeCorrection::linear;
  expect_plain<3>(m);
}

/// A plate with a stiff disk of another kernel and a square of the plate's own material.
Model plate_of_blocks(Calibration calibration) {
  Model m = box_model({17, 12}, 1.0, 3.0);
  m.blocks.push_back({"stiff", Region{BallRegion{{6.0, 5.0}, 3.0}, {}}});
  m.blocks.push_back({"same", Region{BoxRegion{{11.0, 3.0}, {16.0, 8.0}}, {}}});
  m.block_materials["stiff"] = m.material;
  m.block_materials["stiff"].youngs_modulus = 7.0;
  m.block_materials["stiff"].micromodulus.kernel = Kernel::gaussian;
  m.calibration = calibration;
  return m;
}

TEST(BondForces, EqualThePlainSumBetweenMaterials) {
  for (const Calibration calibration : {Calibration::continuum, Calibration::discrete}) {
    expect_plain<2>(plate_of_blocks(calibration));
    expect_plain<3>(of_blocks({16, 9, 8}, calibration));
  }
}

/// A cloud file for the life of the test.
struct CloudFile {
  std::filesystem::path path =
      std::filesystem::path(testing::TempDir()) / ("bond_forces_cloud_" + std::to_string(getpid()) + ".csv");
  explicit CloudFile(int dim) {
    std::ofstream out(path);
    out << (dim == 1 ? "x" : dim == 2 ? "x,y" : "x,y,z") << ",volume,block\n";
    for (int i = 0; i < 300; ++i) {  // a lattice shaken by a known hand
      const int place[] = {i % 10, i / 10 % 6, i / 60};
      for (int a = 0; a < dim; ++a)
        out << (dim == 1 ? i : (dim == 2 && a == 1 ? i / 10 : place[a])) + 0.2 * std::sin(7.0 * i + a) << ',';
      out << 1.0 + 0.1 * std::cos(3.0 * i) << ',' << (i % 3 == 0 ? "one" : "two") << '\n';
    }
  }
  ~CloudFile() { std::filesystem::remove(path); }
  CloudFile(const CloudFile&) = delete;
  CloudFile& operator=(const CloudFile&) = delete;
};

template <int Dim>
Model cloud_model(const CloudFile& file) {
  Model m;
  m.dimension = Dim;
  m.particles = CloudSpec{file.path, {}};
  m.horizon = {HorizonSpec::Rule::length, 2.6, {}};
  m.material.youngs_modulus = m.material.density = 1.0;
  m.block_materials["one"] = m.material;
  m.block_materials["one"].youngs_modulus = 3.0;
  m.calibration = Calibration::discrete;
  m.boundary.push_back({Prescribe{{{0, 0.1}}, Region{FaceRegion{{0, false}, 0, 1.0}, {}}, {}}, {}});
  return m;
}

template <int Dim>
void expect_cloud() {
  const CloudFile file(Dim);
  for (const bool periodic : {false, true}) {
    Model m = cloud_model<Dim>(file);
    std::get<CloudSpec>(m.particles).period = {Dim == 1 ? 300.6 : 10.6, 30.6, 6.0};
    m.periodic[0] = m.periodic[Dim - 1] = periodic;
    const auto body = build_body<Dim>(m);
    expect_plain<Dim>(body, {});
    expect_plain<Dim>(body, {infinite, 0.05, 0.03}, {4, 5, 100});
  }
}

TEST(BondForces, EqualThePlainSumOnClouds) {
  expect_cloud<1>();
  expect_cloud<2>();
  expect_cloud<3>();
}

TEST(BondForces, LimitsOfBlocksAndParticlesThatHoldTheirBonds) {
  Model m = plate_of_blocks(Calibration::continuum);
  add_wall(m, 0, false, WallType::mirror);
  const auto body = build_body<2>(m);
  expect_plain<2>(body, {0.03, infinite, 0.05}, {0, 1, 2, 17, 18, 100, 101});
}

TEST(BondForces, GivenDisplacementsAtAnInstant) {
  Model m = box_model({15, 9}, 0.1, 3.0);
  const TimeFunction ramp{TimeFunction::Kind::ramp, 2.0, 0.0, {}, {}, {}};
  m.boundary.push_back(
      {Prescribe{{{0, 0.02}, {1, -0.01}}, Region{FaceRegion{{0, true}, 3, 0.0}, {}}, ramp}, {}});
  m.boundary.push_back({Prescribe{{{1, 0.005}}, Region{FaceRegion{{0, false}, 3, 0.0}, {}}, {}}, {}});
  const auto body = build_body<2>(m);
  for (const double t : {0.0, 0.5, 3.0}) {
    expect_plain<2>(body, {}, {}, t);
    expect_plain<2>(body, {0.03}, {}, t);
  }
}

/// Work of given motion: forces on moving dofs are the slopes of the strain energy.
TEST(BondForces, ForceOnMovingDofsIsTheSlopeOfTheEnergy) {
  Model m = box_model({15, 9}, 0.1, 3.0);
  const TimeFunction ramp{TimeFunction::Kind::ramp, 1.0, 0.0, {}, {}, {}};
  m.boundary.push_back({Prescribe{{{0, 0.02}}, Region{FaceRegion{{0, true}, 3, 0.0}, {}}, ramp}, {}});
  auto body = build_body<2>(m);
  for (const Kinematics kinematics : both) {
    BondForces<2> forces(body, kinematics, {});
    const Eigen::VectorXd q = shaken(body, 3);
    const auto energy = [&](double t) {
      forces.set_time(t);
      return energy_at(forces, q);
    };
    const double h = 1e-4;
    const double slope = (energy(0.5 + h) - energy(0.5 - h)) / (2.0 * h);
    forces.set_time(0.5);
    (void)force(forces, q);
    ASSERT_EQ(forces.moving_force().size(), 27U);
    double power = 0.0;
    for (std::size_t k = 0; k < 27; ++k) {
      EXPECT_DOUBLE_EQ(forces.moving_displacement()[k], 0.01);
      power += forces.moving_force()[k] * 0.02;
    }
    EXPECT_NEAR(power, slope, 1e-6 * std::abs(slope));  // central difference: h^2
  }
}

template <int Dim>
void expect_slopes(const Model& model) {
  auto body = build_body<Dim>(model);
  for (const Kinematics kinematics : both) {
    BondForces<Dim> forces(body, kinematics, {});
    const Eigen::VectorXd q = shaken(body, 4);
    const Eigen::VectorXd direction = random_vector(q.size(), 5);
    const double h = 1e-6;
    const Eigen::VectorXd up = q + h * direction, down = q - h * direction;
    const double slope = (energy_at(forces, up) - energy_at(forces, down)) / (2.0 * h);
    EXPECT_NEAR(force(forces, q).dot(direction), slope, 1e-6 * std::abs(slope));
    if (kinematics == Kinematics::linear) {
      const Eigen::MatrixXd u = Eigen::Map<const Eigen::VectorXd>(
          body.boundary.expand(q.data()).data(), static_cast<Eigen::Index>(body.boundary.free_number.size()));
      EXPECT_NEAR(energy_at(forces, q) / bond_energy(body, u)[0], 1.0, 1e-12);
    }
  }
}

TEST(BondForces, AreTheSlopesOfTheStrainEnergy) {
  Model m = box_model({12, 9}, 0.1, 3.0);
  expect_slopes<2>(m);
  add_walls(m, 0, WallType::mirror);
  add_wall(m, 1, true, WallType::zero_layer);
  expect_slopes<2>(m);
  expect_slopes<3>(of_blocks({16, 9, 8}, Calibration::discrete));
  const CloudFile file(2);
  m = cloud_model<2>(file);
  m.boundary.clear();
  expect_slopes<2>(m);
}

/// u of a rotation by an angle about a point outside the body.
template <int Dim>
Eigen::VectorXd rotated(const Body<Dim>& body, double angle) {
  Eigen::Matrix<double, Dim, Dim> r;
  if constexpr (Dim == 2) r = Eigen::Rotation2Dd(angle).toRotationMatrix();
  if constexpr (Dim == 3)
    r = Eigen::AngleAxisd(angle, Eigen::Vector3d(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
  Eigen::VectorXd u(static_cast<Eigen::Index>(body.count()) * Dim);
  for (Index i = 0; i < body.count(); ++i) {
    const Point<Dim> x = body.particles.position[i].array() + 0.3;
    u.segment<Dim>(static_cast<Eigen::Index>(i) * Dim) = r * x - x;
  }
  return u;
}

/// The stretch of a rotated bond is round-off of its coordinates over its length; nothing breaks at 1e-12.
TEST(BondForces, RotationsByAnyAngleGiveNoForce) {
  for (const double angle : {1e-6, 0.3, 1.5707963267948966, 3.0, -2.2}) {
    auto plane = build_body<2>(box_model({14, 9}, 0.1, 3.0));
    BondForces<2> in_plane(plane, Kinematics::large_rotation, {1e-12});
    const double scale = stiffness_bound(plane) * 2.0;  // N, of displacements of the size of the body
    EXPECT_LE(force(in_plane, rotated(plane, angle)).cwiseAbs().maxCoeff(), 1e-14 * scale);
    EXPECT_EQ(in_plane.broken(), 0);
    auto block = build_body<3>(box_model({8, 7, 6}, 0.1, 3.0));
    BondForces<3> in_space(block, Kinematics::large_rotation, {1e-12});
    EXPECT_LE(force(in_space, rotated(block, angle)).cwiseAbs().maxCoeff(),
              1e-14 * stiffness_bound(block) * 2.0);
    EXPECT_EQ(in_space.broken(), 0);
  }
}

/// Large rotations without cancellation: at a strain of 1e-12 the relative error of the force is that of the
/// linear one, 1e-12 by the strain itself and round-off, not 1e-4 as |y| - |xi| would have it.
TEST(BondForces, SmallDisplacementsGiveTheLinearProduct) {
  for (const double size : {1e-4, 1e-8, 1e-12}) {
    auto body = build_body<3>(of_blocks({16, 9, 8}, Calibration::discrete));
    const auto k = stiffness_operator(body, StiffnessForm::blocks);
    const Eigen::VectorXd q = size * random_vector(body.boundary.free, 6);
    const Eigen::VectorXd expected = multiply(k, q);
    for (const Kinematics kinematics : both) {
      BondForces<3> forces(body, kinematics, {});
      const double bound = kinematics == Kinematics::linear ? 1e-14 : 3.0 * size + 1e-14;
      EXPECT_LE((force(forces, q) - expected).norm(), bound * expected.norm());
    }
  }
}

/// Momentum and moment of momentum: internal forces sum to nothing, and so do their moments about the places
/// where the particles are now. To round-off of sums of n terms of the largest size.
template <int Dim>
void expect_balance(Body<Dim> body) {
  for (const bool breaking : {false, true}) {
    BondForces<Dim> forces(body, Kinematics::large_rotation,
                           std::vector<double>(breaking ? body.density.size() : 0, 0.03));
    const Eigen::VectorXd q = rotated(body, 1.0) + shaken(body, 7);
    const Eigen::VectorXd y = force(forces, q);
    Point<Dim> sum = Point<Dim>::Zero();
    double moment = 0.0, scale = 0.0;
    for (Index i = 0; i < body.count(); ++i) {
      const Point<Dim> f = y.segment<Dim>(static_cast<Eigen::Index>(i) * Dim);
      const Point<Dim> x = body.particles.position[i] + q.segment<Dim>(static_cast<Eigen::Index>(i) * Dim);
      sum += f;
      moment += x[0] * f[1] - x[1] * f[0];
      scale += f.norm() * x.norm();
    }
    EXPECT_LE(sum.norm(), 1e-14 * y.cwiseAbs().sum());
    EXPECT_LE(std::abs(moment), 1e-14 * scale);
    EXPECT_EQ(forces.broken() > 0, breaking);
  }
}

TEST(BondForces, SumToNothing) {
  expect_balance<2>(build_body<2>(box_model({14, 9}, 1.0, 3.0)));
  expect_balance<3>(build_body<3>(of_blocks({16, 9, 8}, Calibration::discrete)));
  const CloudFile file(3);
  Model m = cloud_model<3>(file);
  m.boundary.clear();
  expect_balance<3>(build_body<3>(m));
}

/// Two particles: a stretch just below and just above the critical one, and what is reported of it.
TEST(BondForces, ABondBreaksOnceAndOnlyBeyondItsStretch) {
  for (const Kinematics kinematics : both) {
    auto body = build_body<1>(box_model({2}, 1.0, 1.0));
    BondForces<1> forces(body, kinematics, {0.01});
    const auto stretched = [](double s) { return Eigen::Vector2d(0.25, 0.25 + s); };
    EXPECT_NE(force(forces, stretched(0.01 * (1.0 - 1e-12)))[0], 0.0);
    EXPECT_NE(force(forces, stretched(-0.5))[0], 0.0);  // compression breaks nothing
    EXPECT_EQ(forces.broken(), 0);
    EXPECT_EQ(force(forces, stretched(0.01 * (1.0 + 1e-12))), Eigen::Vector2d::Zero());
    EXPECT_EQ(forces.broken(), 1);
    // c = 2 E/(A delta^2) = 2, k = c V^2/|xi| = 2, k s^2/2.
    EXPECT_NEAR(forces.broken_energy(), 1e-4, 1e-15);
    EXPECT_EQ(force(forces, stretched(0.001)), Eigen::Vector2d::Zero());  // never heals
    EXPECT_EQ(force(forces, stretched(0.5)), Eigen::Vector2d::Zero());
    EXPECT_EQ(forces.broken(), 1);
    EXPECT_EQ(count_bonds(body.bonds, 2), 0);
  }
}

/// An evaluation that breaks bonds counts those it leaves alive; the broken ones held the rest.
TEST(BondForces, StrainEnergyIsThatOfTheBondsAlive) {
  Model m = box_model({14, 9}, 0.1, 3.0);
  add_wall(m, 0, false, WallType::mirror);
  for (const Kinematics kinematics : both) {
    auto body = build_body<2>(m);
    BondForces<2> forces(body, kinematics, {0.03});
    const Eigen::VectorXd q = shaken(body, 1);
    auto whole = build_body<2>(m);
    BondForces<2> unbreakable(whole, kinematics, {});
    const double all = energy_at(unbreakable, q);
    EXPECT_NEAR(energy_at(forces, q) + forces.broken_energy(), all, 1e-13 * all);
    EXPECT_GT(forces.broken_energy(), 0.1 * all);
    EXPECT_EQ(forces.last_broken_energy(q.data()), forces.broken_energy());
  }
}

TEST(BondForces, SaveAndRestore) {
  auto body = build_body<2>(box_model({14, 9}, 0.1, 3.0));
  BondForces<2> forces(body, Kinematics::large_rotation, {0.03});
  const Eigen::VectorXd first = shaken(body, 1), second = shaken(body, 2);
  (void)force(forces, first);
  const auto state = forces.save();
  const Eigen::VectorXd expected = force(forces, second);
  const auto broken = forces.broken();
  const double energy = forces.broken_energy();
  EXPECT_GT(broken, state.broken);

  auto again_body = build_body<2>(box_model({14, 9}, 0.1, 3.0));
  BondForces<2> again(again_body, Kinematics::large_rotation, {0.03});
  again.restore(state);
  EXPECT_EQ(force(again, second), expected);
  EXPECT_EQ(again.broken(), broken);
  EXPECT_EQ(again.broken_energy(), energy);
  EXPECT_THROW(again.restore({}), Error);
}

TEST(BondForces, SameBitsForAnyNumberOfThreads) {
  Model m = box_model({60, 41}, 0.1, 3.0);
  add_wall(m, 0, false, WallType::mirror);
  std::vector<Eigen::VectorXd> y;
  std::vector<double> energy;
  std::vector<std::vector<std::uint64_t>> bits;
  const int before = threads();
  for (const int count : {1, 2, 3}) {
    set_threads(count);
    auto body = build_body<2>(m);
    BondForces<2> forces(body, Kinematics::large_rotation, {0.04});
    y.push_back(force(forces, shaken(body, 8)));
    energy.push_back(forces.broken_energy());
    energy.push_back(energy_at(forces, y.back()));
    bits.push_back(alive_bits(body));
    EXPECT_GT(forces.broken(), 0);
  }
  set_threads(before);
  for (std::size_t k : {1U, 2U}) {
    EXPECT_EQ(y[k], y[0]);
    EXPECT_EQ(energy[2 * k], energy[0]);
    EXPECT_EQ(energy[2 * k + 1], energy[1]);
    EXPECT_EQ(bits[k], bits[0]);
  }
}

TEST(BondForces, RefuseWrongCriticalStretches) {
  auto body = build_body<2>(box_model({14, 9}, 0.1, 3.0));
  EXPECT_THROW(BondForces<2>(body, Kinematics::linear, {0.1, 0.1}), Error);
  EXPECT_THROW(BondForces<2>(body, Kinematics::linear, {0.0}), Error);
  EXPECT_THROW(BondForces<2>(body, Kinematics::linear, {std::nan("")}), Error);
}

}  // namespace
}  // namespace perimode
