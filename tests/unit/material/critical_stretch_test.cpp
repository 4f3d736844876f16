// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/material/critical_stretch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace perimode {
namespace {

using std::numbers::pi;

constexpr double modulus = 72e9, energy = 135.0, delta = 0.75e-3;

double constant_kernel(const Continuum& continuum) {
  return critical_stretch({Kernel::constant}, modulus, energy, delta, continuum);
}

// Integrals of powers by hand; the quadrature is exact for them but for round-off.
TEST(CriticalStretch, ConstantKernelMatchesTheClosedForms) {
  EXPECT_NEAR(constant_kernel({3}) / std::sqrt(5.0 * energy / (9.0 * (modulus / 1.5) * delta)), 1.0, 1e-12);
  EXPECT_NEAR(
      constant_kernel({2, Plane::strain, 0.01}) / std::sqrt(5.0 * pi * energy / (12.0 * modulus * delta)),
      1.0, 1e-12);
  // c = 9 E/(pi delta^3 h) in plane stress, and G0 = c h s0^2 delta^4/4.
  EXPECT_NEAR(
      constant_kernel({2, Plane::stress, 0.01}) / std::sqrt(4.0 * pi * energy / (9.0 * modulus * delta)), 1.0,
      1e-12);
  // c = 2 E/(A delta^2), and G0 = A c s0^2 delta^3/6.
  EXPECT_NEAR(constant_kernel({1, Plane::stress, 2e-4}) / std::sqrt(3.0 * energy / (modulus * delta)), 1.0,
              1e-12);
}

// Glass plates of [alebrahim2021], plane strain, delta = 0.75 mm.
TEST(CriticalStretch, OfGlassPlates) {
  const Continuum strain{2, Plane::strain, 1.0};
  EXPECT_NEAR(critical_stretch({Kernel::constant}, 72e9, 135.0, delta, strain), 1.809003136e-3, 1e-12);
  EXPECT_NEAR(critical_stretch({Kernel::constant}, 65e9, 204.0, delta, strain), 2.340437722e-3, 1e-12);
}

/// Bonds that cross z = 0 inside a unit area, one starting point and partner after the other: partners of a
/// point at depth z lie in the cap above it. A triple sum by midpoints, so 1e-4.
TEST(CriticalStretch, CountsEveryBondThatCrossesOnce) {
  for (const Kernel kernel :
       {Kernel::constant, Kernel::conical, Kernel::gaussian, Kernel::inverse_distance}) {
    const Micromodulus m{kernel, 2.0};
    const double c0 = micromodulus_constant(m, modulus, delta, {3});
    constexpr int n = 200;
    double sum = 0.0;
    for (int a = 0; a < n; ++a) {
      const double z = (a + 0.5) / n * delta;
      for (int b = 0; b < n; ++b) {
        const double r = z + (b + 0.5) / n * (delta - z);
        // int over the cap's directions of sin(polar) from 0 to acos(z/r) is 1 - z/r.
        sum += 2.0 * pi * (1.0 - z / r) * r * r * (0.5 * micromodulus(m, c0, r, delta) * r) * (delta - z) /
               n * delta / n;
      }
    }
    EXPECT_NEAR(fracture_energy(m, modulus, 1.0, delta, {3}) / sum, 1.0, 1e-4) << static_cast<int>(kernel);
  }
}

TEST(CriticalStretch, IsTheInverseOfTheFractureEnergy) {
  for (const Kernel kernel :
       {Kernel::constant, Kernel::conical, Kernel::gaussian, Kernel::inverse_distance}) {
    for (int n = 1; n <= 3; ++n) {
      const Micromodulus m{kernel, 3.0};
      const Continuum continuum{n, Plane::strain, 0.5};
      const double s0 = critical_stretch(m, modulus, energy, delta, continuum);
      EXPECT_NEAR(fracture_energy(m, modulus, s0, delta, continuum) / energy, 1.0, 1e-14);
    }
  }
}

/// Eq. (50) of [alebrahim2021] for N = 3, its coefficients to two digits.
Micromodulus fitted() {
  Micromodulus m{Kernel::fourier};
  m.a0 = 2.3;
  m.a = {2.0, -0.39, -0.48, 0.28, 0.14, -0.15, -0.02, 0.05};
  m.w = 1.1;
  m.spacing = 0.25e-3;
  return m;
}

/// 3.8, 3.2 and 0.5 for the rest: f of the orbits of N = 3.
Micromodulus shells_three() {
  Micromodulus m{Kernel::shells};
  m.shells = {{{1, 0, 0}, 3.8}, {{1, 1, 0}, 3.2}, {{2, 0, 0}, 0.5},
              {{2, 1, 0}, 0.5}, {{2, 2, 0}, 0.5}, {{3, 0, 0}, 0.5}};
  return m;
}

// Glass plates of [alebrahim2021] with eq. (52) evaluated anew; 7 digits are known.
TEST(CriticalStretch, OfTheFittedInfluenceFunction) {
  const Continuum strain{2, Plane::strain, 1.0};
  EXPECT_NEAR(critical_stretch(fitted(), 72e9, 135.0, delta, strain), 2.097473588e-3, 1e-4 * 2.0975e-3);
  EXPECT_NEAR(critical_stretch(fitted(), 65e9, 204.0, delta, strain), 2.713652733e-3, 1e-4 * 2.7137e-3);
}

/// A table of [alebrahim2021] (positive, N = 3), summed over the bonds that cross a grid line; 5 digits are
/// known.
TEST(CriticalStretch, OfATableByItsCrossingBonds) {
  const auto family = make_family<2>(0.25e-3, delta, VolumeCorrection::none);
  const Continuum strain{2, Plane::strain, 1.0};
  const double glass = stretch_of(135.0, lattice_fracture_energy(shells_three(), 72e9, 1.0, family, strain));
  const double duran = stretch_of(204.0, lattice_fracture_energy(shells_three(), 65e9, 1.0, family, strain));
  EXPECT_NEAR(duran / glass, std::sqrt(204.0 / 135.0 * 72.0 / 65.0), 1e-12);
  EXPECT_NEAR(glass, 2.0442e-3, 5e-5 * 2.0442e-3);
  EXPECT_NEAR(duran, 2.6448e-3, 5e-5 * 2.6448e-3);
}

/// Particle by particle: the bonds that cross the plane between two layers of a periodic block.
TEST(CriticalStretch, CountsTheBondsThatCrossAGridPlane) {
  const double h = 0.5;
  const auto family = make_family<3>(h, 3.0 * h, VolumeCorrection::none);
  Micromodulus m{Kernel::shells};
  double alpha = 1.0;
  for (const auto& own : family.shell) {
    m.shells.push_back({own, alpha});
    alpha = -0.7 * alpha + 0.4;
  }
  const double c0 = micromodulus_constant(m, modulus, family.horizon, {3});
  const auto shapes = kernel_shapes(m, family);
  for (int axis = 0; axis < 3; ++axis) {
    double sum = 0.0;  // of one column of cells of area h^2, over the layers below the plane
    for (int layer = 0; layer < family.reach(); ++layer) {
      for (int k = 0; k < family.size(); ++k) {
        const auto at = static_cast<std::size_t>(k);
        if (family.offset[at][static_cast<std::size_t>(axis)] <= layer) continue;
        sum += 0.5 * c0 * shapes[at] * family.length[at] * std::pow(h, 6);
      }
    }
    EXPECT_NEAR(lattice_fracture_energy(m, modulus, 1.0, family, {3}), sum / (h * h),
                1e-12 * c0 * std::pow(h, 6));
  }
}

/// The sum over the grid of the constant kernel tends to the integral as the grid is refined.
TEST(CriticalStretch, OfAFineGridIsThatOfTheContinuum) {
  for (const int ratio : {10, 40}) {
    const auto family = make_family<2>(delta / ratio, delta, VolumeCorrection::none);
    const Continuum strain{2, Plane::strain, 0.1};
    const double grid = lattice_fracture_energy({Kernel::constant}, modulus, 1.0, family, strain);
    const double whole = fracture_energy({Kernel::constant}, modulus, 1.0, delta, strain);
    EXPECT_NEAR(grid / whole, 1.0, 0.6 / ratio);  // a rim of cells in or out
  }
}

TEST(CriticalStretch, RefusesAnEnergyThatNegativePartsOutweigh) {
  Micromodulus m = fitted();
  m.a0 = -3.0;
  EXPECT_THROW((void)critical_stretch(m, modulus, energy, delta, {2}), Error);
  EXPECT_THROW((void)stretch_of(energy, 0.0), Error);
}

TEST(CriticalStretch, RefusesAFractureEnergyThatIsNotPositive) {
  EXPECT_THROW((void)critical_stretch({Kernel::constant}, modulus, 0.0, delta, {3}), Error);
  EXPECT_THROW((void)critical_stretch({Kernel::constant}, modulus, std::nan(""), delta, {3}), Error);
}

}  // namespace
}  // namespace perimode
