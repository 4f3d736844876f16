// SPDX-License-Identifier: BSD-3-Clause
// Plane waves are eigenvectors of a periodic lattice, with the eigenvalue of its symbol.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>
#include <random>

#include "perimode/assembly/assemble.hpp"
#include "perimode/dispersion/symbol.hpp"
#include "support/models.hpp"

namespace perimode {
namespace {

using test::box_model;

template <int Dim>
void expect_plane_waves(std::mt19937& gen) {
  const auto pick = [&](int low, int high) { return low + static_cast<int>(gen() % (high - low + 1)); };
  const auto real = [&] { return static_cast<double>(gen()) / 4294967296.0; };
  std::vector<int> cells;
  for (int a = 0; a < Dim; ++a) cells.push_back(pick(1, Dim == 3 ? 6 : 9));
  cells[pick(0, Dim - 1)] += 4;
  const double spacing = 0.1 + real(), ratio = 1.0 + 2.0 * real();
  Model m = box_model(cells, spacing, ratio);
  m.periodic = {true, Dim > 1, Dim > 2};
  m.plane = pick(0, 1) == 0 ? Plane::stress : Plane::strain;
  m.thickness = m.area = 0.1 + real();
  m.material.youngs_modulus = 1.0 + real();
  m.material.density = 1.0 + real();
  m.material.micromodulus.kernel = static_cast<Kernel>(pick(0, 3));
  m.material.micromodulus.p = 1.0 + real();
  m.calibration = pick(0, 1) == 0 ? Calibration::continuum : Calibration::discrete;
  m.volume_correction = pick(0, 1) == 0 ? VolumeCorrection::none : VolumeCorrection::linear;
  const auto body = build_body<Dim>(m);
  const BlockCsr k_matrix = assemble_stiffness(body);
  const Eigen::VectorXd mass = lumped_mass(body);

  const double section = Dim == 1 ? m.area : Dim == 2 ? m.thickness : 1.0;
  const Medium medium{m.material, {Dim, m.plane, section}, ratio * spacing};
  const auto family = make_family<Dim>(spacing, ratio * spacing, m.volume_correction);
  const auto rates = bond_rates<Dim>(medium, family, m.calibration);
  for (int trial = 0; trial < 5; ++trial) {
    Point<Dim> k;
    for (int a = 0; a < Dim; ++a) k[a] = 2.0 * std::numbers::pi * pick(0, cells[a]) / (cells[a] * spacing);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, Dim, Dim>> symbol(
        lattice_symbol<Dim>(family, rates, k));
    const int branch = pick(0, Dim - 1);
    const Point<Dim> amplitude = symbol.eigenvectors().col(branch);
    const Eigen::VectorXd u = plane_wave<Dim>(body.particles.position, k, amplitude, 6.0 * real());
    Eigen::VectorXd force(u.size());
    multiply(k_matrix, {u.data(), static_cast<std::size_t>(u.size())},
             {force.data(), static_cast<std::size_t>(force.size())});
    const Eigen::VectorXd error = force - symbol.eigenvalues()[branch] * mass.cwiseProduct(u);
    double size = 0.0;  // sum of a row's terms: what round-off is measured by
    for (double rate : rates) size += rate;
    EXPECT_LE(error.cwiseAbs().maxCoeff(), 2e-13 * size * mass[0])
        << Dim << "D, ratio " << ratio << ", wave " << k.transpose();
  }
}

TEST(PlaneWaves, AreEigenvectorsOfRandomPeriodicBars) {
  std::mt19937 gen(11);
  for (int i = 0; i < 40; ++i) expect_plane_waves<1>(gen);
}

TEST(PlaneWaves, AreEigenvectorsOfRandomPeriodicPlates) {
  std::mt19937 gen(12);
  for (int i = 0; i < 40; ++i) expect_plane_waves<2>(gen);
}

TEST(PlaneWaves, AreEigenvectorsOfRandomPeriodicBlocks) {
  std::mt19937 gen(13);
  for (int i = 0; i < 20; ++i) expect_plane_waves<3>(gen);
}

/// Speed of long waves along x over the classical one, from the assembled K of a periodic column of
/// section 1 x 1: each row then is the chain of lattice planes, omega^2 / k^2 = sum_j (-K_0j) x_j^2 / (2 M).
double long_wave_factor(double square, Calibration calibration) {
  const double ratio = std::sqrt(square);
  const int reach = static_cast<int>(ratio + 1e-9), cells = 2 * reach + 1;
  Model m = box_model({cells, 1, 1}, 1.0, ratio);
  m.periodic = {true, true, true};
  m.material.micromodulus.kernel = Kernel::inverse_distance;
  m.calibration = calibration;
  const auto body = build_body<3>(m);
  const BlockCsr k = assemble_stiffness(body);
  double sum = 0.0;
  for (Offset e = k.row_start[reach]; e < k.row_start[reach + 1]; ++e) {
    const double x = k.column[e] - reach;
    sum -= k.value[9 * e] * x * x;
  }
  return std::sqrt(0.5 * sum / lumped_mass(body)[0] / 1.2);  // c_l^2 = 6 E / (5 rho)
}

// [ganzenmueller2013]: normalising the dilation energy does not make the speed along [100] exact.
TEST(PlaneWaves, LongWavesAlongAnAxisOfTheNormalisedLattice) {
  struct Row {
    double square, normalised, original;  // original 0: not tabulated
  };
  for (const Row& row :
       {Row{4, 1.03749163, 1.01384204}, Row{6, 1.01022550, 1.15161040}, Row{8, .99806576, .98331186},
        Row{9, .98322296, 1.02118808}, Row{16, .99918283, .97640648}, Row{25, .99581635, .98664632},
        Row{36, .99297657, 1.00346864}}) {
    EXPECT_NEAR(long_wave_factor(row.square, Calibration::discrete), row.normalised, 1e-8) << row.square;
    EXPECT_NEAR(long_wave_factor(row.square, Calibration::continuum), row.original, 1e-8) << row.square;
  }
}

/// Energy of pure dilation over the continuum's, minus one: what the discrete calibration divides by.
template <int Dim>
double energy_error(const std::vector<int>& cells, double ratio) {
  Model m = box_model(cells, 1.0, ratio);
  m.periodic = {true, true, true};
  m.plane = Plane::strain;
  m.material.micromodulus.kernel = Kernel::inverse_distance;
  m.calibration = Calibration::discrete;
  return 1.0 / build_body<Dim>(m).constants.factor[0] - 1.0;
}

// [ganzenmueller2013], original calibration: (number of neighbours) / (volume of the horizon) - 1. The bodies
// are thinner than the horizon, so most of the family are images of a few particles.
TEST(PlaneWaves, DilationEnergyOfTheOriginalCalibration) {
  const std::pair<double, double> space[] = {
      {3, .19454594}, {4, -.04507034}, {5, .19576107},   {6, .29949467},   {8, -.02934647},
      {9, .07871684}, {12, .02225566}, {16, -.04507034}, {25, -.01833231}, {36, .02124422}};
  for (const auto& [square, error] : space) {
    EXPECT_NEAR(energy_error<3>({2, 1, 3}, std::sqrt(square)), error, 6e-9) << square;
  }
  const std::pair<double, double> strain[] = {
      {2, -.04507034}, {3, -.00970258}, {4, -.04507034}, {5, .01859164}};
  for (const auto& [ratio, error] : strain) {
    EXPECT_NEAR(energy_error<2>({2, 3}, ratio), error, 6e-9) << ratio;
  }
}

}  // namespace
}  // namespace perimode
