// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/material/micromodulus.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "support/relative.hpp"

namespace perimode {
namespace {

using std::numbers::pi;

constexpr double youngs = 68e9, horizon = 0.037, thickness = 0.7, area = 0.4;
constexpr double tolerance = 1e-13;  // relative; the header's promise

const Continuum bar{1, Plane::stress, area};
const Continuum plane_stress{2, Plane::stress, thickness};
const Continuum plane_strain{2, Plane::strain, thickness};
const Continuum solid{3, Plane::stress, 1.0};

double constant_of(Micromodulus micromodulus, const Continuum& continuum) {
  return micromodulus_constant(micromodulus, youngs, horizon, continuum);
}

void expect_relative(double value, double expected, double relative = tolerance) {
  test::expect_relative(value, expected, relative);
}

// Strain energy density of unit dilation by brute quadrature (Simpson), independent of the moments.
double family_energy(Micromodulus kernel, double c0, const Continuum& continuum) {
  constexpr int intervals = 20000;
  const auto integrand = [&](double r) {
    if (r == 0.0) return 0.0;
    const double shell = continuum.dimension == 1   ? 2.0
                         : continuum.dimension == 2 ? 2.0 * pi * r
                                                    : 4.0 * pi * r * r;
    return 0.25 * micromodulus(kernel, c0, r, horizon) * r * shell * continuum.section;
  };
  // c r stays finite at 0; its limit matters for the 1/r kernel in 1D only.
  const double at_zero = integrand(1e-12 * horizon);
  double sum = at_zero + integrand(horizon);
  for (int i = 1; i < intervals; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * integrand(horizon * i / intervals);
  return sum * horizon / (3.0 * intervals);
}

TEST(Micromodulus, ConstantKernelMatchesBouaraquiaEquations24To26) {
  expect_relative(constant_of({Kernel::constant}, plane_stress),
                  9.0 * youngs / (thickness * pi * std::pow(horizon, 3)));
  expect_relative(constant_of({Kernel::constant}, plane_strain),
                  48.0 * youngs / (5.0 * thickness * pi * std::pow(horizon, 3)));
  expect_relative(constant_of({Kernel::constant}, bar), 2.0 * youngs / (area * horizon * horizon));
}

TEST(Micromodulus, BouaraquiaEquations21And23AgreeOnlyAtTheTheorysPoissonRatio) {
  const double nu = poissons_ratio(plane_stress);
  const double c0 = constant_of({Kernel::constant}, plane_stress);
  const double common = youngs / (thickness * pi * std::pow(horizon, 3));
  expect_relative(c0, 6.0 / (1.0 - nu) * common);
  expect_relative(c0, 12.0 / (1.0 + nu) * common);
}

TEST(Micromodulus, GaussianKernelInPlaneStressMatchesBouaraquiaEquation29) {
  for (const double p : {1.0, 1.5, 2.0, 3.0, 5.0, 10.0}) {
    const double expected = 12.0 * youngs / (thickness * pi * std::pow(horizon, 3)) * std::pow(p, 3) /
                            (std::sqrt(pi) * std::erf(p) - 2.0 * p * std::exp(-p * p));
    expect_relative(constant_of({Kernel::gaussian, p}, plane_stress), expected);
  }
}

TEST(Micromodulus, GaussianWithP2MatchesBouaraquiaEquations30And31) {
  const double e4 = std::exp(4.0);
  const double c0 = 96.0 * e4 * youngs /
                    ((e4 * std::sqrt(pi) * std::erf(2.0) - 4.0) * thickness * pi * std::pow(horizon, 3));
  const Micromodulus gaussian{Kernel::gaussian, 2.0};
  expect_relative(constant_of(gaussian, plane_stress), c0);
  const double r = 0.6 * horizon;
  expect_relative(micromodulus(gaussian, c0, r, horizon), c0 * std::exp(-1.44));
}

TEST(Micromodulus, GaussianKernelInABarMatchesBouaraquiaEquation33) {
  for (const double p : {0.1, 0.7, 1.0, 2.0, 10.0}) {
    const double expected = 2.0 * youngs / (area * horizon * horizon) * p * p / -std::expm1(-p * p);
    expect_relative(constant_of({Kernel::gaussian, p}, bar), expected);
  }
}

TEST(Micromodulus, EnergiesOfBouaraquiaEquations28And32AreTheContinuumOnes) {
  const double p = 2.0, e = std::exp(-p * p);
  const double plate = constant_of({Kernel::gaussian, p}, plane_stress);
  // Eq. (28) at eps_11 = eps_22 = 1: the bracket of strains is 8.
  const double w28 = thickness * plate * pi / 16.0 * std::pow(horizon, 3) *
                     (std::sqrt(pi) * std::erf(p) / (4.0 * p * p * p) - e / (2.0 * p * p)) * 8.0;
  expect_relative(w28, dilation_energy(youngs, plane_stress));
  const double rod = constant_of({Kernel::gaussian, p}, bar);
  const double w32 = area * rod * horizon * horizon / (4.0 * p * p) * (1.0 - e);
  expect_relative(w32, dilation_energy(youngs, bar));
}

TEST(Micromodulus, ConstantKernelInThreeDimensionsIs18KOverPiDeltaToTheFourth) {
  const double bulk = youngs / 1.5;
  expect_relative(constant_of({Kernel::constant}, solid), 18.0 * bulk / (pi * std::pow(horizon, 4)));
}

TEST(Micromodulus, InverseDistanceKernelGivesGanzenmuellersConstants) {
  // Their bond energy is c s^2 / 2 without the length: c = c(r) r = c0 delta.
  const double bulk = youngs / 1.5;
  expect_relative(constant_of({Kernel::inverse_distance}, solid) * horizon,
                  27.0 * bulk / (2.0 * pi * std::pow(horizon, 3)));
  expect_relative(constant_of({Kernel::inverse_distance}, plane_strain) * horizon,
                  48.0 * bulk / (5.0 * pi * horizon * horizon * thickness));
}

TEST(Micromodulus, ScabbiaKernelIsTheInverseDistanceKernelInABar) {
  // u'' = v^2 int (u' - u) / (delta xi^2): c(r) A / r = E / (delta r^2).
  const Micromodulus kernel{Kernel::inverse_distance};
  const double c0 = constant_of(kernel, bar), r = 0.3 * horizon;
  expect_relative(micromodulus(kernel, c0, r, horizon) * area / r, youngs / (horizon * r * r));
}

TEST(Micromodulus, ConicalKernelIsScaledByTheRatioOfMoments) {
  const Micromodulus conical{Kernel::conical};
  for (const Continuum& continuum : {bar, plane_stress, plane_strain, solid}) {
    expect_relative(constant_of(conical, continuum),
                    (continuum.dimension + 2) * constant_of({Kernel::constant}, continuum));
  }
}

TEST(Micromodulus, StoresTheContinuumEnergyOfDilation) {
  const std::vector<Micromodulus> kernels = {{Kernel::constant},          {Kernel::conical},
                                             {Kernel::inverse_distance},  {Kernel::gaussian, 0.3},
                                             {Kernel::gaussian, 0.99999}, {Kernel::gaussian, 1.00001},
                                             {Kernel::gaussian, 2.0},     {Kernel::gaussian, 10.0}};
  for (const Continuum& continuum : {bar, plane_stress, plane_strain, solid}) {
    for (const Micromodulus& kernel : kernels) {
      const double c0 = constant_of(kernel, continuum);
      // Simpson's error for p = 10: (p h / delta)^4 / 180 ~ 1e-13; rounding of 2e4 terms ~ 1e-13.
      expect_relative(family_energy(kernel, c0, continuum), dilation_energy(youngs, continuum), 5e-12);
    }
  }
}

TEST(Micromodulus, GaussianTendsToTheConstantKernelForSmallP) {
  for (const Continuum& continuum : {bar, plane_stress, solid}) {
    const int n = continuum.dimension;
    const double p = 1e-4, constant = constant_of({Kernel::constant}, continuum);
    // First order in p^2: the moment falls by the factor 1 - p^2 (n+1)/(n+3).
    expect_relative(constant_of({Kernel::gaussian, p}, continuum),
                    constant * (1.0 + p * p * (n + 1.0) / (n + 3.0)));
  }
}

TEST(Micromodulus, ConicalShapeIsZeroBeyondTheHorizonAndTheOthersAreContinued) {
  const double r = 1.25 * horizon;
  EXPECT_EQ(kernel_shape({Kernel::conical}, r, horizon), 0.0);
  EXPECT_EQ(kernel_shape({Kernel::constant}, r, horizon), 1.0);
  EXPECT_DOUBLE_EQ(kernel_shape({Kernel::inverse_distance}, r, horizon), 0.8);
  EXPECT_DOUBLE_EQ(kernel_shape({Kernel::gaussian, 2.0}, r, horizon), std::exp(-6.25));
}

TEST(Micromodulus, DilationEnergyFollowsFromClassicalElasticity) {
  // Plane stress: E/(1-nu). Plane strain: E/((1+nu)(1-2nu)). 3D: (9/2) K = 3E/2/(1-2nu).
  const double nu3 = poissons_ratio(plane_stress), nu4 = poissons_ratio(plane_strain);
  EXPECT_DOUBLE_EQ(dilation_energy(youngs, plane_stress), youngs / (1.0 - nu3));
  EXPECT_DOUBLE_EQ(dilation_energy(youngs, plane_strain), youngs / ((1.0 + nu4) * (1.0 - 2.0 * nu4)));
  EXPECT_DOUBLE_EQ(dilation_energy(youngs, solid), 1.5 * youngs / (1.0 - 2.0 * poissons_ratio(solid)));
  EXPECT_DOUBLE_EQ(dilation_energy(youngs, bar), 0.5 * youngs);
}

TEST(Micromodulus, RefusesValuesThatHaveNoMeaning) {
  EXPECT_THROW((void)micromodulus_constant({}, -1.0, horizon, bar), Error);
  EXPECT_THROW((void)micromodulus_constant({}, youngs, 0.0, bar), Error);
  EXPECT_THROW((void)micromodulus_constant({}, youngs, horizon, {2, Plane::stress, 0.0}), Error);
  EXPECT_THROW((void)micromodulus_constant({Kernel::gaussian, 0.0}, youngs, horizon, bar), Error);
  EXPECT_THROW((void)poissons_ratio({4, Plane::stress, 1.0}), Error);
}

}  // namespace
}  // namespace perimode
