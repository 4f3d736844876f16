// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/dispersion/symbol.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>
#include <vector>

#include "perimode/reference/separation.hpp"
#include "support/relative.hpp"

namespace perimode {
namespace {

using std::numbers::pi;
using test::expect_relative;

const std::vector<Micromodulus> kernels = {
    {Kernel::constant}, {Kernel::conical}, {Kernel::gaussian, 2.0}, {Kernel::inverse_distance}};

Medium medium_of(Micromodulus kernel, Continuum continuum, double horizon, double youngs = 1.0,
                 double density = 1.0) {
  return {{youngs, density, kernel, {}, {}, {}}, continuum, horizon};
}

template <int Dim>
Point<Dim> lattice_frequencies(const Medium& medium, const Family<Dim>& family, const Point<Dim>& k,
                               Calibration calibration = Calibration::continuum) {
  const std::vector<double> rates = bond_rates<Dim>(medium, family, calibration);
  const Eigen::Matrix<double, Dim, Dim> symbol = lattice_symbol<Dim>(family, rates, k);
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, Dim, Dim>>(symbol).eigenvalues().cwiseSqrt();
}

TEST(ClassicalSpeed, FollowsFromTheLameConstants) {
  const double youngs = 210e9, density = 7850.0;
  for (const Continuum& continuum : {Continuum{2, Plane::stress, 0.1}, Continuum{2, Plane::strain, 1.0},
                                     Continuum{3, Plane::stress, 1.0}}) {
    const Medium medium = medium_of({}, continuum, 1.0, youngs, density);
    const double nu = poissons_ratio(continuum), shear = youngs / (2.0 * (1.0 + nu));
    const bool plane_stress = continuum.dimension == 2 && continuum.plane == Plane::stress;
    const double pressure =
        plane_stress ? youngs / (1.0 - nu * nu) : youngs * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
    expect_relative(classical_speed(medium, Branch::pressure), std::sqrt(pressure / density), 1e-15);
    expect_relative(classical_speed(medium, Branch::shear), std::sqrt(shear / density), 1e-15);
  }
}

TEST(ClassicalSpeed, HasNoShearInABar) {
  const Medium bar = medium_of({}, {1, Plane::stress, 1.0}, 1.0, 4.0, 1.0);
  EXPECT_DOUBLE_EQ(classical_speed(bar, Branch::pressure), 2.0);
  EXPECT_THROW((void)classical_speed(bar, Branch::shear), Error);
  EXPECT_THROW((void)continuum_frequency(bar, Branch::shear, 1.0), Error);
}

TEST(ContinuumFrequency, LongWavesRunAtClassicalSpeeds) {
  for (const Continuum& continuum : {Continuum{2, Plane::stress, 0.1}, Continuum{2, Plane::strain, 1.0},
                                     Continuum{3, Plane::stress, 1.0}}) {
    for (const Micromodulus& kernel : kernels) {
      const Medium medium = medium_of(kernel, continuum, 0.5, 3.0, 7.0);
      for (const Branch branch : {Branch::pressure, Branch::shear}) {
        expect_relative(continuum_frequency(medium, branch, 1e-6), 1e-6 * classical_speed(medium, branch),
                        1e-12);
      }
    }
  }
}

TEST(ContinuumFrequency, OfABarIsTheScalarOne) {
  for (const Micromodulus& kernel : kernels) {
    const Medium bar = medium_of(kernel, {1, Plane::stress, 0.3}, 0.2, 5.0, 2.0);
    const double expected = std::sqrt(2.5 * continuum_lambda(kernel, 0.2, 1, 17.0));
    expect_relative(continuum_frequency(bar, Branch::pressure, 17.0), expected, 1e-14);
  }
}

// [scabbia2023]-type formulas of the plane with Bessel functions, composite Simpson in r.
TEST(ContinuumFrequency, InThePlaneMatchesTheBesselFormulas) {
  const double horizon = 0.3, thickness = 0.2, density = 3.0;
  for (const Micromodulus& kernel : kernels) {
    const Medium medium = medium_of(kernel, {2, Plane::strain, thickness}, horizon, 1.0, density);
    const double c0 = micromodulus_constant(kernel, 1.0, horizon, medium.continuum);
    for (const double k : {4.0, 60.0}) {
      double pressure = 0.0, shear = 0.0;
      constexpr int intervals = 4000;
      for (int i = 1; i <= intervals; ++i) {  // the integrands vanish at r = 0
        const double r = horizon * i / intervals, z = k * r;
        const double simpson =
            (i == intervals ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0)) * horizon / (3.0 * intervals);
        const double j0 = std::cyl_bessel_j(0.0, z), j1 = std::cyl_bessel_j(1.0, z);
        const double c = micromodulus(kernel, c0, r, horizon);
        pressure += simpson * c * (0.5 - j0 + j1 / z);
        shear += simpson * c * (0.5 - j1 / z);
      }
      const double scale = 2.0 * pi * thickness / density;
      // Rounding of 1/2 - J0 + J1/z at small z limits the Simpson side.
      expect_relative(continuum_frequency(medium, Branch::pressure, k), std::sqrt(scale * pressure), 1e-10);
      expect_relative(continuum_frequency(medium, Branch::shear, k), std::sqrt(scale * shear), 1e-10);
    }
  }
}

// P: 2 pi int r c (2/3 - A), A = int mu^2 cos(z mu); S: pi int r c [(2 - B) - (2/3 - A)], B = 2 sin z/z.
TEST(ContinuumFrequency, InSpaceMatchesTheClosedAngularIntegrals) {
  const double horizon = 0.3;
  for (const Micromodulus& kernel : kernels) {
    const Medium medium = medium_of(kernel, {3, Plane::stress, 1.0}, horizon);
    const double c0 = micromodulus_constant(kernel, 1.0, horizon, medium.continuum);
    for (const double k : {15.0, 90.0}) {
      double pressure = 0.0, shear = 0.0;
      constexpr int intervals = 4000;
      for (int i = 1; i <= intervals; ++i) {
        const double r = horizon * i / intervals, z = k * r;
        const double simpson =
            (i == intervals ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0)) * horizon / (3.0 * intervals);
        const double a =
            2.0 * (std::sin(z) / z + 2.0 * std::cos(z) / (z * z) - 2.0 * std::sin(z) / (z * z * z));
        const double b = 2.0 * std::sin(z) / z;
        const double rc = simpson * r * micromodulus(kernel, c0, r, horizon);
        pressure += 2.0 * pi * rc * (2.0 / 3.0 - a);
        shear += pi * rc * ((2.0 - b) - (2.0 / 3.0 - a));
      }
      expect_relative(continuum_frequency(medium, Branch::pressure, k), std::sqrt(pressure), 1e-9);
      expect_relative(continuum_frequency(medium, Branch::shear, k), std::sqrt(shear), 1e-9);
    }
  }
}

TEST(LatticeSymbol, TendsToTheContinuumWithTheRatio) {
  const Medium medium = medium_of({Kernel::conical}, {2, Plane::stress, 1.0}, 1.0);
  const Point<2> k(1.3, 0.4);
  double previous = 1.0;
  for (const int m : {8, 32, 128}) {
    const Point<2> omega =
        lattice_frequencies<2>(medium, make_family<2>(1.0 / m, 1.0, VolumeCorrection::none), k);
    const double error = std::abs(omega[0] / continuum_frequency(medium, Branch::shear, k.norm()) - 1.0) +
                         std::abs(omega[1] / continuum_frequency(medium, Branch::pressure, k.norm()) - 1.0);
    EXPECT_LT(error, 0.25 * previous);
    previous = error;
  }
  EXPECT_LT(previous, 1e-4);
}

TEST(LatticeSymbol, OfABarIsTheScalarEigenvalue) {
  const Family<1> family = make_family<1>(0.01, 0.05, VolumeCorrection::linear);
  const Medium bar = medium_of({Kernel::gaussian, 1.5}, {1, Plane::stress, 0.3}, 0.05, 7.0, 2.0);
  const Point<1> k(33.0);
  expect_relative(lattice_frequencies<1>(bar, family, k)[0],
                  std::sqrt(3.5 * lattice_lambda<1>({Kernel::gaussian, 1.5}, family, k)), 1e-14);
}

TEST(LatticeSymbol, VanishesAtZeroAndIsPeriodicInTheZone) {
  const Family<3> family = make_family<3>(0.5, 1.0, VolumeCorrection::linear);
  const Medium medium = medium_of({Kernel::constant}, {3, Plane::stress, 1.0}, 1.0);
  const std::vector<double> rates = bond_rates<3>(medium, family);
  EXPECT_EQ(lattice_symbol<3>(family, rates, Point<3>::Zero()).norm(), 0.0);
  const Point<3> k(0.3, -1.1, 2.0), shifted = k + 2.0 * pi / 0.5 * Point<3>(1.0, -1.0, 2.0);
  const Eigen::Matrix3d symbol = lattice_symbol<3>(family, rates, k);
  EXPECT_LT((lattice_symbol<3>(family, rates, shifted) - symbol).norm(), 1e-13 * symbol.norm());
}

TEST(LatticeSymbol, PlaneWavesAreEigenvectorsOfAPeriodicLattice) {
  constexpr int n = 5;
  const double spacing = 0.2;
  const Family<2> family = make_family<2>(spacing, 2.0 * spacing, VolumeCorrection::linear);
  const Medium medium = medium_of({Kernel::gaussian, 2.0}, {2, Plane::stress, 1.0}, 2.0 * spacing);
  const std::vector<double> rates = bond_rates<2>(medium, family);
  std::vector<Point<2>> positions;
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) positions.emplace_back(spacing * x, spacing * y);
  }
  const Point<2> k = 2.0 * pi / (n * spacing) * Point<2>(2.0, -1.0);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(lattice_symbol<2>(family, rates, k));
  const Eigen::VectorXd u = plane_wave<2>(positions, k, solver.eigenvectors().col(1), 0.4);
  double error = 0.0;
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      const Eigen::Vector2d ui = u.segment<2>(2 * (n * y + x));
      Eigen::Vector2d force = Eigen::Vector2d::Zero();
      for (std::size_t j = 0; j < family.offset.size(); ++j) {
        const auto& o = family.offset[j];
        const Eigen::Vector2d direction = Eigen::Vector2d(o[0], o[1]).normalized();
        const Eigen::Vector2d uj = u.segment<2>(2 * (n * ((y + o[1] + n) % n) + (x + o[0] + n) % n));
        force += rates[j] * direction * direction.dot(ui - uj);
      }
      error = std::max(error, (force - solver.eigenvalues()[1] * ui).norm());
    }
  }
  EXPECT_LT(error, 1e-13 * solver.eigenvalues()[1]);
}

// Plane stress, E = rho = 1, 1 x 0.5 with 32 x 16 cells, m = 3, mirror or antimirror walls, wave (1,1).
TEST(LatticeSymbol, VectorPlateFrequencies) {
  struct Row {
    Micromodulus kernel;
    double lattice[2], continuum[2];
  };
  const double spacing = 1.0 / 32.0, horizon = 3.0 * spacing;
  const Family<2> family = make_family<2>(spacing, horizon, VolumeCorrection::linear);
  for (const Row& row :
       {Row{{Kernel::constant}, {4.3403612835, 7.4406788624}, {4.2785676741, 7.3839189200}},
        Row{{Kernel::gaussian, 2.0}, {4.2562018334, 7.2335196688}, {4.2889487858, 7.4138637947}}}) {
    const Medium medium = medium_of(row.kernel, {2, Plane::stress, 1.0}, horizon);
    const Point<2> k(pi, 2.0 * pi);
    const Point<2> omega = lattice_frequencies<2>(medium, family, k);
    for (int i = 0; i < 2; ++i) {
      expect_relative(omega[i], row.lattice[i], 1e-10);  // digits given
      const Branch branch = i == 0 ? Branch::shear : Branch::pressure;
      expect_relative(continuum_frequency(medium, branch, k.norm()), row.continuum[i], 1e-10);
    }
  }
}

// Elastic constants of the corrected families in plane stress, relative to C11 = 9E/8 and C12 = C66 = 3E/8.
TEST(LatticeSymbol, StaticConstantsOfPlaneFamilies) {
  struct Row {
    Micromodulus kernel;
    int m;
    double c11, c12, tolerance;
  };
  for (const Row& row : {Row{{Kernel::constant}, 3, 3.27e-2, -1.75e-2, 6e-5},
                         Row{{Kernel::constant}, 5, 1.76e-2, 1.21e-2, 6e-5},
                         Row{{Kernel::constant}, 10, 0.44e-2, 0.32e-2, 6e-5},
                         Row{{Kernel::gaussian, 2.0}, 3, -0.37e-2, -14.8e-2, 6e-4},
                         Row{{Kernel::gaussian, 2.0}, 5, -0.05e-2, -3.3e-2, 6e-4},
                         Row{{Kernel::gaussian, 2.0}, 10, -0.04e-2, -0.46e-2, 6e-5}}) {
    const Medium medium = medium_of(row.kernel, {2, Plane::stress, 1.0}, 1.0);
    const Family<2> family = make_family<2>(1.0 / row.m, 1.0, VolumeCorrection::linear);
    const Point<2> omega = lattice_frequencies<2>(medium, family, Point<2>(1e-5, 0.0)) / 1e-5;
    EXPECT_NEAR(omega[1] * omega[1] / 1.125 - 1.0, row.c11, 6e-5);
    EXPECT_NEAR(omega[0] * omega[0] / 0.375 - 1.0, row.c12, row.tolerance);
  }
}

// [alebrahim2021] eqs. (21)-(28): nu = 1/4 (plane strain), constant kernel, no correction; speeds along the
// axis and the diagonal relative to the classical ones.
TEST(LatticeSymbol, LongWaveSpeedsOfUncorrectedPlaneFamilies) {
  struct Row {
    int m, bonds;
    double p0, p45, s0, s45;
  };
  for (const Row& row : {Row{2, 12, 1.0862820709, 0.9631318639, 0.8217282015, 1.1968268412},
                         Row{3, 28, 1.0260450663, 1.0143700404, 1.0025590655, 1.0375887321},
                         Row{4, 48, 0.9870783572, 0.9749268397, 0.9626219416, 0.9990820905},
                         Row{10, 316, 1.0009409980, 1.0129031516, 1.0247256744, 0.9888341461}}) {
    const Medium medium = medium_of({Kernel::constant}, {2, Plane::strain, 1.0}, row.m);
    const Family<2> family = make_family<2>(1.0, row.m, VolumeCorrection::none);
    EXPECT_EQ(family.size(), row.bonds);
    const double k = 1e-6, p = k * classical_speed(medium, Branch::pressure),
                 s = k * classical_speed(medium, Branch::shear);
    const Point<2> axis = lattice_frequencies<2>(medium, family, Point<2>(k, 0.0));
    const Point<2> diagonal = lattice_frequencies<2>(medium, family, Point<2>(k, k) / std::sqrt(2.0));
    EXPECT_NEAR(axis[1] / p, row.p0, 1e-9);
    EXPECT_NEAR(axis[0] / s, row.s0, 1e-9);
    EXPECT_NEAR(diagonal[1] / p, row.p45, 1e-9);
    EXPECT_NEAR(diagonal[0] / s, row.s45, 1e-9);
  }
}

struct GanzenmuellerRow {
  int square;  // (delta/dx)^2
  int neighbours;
  double energy_error;              // of the uncalibrated sum under pure dilation
  double normalised, uncalibrated;  // long-wave [100] speed over c_l; 0: not given
};
const std::vector<GanzenmuellerRow> ganzenmueller_rows = {{3, 26, .19454594, 0, 0},
                                                          {4, 32, -.04507034, 1.03749163, 1.01384204},
                                                          {5, 56, .19576107, 0, 0},
                                                          {6, 80, .29949467, 1.01022550, 1.15161040},
                                                          {8, 92, -.02934647, .99806576, .98331186},
                                                          {9, 122, .07871684, .98322296, 1.02118808},
                                                          {12, 178, .02225566, 0, 0},
                                                          {16, 256, -.04507034, .99918283, .97640648},
                                                          {25, 514, -.01833231, .99581635, .98664632},
                                                          {36, 924, .02124422, .99297657, 1.00346864}};

Medium ganzenmueller(int square) {
  return medium_of({Kernel::inverse_distance}, {3, Plane::stress, 1.0},
                   std::sqrt(static_cast<double>(square)), 1.5);
}

TEST(CalibrationFactor, StrainEnergyErrorsOfTheInverseDistanceKernel) {
  for (const GanzenmuellerRow& row : ganzenmueller_rows) {
    const Medium medium = ganzenmueller(row.square);
    const Family<3> family = make_family<3>(1.0, medium.horizon, VolumeCorrection::none);
    EXPECT_EQ(family.size(), row.neighbours);
    const double error = 1.0 / calibration_factor<3>(medium, family) - 1.0;
    EXPECT_NEAR(error, row.energy_error, 1e-8);
    expect_relative(error, row.neighbours / (4.0 / 3.0 * pi * std::pow(row.square, 1.5)) - 1.0, 1e-12);
  }
}

TEST(CalibrationFactor, StrainEnergyErrorsInThePlane) {
  for (const auto& [m, neighbours, error] :
       {std::tuple{2, 12, -.04507034}, {3, 28, -.00970258}, {4, 48, -.04507034}, {5, 80, .01859164}}) {
    const Medium medium = medium_of({Kernel::inverse_distance}, {2, Plane::strain, 0.2}, m);
    const Family<2> family = make_family<2>(1.0, m, VolumeCorrection::none);
    EXPECT_EQ(family.size(), neighbours);
    EXPECT_NEAR(1.0 / calibration_factor<2>(medium, family) - 1.0, error, 1e-8);
  }
}

TEST(CalibrationFactor, GivesTheContinuumEnergyOfDilation) {
  for (const Micromodulus& kernel : kernels) {
    const Medium medium = medium_of(kernel, {2, Plane::stress, 0.2}, 0.25, 3.0, 2.0);
    const Family<2> family = make_family<2>(0.1, 0.25, VolumeCorrection::linear);
    const std::vector<double> rates = bond_rates<2>(medium, family, Calibration::discrete);
    double energy = 0.0;  // (1/4) sum c r V = (rho/4) sum rate r^2
    for (std::size_t j = 0; j < rates.size(); ++j)
      energy += 0.25 * 2.0 * rates[j] * family.length[j] * family.length[j];
    expect_relative(energy, dilation_energy(3.0, medium.continuum), 1e-14);
  }
}

TEST(CalibrationFactor, IsOneForTheSelfCellBar) {
  // Inverse distance in 1D: (1/4) sum c r V weighs all cells equally; the end cells count half and the self
  // cell, put on the two nearest neighbours, fills the gap.
  const Medium bar = medium_of({Kernel::inverse_distance}, {1, Plane::stress, 0.2}, 0.5);
  EXPECT_NEAR(calibration_factor<1>(bar, make_family<1>(0.1, 0.5, VolumeCorrection::linear, true)), 1.0,
              1e-14);
}

TEST(LatticeSymbol, SpeedAlongTheCubeAxisIsNotMendedByCalibration) {
  for (const GanzenmuellerRow& row : ganzenmueller_rows) {
    if (row.normalised == 0.0) continue;
    const Medium medium = ganzenmueller(row.square);
    const Family<3> family = make_family<3>(1.0, medium.horizon, VolumeCorrection::none);
    const Point<3> k(1e-6, 0.0, 0.0);
    const double classical = 1e-6 * classical_speed(medium, Branch::pressure);
    EXPECT_NEAR(lattice_frequencies<3>(medium, family, k, Calibration::discrete)[2] / classical,
                row.normalised, 1e-8);
    EXPECT_NEAR(lattice_frequencies<3>(medium, family, k)[2] / classical, row.uncalibrated, 1e-8);
  }
}

}  // namespace
}  // namespace perimode
