// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/dispersion/cloud_waves.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <string>

#include "perimode/assembly/assemble.hpp"
#include "perimode/dispersion/symbol.hpp"
#include "support/models.hpp"
#include "unit/io/temporary_folder.hpp"

namespace perimode {
namespace {

using std::numbers::pi;
using test::box_model;

/// The particles of a grid as a periodic cloud, in another order and moved by up to `jitter` spacings along
/// every axis; a third of them belong to block "one".
template <int Dim>
Model cloud_of(const Model& grid, double jitter, const test::TemporaryFolder& folder, bool blocks = false) {
  const auto& box = std::get<GridSpec>(grid.particles);
  Model whole = grid;
  whole.periodic = {};
  const auto body = build_body<Dim>(whole);
  std::mt19937 gen(17);
  std::vector<Index> order(static_cast<std::size_t>(body.count()));
  for (Index i = 0; i < body.count(); ++i) order[static_cast<std::size_t>(i)] = i;
  for (std::size_t i = order.size() - 1; i > 0; --i) std::swap(order[i], order[gen() % (i + 1)]);
  std::string text = Dim == 1 ? "x" : Dim == 2 ? "x,y" : "x,y,z";
  text += ",volume,block\n";
  for (const Index i : order) {
    for (int a = 0; a < Dim; ++a) {
      const double by = 2.0 * static_cast<double>(gen()) / 4294967296.0 - 1.0;
      text += fmt::format(
          "{},", body.particles.position[static_cast<std::size_t>(i)][a] + jitter * by * box.spacing);
    }
    text += fmt::format("{},{}\n", body.particles.volume[static_cast<std::size_t>(i)],
                        blocks && i % 3 == 0 ? "one" : "");
  }
  Model cloud = grid;
  CloudSpec spec{folder.write("cloud.csv", text), {}, {}};
  for (int a = 0; a < Dim; ++a) {
    const auto axis = static_cast<std::size_t>(a);
    spec.period.push_back(box.upper[axis] - box.lower[axis]);
    cloud.periodic[axis] = true;
  }
  cloud.particles = spec;
  cloud.horizon = {HorizonSpec::Rule::length, grid.horizon.value * box.spacing, {}};
  return cloud;
}

template <int Dim>
Point<Dim> slanted() {
  Point<Dim> e;
  for (int a = 0; a < Dim; ++a) e[a] = 1.0 - 0.6 * a;
  return e.normalized();
}

template <int Dim>
CloudWaves<Dim> one_wave(const Body<Dim>& body, const Point<Dim>& k) {
  const std::vector<Point<Dim>> list = {k};
  return cloud_waves<Dim>(body, list, slanted<Dim>()).at(0);
}

template <int Dim>
void expect_symbol_of_the_lattice(const std::vector<int>& cells) {
  const test::TemporaryFolder folder;
  Model m = box_model(cells, 0.1, 2.0);
  m.thickness = m.area = 0.3;
  m.material.micromodulus.kernel = Kernel::conical;
  m.volume_correction = VolumeCorrection::linear;
  m.calibration = Calibration::discrete;
  const auto body = build_body<Dim>(cloud_of<Dim>(m, 0.0, folder));
  const Medium medium{m.material, {Dim, m.plane, body.section}, 0.2};
  const auto family = make_family<Dim>(0.1, 0.2, VolumeCorrection::linear);
  const auto rates = bond_rates<Dim>(medium, family, Calibration::discrete);
  for (const double size : {0.3, 7.0, 31.0}) {  // waves need not fit the period
    const Point<Dim> k = size * slanted<Dim>();
    const CloudWaves<Dim> wave = one_wave<Dim>(body, k);
    const Eigen::Matrix<double, Dim, Dim> symbol = lattice_symbol<Dim>(family, rates, k);
    const double scale = symbol.norm();
    for (int b = 0; b < Dim; ++b) {
      const auto branch = static_cast<std::size_t>(b);
      const Point<Dim> a = wave.waves.polarisation.col(b);
      EXPECT_LT((symbol * a - wave.waves.squared[branch] * a).norm(), 1e-12 * scale);
      // Both are square roots of sums of squares of round-off.
      EXPECT_LT(wave.spread[branch] * wave.waves.angular_frequency[branch], 1e-12 * scale);
      double bonds = 0.0;  // what odd sums, which cancel, are measured by
      for (const double rate : rates) bonds += rate;
      EXPECT_LT(wave.residual[branch], 1e-12 * bonds);
      EXPECT_DOUBLE_EQ(wave.waves.phase_velocity[branch], wave.waves.angular_frequency[branch] / size);
    }
    const Point<Dim> along = (wave.waves.polarisation.transpose() * k).cwiseAbs();
    EXPECT_EQ(along[0], along.maxCoeff());
    for (std::size_t b = 2; b < static_cast<std::size_t>(Dim); ++b)
      EXPECT_LE(wave.waves.squared[b - 1], wave.waves.squared[b]);
  }
}

TEST(CloudWaves, OfALatticeAreExact) {
  expect_symbol_of_the_lattice<1>({12});
  expect_symbol_of_the_lattice<2>({7, 8});
  expect_symbol_of_the_lattice<3>({6, 7, 6});
}

/// A cloud with everything that makes it uneven.
template <int Dim>
Model uneven(const test::TemporaryFolder& folder) {
  Model m = box_model(Dim == 1   ? std::vector{30}
                      : Dim == 2 ? std::vector{11, 9}
                                 : std::vector{5, 6, 5},
                      0.1, Dim == 3 ? 1.8 : 2.6);
  m.calibration = Calibration::discrete;
  Model cloud = cloud_of<Dim>(m, 0.25, folder, true);
  cloud.block_materials["one"] = cloud.material;
  cloud.block_materials["one"].youngs_modulus = 3.0;
  cloud.block_materials["one"].density = 0.7;
  if constexpr (Dim == 2) test::add_crack(cloud, {{0.9, 0.31}, {1.3, 0.42}});
  return cloud;
}

/// u^H K u, the parts of it and the residual from the assembled stiffness of the period.
template <int Dim>
void expect_quotients_of_the_matrix() {
  const test::TemporaryFolder folder;
  const auto body = build_body<Dim>(uneven<Dim>(folder));
  const BlockCsr matrix = assemble_stiffness(body);
  const Eigen::VectorXd mass = lumped_mass(body);
  const auto product = [&](const Eigen::VectorXd& u) {
    Eigen::VectorXd f(u.size());
    multiply(matrix, {u.data(), static_cast<std::size_t>(u.size())},
             {f.data(), static_cast<std::size_t>(f.size())});
    return f;
  };
  Eigen::MatrixXd dense(mass.size(), mass.size());
  for (Eigen::Index d = 0; d < mass.size(); ++d)
    dense.col(d) = product(Eigen::VectorXd::Unit(mass.size(), d));
  const double stiff = dense.diagonal().maxCoeff();
  EXPECT_LT((dense - dense.transpose()).cwiseAbs().maxCoeff(), 1e-15 * stiff);
  for (int a = 0; a < Dim; ++a) {  // translations store nothing
    Eigen::VectorXd t = Eigen::VectorXd::Zero(mass.size());
    for (Eigen::Index d = a; d < t.size(); d += Dim) t[d] = 1.0;
    EXPECT_LT(product(t).cwiseAbs().maxCoeff(), 1e-14 * stiff);
  }
  const Eigen::VectorXd root = mass.cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(root.asDiagonal() * dense * root.asDiagonal(),
                                                             Eigen::EigenvaluesOnly);
  const Point<Dim>& period = std::get<CloudBonds<Dim>>(body.bonds).period;
  for (const int q : {1, 2, 5}) {
    Point<Dim> k;
    for (int a = 0; a < Dim; ++a) k[a] = 2.0 * pi * (a == 0 ? q : 1 - a) / period[a];
    const CloudWaves<Dim> wave = one_wave<Dim>(body, k);
    for (int b = 0; b < Dim; ++b) {
      const auto branch = static_cast<std::size_t>(b);
      const Point<Dim> a = wave.waves.polarisation.col(b);
      const double square = wave.waves.squared[branch];
      // Real and imaginary part of the wave.
      const Eigen::VectorXd u = plane_wave<Dim>(body.particles.position, k, a, 0.0);
      const Eigen::VectorXd v = plane_wave<Dim>(body.particles.position, k, a, -0.5 * pi);
      const Eigen::VectorXd ku = product(u), kv = product(v);
      EXPECT_NEAR((u.dot(ku) + v.dot(kv)) / (u.dot(mass.cwiseProduct(u)) + v.dot(mass.cwiseProduct(v))),
                  square, 1e-12 * square);
      double total = 0.0, local = 0.0, whole = 0.0;
      for (Index i = 0; i < body.count(); ++i) {
        const double m = mass[i * Dim];
        const auto at = [&](const Eigen::VectorXd& x) { return Point<Dim>(x.segment<Dim>(i * Dim)); };
        const double own = (at(u).dot(at(ku)) + at(v).dot(at(kv))) / m - square;  // |u_i|^2 + |v_i|^2 = 1
        total += m;
        local += m * own * own;
        whole +=
            m * ((at(ku) / m - square * at(u)).squaredNorm() + (at(kv) / m - square * at(v)).squaredNorm());
      }
      const double omega = wave.waves.angular_frequency[branch];
      EXPECT_NEAR(wave.spread[branch], std::sqrt(local / total) / (2.0 * omega), 1e-11 * wave.spread[branch]);
      EXPECT_NEAR(wave.residual[branch], std::sqrt(whole / total), 1e-11 * wave.residual[branch]);
      EXPECT_GT(wave.residual[branch], 2.0 * omega * wave.spread[branch]);  // it is a part of it
      EXPECT_LE((modes.eigenvalues().array() - square).abs().minCoeff(), wave.residual[branch]);
    }
  }
}

TEST(CloudWaves, AreTheQuotientsOfTheAssembledStiffness) {
  expect_quotients_of_the_matrix<1>();
  expect_quotients_of_the_matrix<2>();
  expect_quotients_of_the_matrix<3>();
}

template <int Dim>
void expect_slopes() {
  const test::TemporaryFolder folder;
  const auto body = build_body<Dim>(uneven<Dim>(folder));
  const Point<Dim> k = 6.0 * slanted<Dim>();
  const PlaneWaves<Dim> waves = one_wave<Dim>(body, k).waves;
  const double h = 1e-4;
  for (int c = 0; c < Dim; ++c) {
    const auto above = one_wave<Dim>(body, k + h * Point<Dim>::Unit(c)).waves;
    const auto below = one_wave<Dim>(body, k - h * Point<Dim>::Unit(c)).waves;
    for (std::size_t b = 0; b < static_cast<std::size_t>(Dim); ++b) {
      const double slope = (above.angular_frequency[b] - below.angular_frequency[b]) / (2.0 * h);
      // Truncation h^2, round-off 1e-15/h.
      EXPECT_NEAR(waves.group_velocity[b][c], slope, 1e-7 * waves.phase_velocity[0]);
    }
  }
}

TEST(CloudWaves, GroupVelocityIsTheSlopeOfTheFrequency) {
  expect_slopes<1>();
  expect_slopes<2>();
  expect_slopes<3>();
}

TEST(CloudWaves, AtZeroHaveTheLimitsAlongTheDirection) {
  const test::TemporaryFolder folder;
  const auto body = build_body<2>(uneven<2>(folder));
  const CloudWaves<2> limit = one_wave<2>(body, Point<2>::Zero());
  const CloudWaves<2> longest = one_wave<2>(body, 1e-3 * slanted<2>());
  for (std::size_t b = 0; b < 2; ++b) {
    EXPECT_EQ(limit.waves.angular_frequency[b], 0.0);
    EXPECT_EQ(limit.spread[b], 0.0);
    // The next term is (k reach)^2 = 1e-7.
    EXPECT_NEAR(limit.waves.phase_velocity[b], longest.waves.phase_velocity[b], 1e-7);
    EXPECT_LT((limit.waves.group_velocity[b] - longest.waves.group_velocity[b]).norm(), 1e-6);
    EXPECT_NEAR(std::abs(limit.waves.polarisation.col(static_cast<Eigen::Index>(b))
                             .dot(longest.waves.polarisation.col(static_cast<Eigen::Index>(b)))),
                1.0, 1e-6);
  }
}

// No bond enters or leaves a horizon between two shells, and all bonds of a particle of a lattice pull
// evenly: the first order of the mean cancels, that of the spread does not.
TEST(CloudWaves, SpreadIsOfFirstOrderInTheDisorderAndTheMeanOfSecond) {
  const test::TemporaryFolder folder;
  const Model grid = box_model({16, 16}, 0.1, 2.5);
  const Point<2> k(9.0, 4.0);
  const auto at = [&](double jitter) {
    return one_wave<2>(build_body<2>(cloud_of<2>(grid, jitter, folder)), k);
  };
  const CloudWaves<2> lattice = at(0.0), little = at(0.01), more = at(0.02);
  for (std::size_t b = 0; b < 2; ++b) {
    EXPECT_GT(little.spread[b], 1e-4 * lattice.waves.angular_frequency[b]);
    EXPECT_NEAR(more.spread[b] / little.spread[b], 2.0, 0.05);
    EXPECT_NEAR(more.residual[b] / little.residual[b], 2.0, 0.05);
    const double first = little.waves.squared[b] - lattice.waves.squared[b];
    const double second = more.waves.squared[b] - lattice.waves.squared[b];
    EXPECT_NEAR(second / first, 4.0, 0.2);
    EXPECT_LT(std::abs(second), 0.01 * lattice.waves.squared[b]);
  }
}

/// The lowest squared frequencies of the modes exp(i k.x) times a function with the cloud's period.
template <int Dim>
Eigen::VectorXd bloch_levels(const Body<Dim>& body, const Point<Dim>& k) {
  const Eigen::Index n = body.count();
  Eigen::MatrixXcd h = Eigen::MatrixXcd::Zero(n * Dim, n * Dim);
  const auto mass = [&](Index i) {
    const auto p = static_cast<std::size_t>(i);
    return body.density[static_cast<std::size_t>(body.particles.block[p])] * body.particles.volume[p];
  };
  for (Index i = 0; i < n; ++i) {
    for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
      const Point<Dim> e = end.xi / end.length;
      const Eigen::MatrixXcd block = (bond_stiffness(body, i, end) * e * e.transpose()).eval();
      const Index j = end.neighbour;
      h.block(i * Dim, i * Dim, Dim, Dim) += block / mass(i);
      h.block(i * Dim, j * Dim, Dim, Dim) -=
          std::polar(1.0, k.dot(end.xi)) / std::sqrt(mass(i) * mass(j)) * block;
    });
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>(h, Eigen::EigenvaluesOnly).eigenvalues().head(Dim);
}

TEST(CloudWaves, BoundTheAcousticModesOfLongWavesFromAbove) {
  const test::TemporaryFolder folder;
  const auto body = build_body<2>(uneven<2>(folder));
  const Point<2> k(2.0, 1.0);  // period 1.1 and 0.9
  const Eigen::VectorXd levels = bloch_levels<2>(body, k);
  auto squared = one_wave<2>(body, k).waves.squared;
  std::sort(squared.begin(), squared.end());
  for (std::size_t b = 0; b < 2; ++b) {
    const double level = levels[static_cast<Eigen::Index>(b)];
    EXPECT_GT(squared[b], level);
    EXPECT_LT(squared[b], 1.5 * level);  // blocks of stiffness 1 and 3 and a crack
  }
}

TEST(CloudWaves, WaveVectorsThatFitThePeriod) {
  const test::TemporaryFolder folder;
  const auto body = build_body<2>(cloud_of<2>(box_model({12, 8}, 0.1, 2.0), 0.1, folder));
  const auto along = period_wave_vectors<2>(body, Point<2>(0.0, -1.0), 4.0 * 2.0 * pi / 0.8 + 1e-9);
  ASSERT_EQ(along.size(), 4U);
  for (std::size_t q = 0; q < 4; ++q)
    EXPECT_LT((along[q] - Point<2>(0.0, -2.0 * pi * (q + 1.0) / 0.8)).norm(), 1e-12);
  const auto diagonal = period_wave_vectors<2>(body, Point<2>(1.0, 1.0).normalized(), 60.0);
  ASSERT_EQ(diagonal.size(), 2U);  // 3 waves along x, 2 along y, and twice as many
  EXPECT_LT((diagonal[0] - 2.0 * pi * Point<2>(3.0 / 1.2, 2.0 / 0.8)).norm(), 1e-12);
  EXPECT_LT((diagonal[1] - 2.0 * diagonal[0]).norm(), 1e-12);
}

template <class Call>
std::string complaint(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
    return error.what();
  }
  return "no error";
}

TEST(CloudWaves, BadInputIsRefused) {
  using testing::HasSubstr;
  const test::TemporaryFolder folder;
  Model grid = box_model({12, 8}, 0.1, 2.0);
  Model cloud = cloud_of<2>(grid, 0.1, folder);
  const auto good = build_body<2>(cloud);
  const std::vector<Point<2>> k = {Point<2>(1.0, 0.0)};
  EXPECT_THAT(complaint([&] { (void)cloud_waves<2>(good, k, Point<2>(1.0, 1.0)); }),
              HasSubstr("a direction of length 1"));
  EXPECT_THAT(complaint([&] { (void)period_wave_vectors<2>(good, Point<2>(0.6, 0.8), 1.0); }),
              HasSubstr("a whole number of waves"));
  EXPECT_THAT(complaint([&] { (void)period_wave_vectors<2>(good, Point<2>(1.0, 0.0), 1e300); }),
              HasSubstr("a longest wave vector"));
  cloud.periodic[1] = false;
  const auto strip = build_body<2>(cloud);
  EXPECT_THAT(complaint([&] { (void)cloud_waves<2>(strip, k, Point<2>(1.0, 0.0)); }),
              HasSubstr("no period along y"));
  grid.periodic = {true, true, false};
  const auto lattice = build_body<2>(grid);
  EXPECT_THAT(complaint([&] { (void)cloud_waves<2>(lattice, k, Point<2>(1.0, 0.0)); }), HasSubstr("a grid"));
}

}  // namespace
}  // namespace perimode
