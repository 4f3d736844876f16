// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/dispersion/zone.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "lattices.hpp"
#include "perimode/core/error.hpp"
#include "perimode/linalg/threads.hpp"
#include "support/models.hpp"
#include "support/relative.hpp"

namespace perimode {
namespace {

using std::numbers::pi;
using test::expect_relative;
using test::lattice_of;
using test::shells_of;

/// The survey point by point over the whole grid, with plane_waves.
template <int Dim>
void expect_survey(const Lattice<Dim>& lattice, int n) {
  const auto survey = survey_zone<Dim>(lattice, n);
  const double step = pi / (lattice.family.spacing * (n - 1));
  double least = std::numeric_limits<double>::infinity(), largest = 0.0, slowest = least;
  double squares[2] = {}, worst[2] = {};
  int count = 0;
  const int all = static_cast<int>(std::lround(std::pow(n, Dim)));
  for (int i = 1; i < all; ++i) {
    Point<Dim> k;
    for (int a = 0, rest = i; a < Dim; ++a, rest /= n) k[a] = step * (rest % n);
    const auto waves = plane_waves<Dim>(lattice, k, k.normalized());
    for (std::size_t b = 0; b < Dim; ++b) {
      least = std::min(least, waves.squared[b]);
      largest = std::max(largest, waves.squared[b]);
      slowest = std::min(slowest, waves.squared[b] / k.squaredNorm());
      const double speed = classical_speed(lattice.medium, b == 0 ? Branch::pressure : Branch::shear);
      const double omega = std::isnan(waves.angular_frequency[b]) ? 0.0 : waves.angular_frequency[b];
      const double error = omega / (speed * k.norm()) - 1.0;
      squares[b == 0 ? 0 : 1] += error * error;
      worst[b == 0 ? 0 : 1] = std::max(worst[b == 0 ? 0 : 1], std::abs(error));
    }
    ++count;
  }
  EXPECT_EQ(survey.points_per_axis, n);
  EXPECT_NEAR(survey.least_squared, least, 1e-13 * largest);
  EXPECT_NEAR(plane_waves<Dim>(lattice, survey.least_at, survey.least_at.normalized()).squared[Dim - 1 > 0],
              least, 1e-13 * largest);
  EXPECT_LE(survey.least_speed_squared, slowest + 1e-12 * std::abs(slowest));
  EXPECT_GE(survey.omega_max, std::sqrt(largest) * (1.0 - 1e-14));
  expect_relative(survey.phase_error[0], std::sqrt(squares[0] / count), 1e-10);
  expect_relative(survey.worst_phase_error[0], worst[0], 1e-10);
  if (Dim > 1) {
    expect_relative(survey.phase_error[1], std::sqrt(squares[1] / (count * (Dim - 1))), 1e-10);
    expect_relative(survey.worst_phase_error[1], worst[1], 1e-10);
  }
  EXPECT_EQ(survey.stable_step, 2.0 / survey.omega_max);
  // The top is an eigenvalue at its place.
  const auto top = lattice_symbol<Dim>(lattice.family, lattice.rates, survey.omega_max_at);
  const double value =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, Dim, Dim>>(top).eigenvalues()[Dim - 1];
  expect_relative(std::sqrt(value), survey.omega_max, 1e-13);
}

TEST(SurveyZone, IsThatOfEveryPointOfTheZone) {
  expect_survey<1>(lattice_of<1>({Kernel::constant}, 0.2, 5.0), 40);
  expect_survey<2>(lattice_of<2>({Kernel::gaussian, 2.0}, 0.5, 3.0, VolumeCorrection::linear), 14);
  expect_survey<2>(lattice_of<2>(shells_of<2>(3.0, {9.1, 2.3, -2.9, 1.4, 0.9, -0.2}), 1.0, 3.0), 17);
  expect_survey<3>(lattice_of<3>({Kernel::conical}, 0.3, 2.5), 9);
}

TEST(SurveyZone, OfAFinerGridNeverContradicts) {
  for (const double ratio : {2.0, 3.0}) {
    const auto lattice = lattice_of<2>({Kernel::constant}, 1.0, ratio);
    const auto coarse = survey_zone<2>(lattice, 17), fine = survey_zone<2>(lattice, 257);
    // The grid of 257 holds that of 17: its refined maximum cannot be lower, and both are the same hill.
    expect_relative(coarse.omega_max, fine.omega_max, 1e-12);
    EXPECT_LE(fine.least_squared, coarse.least_squared);
    EXPECT_GE(fine.worst_phase_error[0], coarse.worst_phase_error[0] * (1.0 - 1e-12));
    EXPECT_GE(coarse.omega_max_at.minCoeff(), 0.0);
    EXPECT_LE(coarse.omega_max_at.maxCoeff(), pi * (1.0 + 1e-12));
    const auto cube = lattice_of<3>({Kernel::constant}, 1.0, ratio);
    expect_relative(survey_zone<3>(cube, 9).omega_max, survey_zone<3>(cube, 33).omega_max, 1e-12);
  }
}

TEST(SurveyZone, IsTheSameForAnyNumberOfThreads) {
  const auto lattice = lattice_of<3>({Kernel::constant}, 1.0, 2.0);
  const int before = threads();
  set_threads(1);
  const auto one = survey_zone<3>(lattice, 20);
  set_threads(3);
  const auto three = survey_zone<3>(lattice, 20);
  set_threads(before);
  EXPECT_EQ(one.phase_error, three.phase_error);
  EXPECT_EQ(one.omega_max, three.omega_max);
  EXPECT_EQ(one.least_squared, three.least_squared);
  EXPECT_EQ(one.omega_max_at, three.omega_max_at);
}

// 1D, m = 1: omega^2 = 4 (1 - cos k) alpha with alpha 1/2 for speed 1: largest 2 at pi, known to the last
// bit.
TEST(SurveyZone, OfASpringChain) {
  const auto chain = lattice_of<1>(shells_of<1>(1.0, {0.5}), 1.0, 1.0);
  const auto survey = survey_zone<1>(chain, 33);
  expect_relative(survey.omega_max, 2.0, 1e-15);
  expect_relative(survey.omega_max_at[0], pi, 1e-15);
  expect_relative(survey.stable_step, 1.0, 1e-15);
  expect_relative(survey.worst_phase_error[0], 1.0 - 2.0 / pi, 1e-14);
  expect_relative(survey.least_speed_squared, 4.0 / (pi * pi), 1e-14);
}

TEST(SurveyZone, TellsAnUnstableLattice) {
  const auto bar = lattice_of<1>(shells_of<1>(2.0, {1.0, -4.0}), 1.0, 2.0);
  const auto survey = survey_zone<1>(bar, 65);  // omega^2 = (1 - cos k) - 2 (1 - cos 2k)
  EXPECT_LT(survey.least_squared, -3.0);
  EXPECT_LT(survey.least_speed_squared, -3.0 + 1e-12);  // long waves: (1 - 8)/2
  expect_relative(survey.least_speed_squared, 0.5 * (1.0 - 8.0), 1e-12);
  expect_relative(survey.omega_max, std::sqrt(2.0), 1e-13);
}

// Plane strain, nu = 1/4, m = 3, in sqrt(E/rho)/spacing: the constant kernel and the least-squares optimum of
// [alebrahim2021] eq. (45) with the long-wave speeds exact.
TEST(SurveyZone, StabilityLimitsOfPlanes) {
  const auto original = lattice_of<2>({Kernel::constant}, 1.0, 3.0);
  const auto survey = survey_zone<2>(original, 65);
  EXPECT_NEAR(survey.omega_max, 1.10808, 5e-6);  // digits given
  // Its top is a P wave along the axis, where a search along the line finds it too.
  EXPECT_LT(survey.omega_max_at.minCoeff(), 1e-7);
  const auto axis = branch_band<2>(original, Branch::pressure, Point<2>(1.0, 0.0), pi, 0.05);
  expect_relative(survey.omega_max, axis.cut_off, 1e-13);

  const auto optimal =
      survey_zone<2>(lattice_of<2>(shells_of<2>(3.0, {27.1405315903, 6.5826657897, -19.7723191273,
                                                      -0.4557006259, -0.3310746313, 6.7354513300}),
                                   1.0, 3.0),
                     65);
  EXPECT_NEAR(optimal.omega_max, 3.92, 5e-3);
  EXPECT_NEAR(optimal.least_speed_squared, 0.20, 5e-3);
  EXPECT_GT(optimal.least_squared, 0.0);
}

TEST(SurveyZone, RefusesASinglePoint) {
  EXPECT_THROW((void)survey_zone<1>(lattice_of<1>({Kernel::constant}, 1.0, 1.0), 1), Error);
}

TEST(MakeLattice, HasTheRatesOfTheModel) {
  Model m = test::box_model({4, 5}, 0.25, 2.0);
  m.thickness = 0.3;
  m.material.density = 3.0;
  m.volume_correction = VolumeCorrection::linear;
  m.calibration = Calibration::discrete_cut;
  const auto lattice = make_lattice<2>(m);
  EXPECT_EQ(lattice.family.spacing, 0.25);
  EXPECT_EQ(lattice.medium.horizon, 0.5);
  EXPECT_EQ(lattice.medium.continuum.section, 0.3);
  const auto family = make_family<2>(0.25, 0.5, VolumeCorrection::linear);
  EXPECT_EQ(lattice.rates, bond_rates<2>(lattice.medium, family, Calibration::discrete));
  m.horizon = {HorizonSpec::Rule::length, 0.8, {}};
  EXPECT_EQ(make_lattice<2>(m).medium.horizon, 0.8);
}

TEST(MakeLattice, RefusesWhatIsNoLatticeAtItsPlace) {
  const auto line_of = [](const Model& model) {
    try {
      (void)make_lattice<1>(model);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
      return error.where().line;
    }
    return -1;
  };
  Model good = test::box_model({8}, 0.5, 2.0);
  good.where = {"case", 1, 0};
  std::get<GridSpec>(good.particles).where = {"case", 2, 0};
  good.horizon.where = {"case", 3, 0};
  good.material.where = {"case", 4, 0};
  EXPECT_EQ(line_of(good), -1);
  EXPECT_THROW((void)make_lattice<2>(good), Error);

  Model m = good;
  m.particles = CloudSpec{"cloud.csv", {"case", 5, 0}};
  EXPECT_EQ(line_of(m), 5);
  m = good;
  m.area = 0.0;
  EXPECT_EQ(line_of(m), 1);
  m = good;
  std::get<GridSpec>(m.particles).spacing = 0.3;  // 4 m are no whole number of cells
  EXPECT_EQ(line_of(m), 2);
  for (const HorizonSpec& bad : {HorizonSpec{HorizonSpec::Rule::ratio, -1.0, good.horizon.where},
                                 HorizonSpec{HorizonSpec::Rule::ratio, 0.5, good.horizon.where},
                                 HorizonSpec{HorizonSpec::Rule::neighbours, 4.0, good.horizon.where}}) {
    m = good;
    m.horizon = bad;
    EXPECT_EQ(line_of(m), 3);
  }
  m = good;
  m.material.density = 0.0;
  EXPECT_EQ(line_of(m), 4);
  m = good;
  m.material.micromodulus = shells_of<1>(3.0, {1.0, 1.0, 1.0});  // of another horizon
  EXPECT_EQ(line_of(m), 4);
  m.material.micromodulus = shells_of<1>(2.0, {1.0, 1.0});
  EXPECT_EQ(line_of(m), -1);
  m.calibration = Calibration::discrete;
  EXPECT_EQ(line_of(m), 4);
  m.calibration = Calibration::continuum;
  m.volume_correction = VolumeCorrection::linear;
  EXPECT_EQ(line_of(m), 4);
}

}  // namespace
}  // namespace perimode
