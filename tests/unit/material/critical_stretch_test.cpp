// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/material/critical_stretch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace perimode {
namespace {

using std::numbers::pi;

constexpr double modulus = 72e9, energy = 135.0, horizon = 0.75e-3;

double constant_kernel(const Continuum& continuum) {
  return critical_stretch({Kernel::constant}, modulus, energy, horizon, continuum);
}

// Integrals of powers by hand; the quadrature is exact for them but for round-off.
TEST(CriticalStretch, ConstantKernelMatchesTheClosedForms) {
  EXPECT_NEAR(constant_kernel({3}) / std::sqrt(5.0 * energy / (9.0 * (modulus / 1.5) * horizon)), 1.0, 1e-12);
  EXPECT_NEAR(
      constant_kernel({2, Plane::strain, 0.01}) / std::sqrt(5.0 * pi * energy / (12.0 * modulus * horizon)),
      1.0, 1e-12);
  // c = 9 E/(pi delta^3 h) in plane stress, and G0 = c h s0^2 delta^4/4.
  EXPECT_NEAR(
      constant_kernel({2, Plane::stress, 0.01}) / std::sqrt(4.0 * pi * energy / (9.0 * modulus * horizon)),
      1.0, 1e-12);
  // c = 2 E/(A delta^2), and G0 = A c s0^2 delta^3/6.
  EXPECT_NEAR(constant_kernel({1, Plane::stress, 2e-4}) / std::sqrt(3.0 * energy / (modulus * horizon)), 1.0,
              1e-12);
}

// Glass plates of [alebrahim2021], plane strain, delta = 0.75 mm.
TEST(CriticalStretch, OfGlassPlates) {
  const Continuum strain{2, Plane::strain, 1.0};
  EXPECT_NEAR(critical_stretch({Kernel::constant}, 72e9, 135.0, horizon, strain), 1.809003136e-3, 1e-12);
  EXPECT_NEAR(critical_stretch({Kernel::constant}, 65e9, 204.0, horizon, strain), 2.340437722e-3, 1e-12);
}

/// Bonds that cross z = 0 inside a unit area, one starting point and partner after the other: partners of a
/// point at depth z lie in the cap above it. A triple sum by midpoints, so 1e-4.
TEST(CriticalStretch, CountsEveryBondThatCrossesOnce) {
  for (const Kernel kernel :
       {Kernel::constant, Kernel::conical, Kernel::gaussian, Kernel::inverse_distance}) {
    const Micromodulus m{kernel, 2.0};
    const double c0 = micromodulus_constant(m, modulus, horizon, {3});
    constexpr int n = 200;
    double sum = 0.0;
    for (int a = 0; a < n; ++a) {
      const double z = (a + 0.5) / n * horizon;
      for (int b = 0; b < n; ++b) {
        const double r = z + (b + 0.5) / n * (horizon - z);
        // int over the cap's directions of sin(polar) from 0 to acos(z/r) is 1 - z/r.
        sum += 2.0 * pi * (1.0 - z / r) * r * r * (0.5 * micromodulus(m, c0, r, horizon) * r) *
               (horizon - z) / n * horizon / n;
      }
    }
    EXPECT_NEAR(fracture_energy(m, modulus, 1.0, horizon, {3}) / sum, 1.0, 1e-4) << static_cast<int>(kernel);
  }
}

TEST(CriticalStretch, IsTheInverseOfTheFractureEnergy) {
  for (const Kernel kernel :
       {Kernel::constant, Kernel::conical, Kernel::gaussian, Kernel::inverse_distance}) {
    for (int n = 1; n <= 3; ++n) {
      const Micromodulus m{kernel, 3.0};
      const Continuum continuum{n, Plane::strain, 0.5};
      const double s0 = critical_stretch(m, modulus, energy, horizon, continuum);
      EXPECT_NEAR(fracture_energy(m, modulus, s0, horizon, continuum) / energy, 1.0, 1e-14);
    }
  }
}

TEST(CriticalStretch, RefusesAFractureEnergyThatIsNotPositive) {
  EXPECT_THROW((void)critical_stretch({Kernel::constant}, modulus, 0.0, horizon, {3}), Error);
  EXPECT_THROW((void)critical_stretch({Kernel::constant}, modulus, std::nan(""), horizon, {3}), Error);
}

}  // namespace
}  // namespace perimode
