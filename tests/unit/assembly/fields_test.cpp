// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/assembly/fields.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <random>

#include "perimode/assembly/assemble.hpp"
#include "support/models.hpp"

namespace perimode {
namespace {

using test::add_crack;
using test::add_wall;
using test::box_model;

constexpr Kernel kernels[] = {Kernel::constant, Kernel::conical, Kernel::gaussian, Kernel::inverse_distance};

template <int Dim>
using Tensor = Eigen::Matrix<double, Dim, Dim>;

/// A gradient without symmetry: strain and rotation.
template <int Dim>
Tensor<Dim> some_gradient() {
  Tensor<Dim> h;
  for (int a = 0; a < Dim; ++a) {
    for (int b = 0; b < Dim; ++b) h(a, b) = 1e-3 * (1.0 + 3 * a - 2 * b + a * b * b);
  }
  return h;
}

template <int Dim>
Eigen::VectorXd linear_field(const Body<Dim>& body, const Tensor<Dim>& h) {
  Eigen::VectorXd u(static_cast<Eigen::Index>(body.count()) * Dim);
  for (Index i = 0; i < body.count(); ++i) u.template segment<Dim>(Dim * i) = h * body.particles.position[i];
  return u;
}

template <int Dim>
Eigen::VectorXd voigt(const Tensor<Dim>& t) {
  if constexpr (Dim == 1) return Eigen::VectorXd{{t(0, 0)}};
  if constexpr (Dim == 2) return Eigen::VectorXd{{t(0, 0), t(1, 1), t(0, 1)}};
  if constexpr (Dim == 3) return Eigen::VectorXd{{t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(0, 2), t(1, 2)}};
}

Eigen::VectorXd random_displacement(Eigen::Index size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  return Eigen::VectorXd::NullaryExpr(size, [&] { return uniform(random); });
}

template <int Dim>
void expect_uniform_strain(const Model& model) {
  const auto body = build_body<Dim>(model);
  const Tensor<Dim> h = some_gradient<Dim>();
  const Eigen::VectorXd expected = voigt<Dim>(0.5 * (h + h.transpose()));
  const Eigen::MatrixXd got = strain(body, linear_field(body, h));
  ASSERT_EQ(got.rows(), tensor_components<Dim>);
  for (Index i = 0; i < body.count(); ++i)
    EXPECT_LE((got.col(i) - expected).cwiseAbs().maxCoeff(), 1e-13 * expected.cwiseAbs().maxCoeff());
}

TEST(Strain, OfALinearFieldIsItsSymmetricGradientAlsoAtFacesHolesAndCracks) {
  expect_uniform_strain<1>(box_model({12}, 0.1, 3.0));
  Model plate = box_model({12, 9}, 0.1, 3.0);
  add_crack(plate, {{0.6, 0.0}, {0.6, 0.5}});
  std::get<GridSpec>(plate.particles).remove = {{BallRegion{{0.3, 0.4}, 0.2}, {}}};
  for (Kernel kernel : kernels) {
    plate.material.micromodulus.kernel = kernel;
    expect_uniform_strain<2>(plate);
  }
  expect_uniform_strain<3>(box_model({6, 5, 4}, 0.1, 2.0));
}

TEST(Strain, OutsideTheSpanOfTheBondsIsZero) {
  // A single row of particles in the plane: only xx is known; a rotation strains nothing.
  const auto body = build_body<2>(box_model({8, 1}, 0.1, 2.0));
  Tensor<2> h;
  h << 1e-3, 7e-3, 5e-3, 2e-3;
  const Eigen::MatrixXd got = strain(body, linear_field<2>(body, h));
  for (Index i = 0; i < body.count(); ++i) {
    EXPECT_NEAR(got(0, i), 1e-3, 1e-16);
    EXPECT_EQ(got(1, i), 0.0);
    EXPECT_NEAR(got(2, i), 0.0, 1e-17);
  }
}

/// Particles whose whole family lies in the body.
template <int Dim>
std::vector<Index> bulk(const Body<Dim>& body) {
  const auto& bonds = std::get<GridBonds<Dim>>(body.bonds);
  std::vector<Index> inside;
  for (Index i = 0; i < body.count(); ++i) {
    int present = 0;
    for_each_bond(bonds, i, Which::alive, [&](const BondEnd<Dim>&) { ++present; });
    if (present == bonds.family.size()) inside.push_back(i);
  }
  return inside;
}

/// Stress of a uniform strain in the bulk is the lattice sum (1/2) sum c beta V r n n (n . H n), written out
/// over the family's own offsets.
template <int Dim>
void expect_lattice_stress(Model model) {
  const auto body = build_body<Dim>(model);
  const Tensor<Dim> h = some_gradient<Dim>();
  const Family<Dim>& f = std::get<GridBonds<Dim>>(body.bonds).family;
  Tensor<Dim> expected = Tensor<Dim>::Zero();
  for (int k = 0; k < f.size(); ++k) {
    Point<Dim> n;
    for (int a = 0; a < Dim; ++a) n[a] = f.spacing * f.offset[k][a] / f.length[k];
    const double c = body.constants.kernel[k] * f.weight[k] * body.particles.volume[0];
    expected += 0.5 * c * f.length[k] * n.dot(h * n) * n * n.transpose();
  }
  const auto inside = bulk(body);
  ASSERT_FALSE(inside.empty());
  const Eigen::MatrixXd got = stress(body, linear_field(body, h));
  for (Index i : inside) EXPECT_LE((got.col(i) - voigt<Dim>(expected)).norm(), 1e-12 * expected.norm());
}

TEST(Stress, OfAUniformStrainInTheBulkIsTheLatticeSum) {
  for (Kernel kernel : kernels) {
    for (VolumeCorrection correction : {VolumeCorrection::none, VolumeCorrection::linear}) {
      const auto with = [&](Model m) {
        m.material.micromodulus.kernel = kernel;
        m.volume_correction = correction;
        return m;
      };
      expect_lattice_stress<1>(with(box_model({12}, 0.1, 3.0)));
      expect_lattice_stress<2>(with(box_model({10, 9}, 0.1, 3.0)));
      expect_lattice_stress<3>(with(box_model({7, 7, 7}, 0.1, 2.0)));
    }
  }
}

/// Discrete calibration: a dilation s stores the continuum's energy W s^2 in every family, and by homogeneity
/// sigma : I s = 2 W s^2. The factor of a bond is the mean of its ends, so bulk means here that all partners
/// have whole families too.
template <int Dim>
void expect_exact_dilation(const std::vector<int>& cells, double ratio, Plane plane,
                           double trace_per_strain) {
  Model model = box_model(cells, 0.1, ratio);
  model.plane = plane;
  model.calibration = Calibration::discrete;
  for (Kernel kernel : kernels) {
    model.material.micromodulus.kernel = kernel;
    const auto body = build_body<Dim>(model);
    const double s = 1e-4;
    const Eigen::MatrixXd got = stress(body, linear_field<Dim>(body, s * Tensor<Dim>::Identity()));
    Index i = 0;  // the middle
    for (Index k = 1; k < body.count(); ++k) {
      Point<Dim> centre;
      for (int a = 0; a < Dim; ++a) centre[a] = 0.05 * cells[a];
      if ((body.particles.position[k] - centre).norm() < (body.particles.position[i] - centre).norm()) i = k;
    }
    EXPECT_NEAR(got.col(i).head(Dim).sum(), trace_per_strain * s, 1e-12 * trace_per_strain * s);
    for (int a = 1; a < Dim; ++a) EXPECT_NEAR(got(a, i), got(0, i), 1e-12 * got(0, i));
  }
}

TEST(Stress, OfADilationIsExactUnderDiscreteCalibration) {
  expect_exact_dilation<1>({15}, 3.0, Plane::stress, 1.0);             // 2 E/2
  expect_exact_dilation<2>({15, 15}, 3.0, Plane::stress, 3.0);         // 2 (3E/2)
  expect_exact_dilation<2>({15, 15}, 3.0, Plane::strain, 16.0 / 5.0);  // 2 (8E/5)
  expect_exact_dilation<3>({11, 11, 11}, 2.0, Plane::stress, 6.0);     // 2 (3E)
}

TEST(Damage, OfAPrecrackIsTheShareOfBondsCut) {
  // Nearest neighbours only, cut between columns 2 and 3 in the lower two rows: one bond of four (or three).
  Model m = box_model({6, 4}, 1.0, 1.0);
  add_crack(m, {{3.0, -1.0}, {3.0, 2.0}});
  const auto body = build_body<2>(m);
  const Eigen::VectorXd d = damage(body);
  for (Index i = 0; i < body.count(); ++i) {
    const auto& x = body.particles.position[i];
    const bool beside = std::abs(x[0] - 3.0) < 1.0 && x[1] < 2.0;
    const double expected = !beside ? 0.0 : x[1] < 1.0 ? 1.0 / 3.0 : 0.25;
    EXPECT_NEAR(d[i], expected, 1e-15) << x.transpose();
  }
}

TEST(Damage, OfAPeriodicBodyAndOfALoneParticleIsZero) {
  Model m = box_model({4, 4}, 1.0, 3.0);
  m.periodic = {true, true, false};  // bonds to own images carry nothing and are not broken
  EXPECT_EQ(damage(build_body<2>(m)), Eigen::VectorXd::Zero(16));
  Model lone = box_model({5}, 1.0, 1.0);
  std::get<GridSpec>(lone.particles).remove = {{NearestRegion{{1.5}}, {}}};
  EXPECT_EQ(damage(build_body<1>(lone)), Eigen::VectorXd::Zero(4));
}

template <int Dim>
void expect_energy_sums(const Model& model) {
  const auto body = build_body<Dim>(model);
  const Eigen::VectorXd u = random_displacement(static_cast<Eigen::Index>(body.count()) * Dim, 3);
  const Eigen::VectorXd density = energy_density(body, u);
  double sum = 0.0;
  for (Index i = 0; i < body.count(); ++i) sum += density[i] * body.particles.volume[i];
  const double expected = bond_energy(body, u)[0];
  EXPECT_NEAR(sum, expected, 1e-13 * std::abs(expected));
}

TEST(EnergyDensity, SumsToTheStrainEnergyWithEveryWall) {
  expect_energy_sums<1>(box_model({20}, 0.1, 3.0));
  expect_energy_sums<3>(box_model({5, 4, 4}, 0.1, 2.0));
  for (WallType type :
       {WallType::odd, WallType::even, WallType::mirror, WallType::antimirror, WallType::zero_layer}) {
    Model m = box_model({7, 6}, 0.1, 3.0);
    m.volume_correction = VolumeCorrection::linear;
    m.calibration = Calibration::discrete;
    add_crack(m, {{0.0, 0.2}, {0.3, 0.4}});
    add_wall(m, 0, false, type);
    add_wall(m, 1, true, WallType::mirror);
    expect_energy_sums<2>(m);
    Model thin = box_model({9, 2}, 0.1, 3.0);  // reflected several times
    add_wall(thin, 1, false, type);
    add_wall(thin, 1, true, type);
    expect_energy_sums<2>(thin);
  }
  Model nodes = box_model({20}, 0.1, 3.0);
  add_wall(nodes, 0, false, WallType::surface_nodes);
  expect_energy_sums<1>(nodes);
}

TEST(Fields, OfHalfABodyAtAMirrorAreThoseOfTheWhole) {
  const auto make = [](int columns) {
    Model m = box_model({columns, 7}, 0.1, 3.0);
    m.volume_correction = VolumeCorrection::linear;
    return m;
  };
  Model half_model = make(8);
  add_wall(half_model, 0, false, WallType::mirror);
  const auto half = build_body<2>(half_model);
  const auto whole = build_body<2>(make(16));
  const Eigen::VectorXd u = random_displacement(2 * half.count(), 5);
  Eigen::VectorXd both(2 * whole.count());
  for (Index row = 0; row < 7; ++row) {
    for (Index k = 0; k < 8; ++k) {
      const Eigen::Vector2d v = u.segment<2>(2 * (8 * row + k));
      both.segment<2>(2 * (16 * row + 8 + k)) = v;
      both.segment<2>(2 * (16 * row + 7 - k)) = Eigen::Vector2d(-v[0], v[1]);
    }
  }
  const Eigen::MatrixXd strains[] = {strain(half, u), strain(whole, both)};
  const Eigen::MatrixXd stresses[] = {stress(half, u), stress(whole, both)};
  const Eigen::VectorXd energies[] = {energy_density(half, u), energy_density(whole, both)};
  for (Index row = 0; row < 7; ++row) {
    for (Index k = 0; k < 8; ++k) {
      const Index i = 8 * row + k;
      const Index j = 16 * row + 8 + k;
      EXPECT_LE((strains[0].col(i) - strains[1].col(j)).norm(), 1e-13 * strains[1].norm());
      EXPECT_LE((stresses[0].col(i) - stresses[1].col(j)).norm(), 1e-13 * stresses[1].norm());
      EXPECT_NEAR(energies[0][i], energies[1][j], 1e-13 * energies[1].maxCoeff());
    }
  }
}

TEST(Fields, HaveTheSameBitsForAnyNumberOfThreads) {
  Model m = box_model({20, 15}, 0.1, 3.0);
  add_wall(m, 0, false, WallType::odd);
  const auto body = build_body<2>(m);
  const Eigen::VectorXd u = random_displacement(2 * body.count(), 7);
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const Eigen::MatrixXd one[] = {strain(body, u), stress(body, u), energy_density(body, u), damage(body)};
  omp_set_num_threads(3);
  const Eigen::MatrixXd three[] = {strain(body, u), stress(body, u), energy_density(body, u), damage(body)};
  omp_set_num_threads(before);
  for (int k = 0; k < 4; ++k) EXPECT_EQ(one[k], three[k]);
}

}  // namespace
}  // namespace perimode
