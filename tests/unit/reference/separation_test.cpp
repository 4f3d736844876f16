// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/reference/separation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "support/relative.hpp"

namespace perimode {
namespace {

using std::numbers::pi;
using test::expect_relative;

constexpr Micromodulus inverse_distance{Kernel::inverse_distance};

// The bar of [scabbia2023]: length 1 m, horizon 0.1 m, v = 5000 m/s.
constexpr double bar_horizon = 0.1, bar_speed = 5000.0;

double bar_frequency(int mode, int m, bool self_cell) {
  const Family<1> family = make_family<1>(bar_horizon / m, bar_horizon, VolumeCorrection::linear, self_cell);
  return bar_speed * std::sqrt(lattice_lambda<1>(inverse_distance, family, Point<1>(mode * pi)));
}

double bar_continuum_frequency(int mode) {
  return bar_speed * std::sqrt(continuum_lambda(inverse_distance, bar_horizon, 1, mode * pi));
}

struct BarMode {
  int mode;
  double continuum;    // independent evaluation with the sine integral, 11 digits
  double odd_walls10;  // delta/dx = 10
};
const std::vector<BarMode> bar_modes = {
    {1, 1.5686458861e4, 1.5288055010e4},  {2, 3.1244555297e4, 3.0443743290e4},
    {3, 4.6549230270e4, 4.5338059659e4},  {5, 7.5933792828e4, 7.3862894136e4},
    {10, 1.3816714221e5, 1.3356565491e5}, {15, 1.8137362049e5, 1.7347218409e5},
    {20, 2.1107473968e5, 1.9904248050e5}};

TEST(Separation, BarFrequenciesOfTheContinuum) {
  for (const BarMode& row : bar_modes) {
    expect_relative(bar_continuum_frequency(row.mode), row.continuum, 1e-10);  // digits given
  }
}

TEST(Separation, BarFrequenciesWithOddWalls) {
  for (const BarMode& row : bar_modes) {
    expect_relative(bar_frequency(row.mode, 10, false), row.odd_walls10, 1e-10);
  }
}

TEST(Separation, OddWallsConvergeWithFirstOrderInTheRatio) {
  const std::vector<int> modes = {1, 2, 3, 5, 10, 15, 20};
  struct Row {
    int m;
    std::vector<double> error;
  };
  const std::vector<Row> rows = {
      {5, {-5.1490e-2, -5.2011e-2, -5.2879e-2, -5.5661e-2, -6.8737e-2, -9.0143e-2, -1.17655e-1}},
      {10, {-2.5398e-2, -2.5630e-2, -2.6019e-2, -2.7272e-2, -3.3304e-2, -4.3564e-2, -5.7005e-2}},
      {25, {-1.0079e-2, -1.0166e-2, -1.0311e-2, -1.0781e-2, -1.3080e-2, -1.7090e-2, -2.2404e-2}},
      {50, {-5.0266e-3, -5.0689e-3, -5.1398e-3, -5.3697e-3, -6.5011e-3, -8.4911e-3, -1.1138e-2}},
      {100, {-2.5101e-3, -2.5310e-3, -2.5660e-3, -2.6797e-3, -3.2409e-3, -4.2323e-3, -5.5536e-3}}};
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < modes.size(); ++i) {
      const double error = bar_frequency(modes[i], row.m, false) / bar_continuum_frequency(modes[i]) - 1.0;
      expect_relative(error, row.error[i], 6e-5);  // half a unit of the fifth digit
    }
  }
}

TEST(Separation, TheSelfCellTermRestoresSecondOrder) {
  const auto error = [](int mode, int m) {
    return bar_frequency(mode, m, true) / bar_continuum_frequency(mode) - 1.0;
  };
  EXPECT_NEAR(error(1, 10), -8.9e-6, 0.05e-6);
  EXPECT_NEAR(error(20, 10), -1.80e-3, 0.005e-3);
  EXPECT_NEAR(error(1, 100), -7.0e-8, 0.05e-8);
  EXPECT_NEAR(error(20, 100), -1.8e-6, 0.05e-6);
}

TEST(Separation, ScabbiasClosedFormIsTheQuadratureOfTheKernel) {
  for (const double k : {1e-3, 1.0, 30.0, 400.0, 5000.0}) {
    expect_relative(scabbia_lambda(0.1, k), continuum_lambda(inverse_distance, 0.1, 1, k), 2e-13);
  }
}

TEST(Separation, ContinuumOfTheConstantKernelMatchesItsPowerSeries) {
  // C = 2/(delta^2 r): lambda = (4/delta^2) int_0^{k delta} (1 - cos z)/z dz = -(4/delta^2) sum (-z^2)^n/(2n
  // (2n)!).
  for (const double z : {1e-4, 0.5, 3.0, 12.0}) {
    long double sum = 0.0L, power = 1.0L;
    for (int n = 1; n < 60; ++n) {
      power *= -static_cast<long double>(z) * z / ((2.0L * n - 1.0L) * (2.0L * n));
      sum -= power / (2.0L * n);
    }
    const double horizon = 0.02;
    const double expected = static_cast<double>(4.0L / (horizon * horizon) * sum);
    expect_relative(continuum_lambda({Kernel::constant}, horizon, 1, z / horizon), expected, 1e-13);
  }
}

TEST(Separation, LongWavesRunAtUnitSpeedInTheContinuum) {
  for (const Kernel kernel :
       {Kernel::constant, Kernel::conical, Kernel::gaussian, Kernel::inverse_distance}) {
    for (const int dimension : {1, 2, 3}) {
      const double k = 1e-6;  // relative deviation of the order (k delta)^2
      expect_relative(continuum_lambda({kernel, 3.0}, 1.0, dimension, k), k * k, 1e-12);
    }
  }
}

TEST(Separation, OscillatoryIntegralsOfSharpGaussiansStayExact) {
  // p = 10: the tail beyond delta is exp(-100), so the integral is the one over the whole line,
  // (2 p^2/delta^2) int_0^inf 2 exp(-(p r/delta)^2) (1 - cos k r)/r dr.
  const double p = 10.0, horizon = 1.0;
  for (const double k : {5.0, 40.0, 400.0}) {
    // int_0^inf exp(-t^2)(1 - cos 2 b t)/t dt = int_0^b 2 D(x) dx, D Dawson's function; b = k/(2p). Simpson
    // on the substitution t = exp(s) in long double, spectrally accurate, is independent of Gauss-Legendre.
    long double sum = 0.0L;
    const long double h = 2e-4L, b = k / (2.0L * p);
    for (int i = -200000; i <= 12000; ++i) {
      const long double t = std::exp(i * h), s = std::sin(b * t);
      sum += h * std::exp(-t * t) * 2.0L * s * s;
    }
    const double expected = static_cast<double>(4.0L * p * p / (horizon * horizon) * sum);
    expect_relative(continuum_lambda({Kernel::gaussian, p}, horizon, 1, k), expected, 2e-13);
  }
}

// Scalar model on a 1 x 0.5 rectangle, 40 x 20 cells, delta = 3 spacings, kernel 1/r.
TEST(Separation, ScalarPlateFrequenciesOfLatticeAndContinuum) {
  struct Row {
    int p, q;
    double lattice, continuum;
  };
  const double spacing = 1.0 / 40.0;
  const Family<2> family = make_family<2>(spacing, 3.0 * spacing, VolumeCorrection::linear);
  EXPECT_EQ(family.size(), 36);
  for (const Row& row : {Row{1, 1, 7.0555468155, 6.9883589543}, Row{2, 1, 8.8956643115, 8.8121131594},
                         Row{3, 1, 11.2764952457, 11.1750466123}, Row{5, 3, 23.1704501636, 23.0330466041}}) {
    const Point<2> k(row.p * pi, row.q * pi / 0.5);
    // C = a/r is the constant kernel: C = a g(r)/r.
    expect_relative(std::sqrt(lattice_lambda<2>({Kernel::constant}, family, k)), row.lattice, 1e-11);
    expect_relative(std::sqrt(continuum_lambda({Kernel::constant}, 3.0 * spacing, 2, k.norm())),
                    row.continuum, 1e-11);
  }
}

// omega/v at k = 500, 1000, 1500 rad/m for delta = 4 mm and m = 3.
TEST(Separation, DispersionOfBouaraquiasKernels) {
  struct Row {
    Micromodulus kernel;
    double plain[3], corrected[3], continuum[3];
  };
  const std::vector<Row> rows = {{{Kernel::constant},
                                  {516.8517432706, 751.7712835516, 751.0401484101},
                                  {456.2122382536, 704.4559924061, 749.9344858948},
                                  {460.2667750030, 725.3433193854, 780.5498667643}},
                                 {{Kernel::gaussian, 1.0},
                                  {491.3462006403, 768.3758463504, 844.2626191223},
                                  {455.0614272103, 741.8235561020, 843.6904279148},
                                  {466.7434683653, 768.9268189026, 884.6273273653}},
                                 {{Kernel::gaussian, 2.0},
                                  {463.1271377547, 820.0140532854, 1033.2208957645},
                                  {458.3482868758, 816.8726604727, 1033.1609586887},
                                  {481.4121559929, 866.4373643017, 1119.7172977711}}};
  const double horizon = 4e-3, spacing = horizon / 3.0;
  const Family<1> plain = make_family<1>(spacing, horizon, VolumeCorrection::none);
  const Family<1> corrected = make_family<1>(spacing, horizon, VolumeCorrection::linear);
  for (const Row& row : rows) {
    for (int i = 0; i < 3; ++i) {
      const Point<1> k(500.0 * (i + 1));
      expect_relative(std::sqrt(lattice_lambda<1>(row.kernel, plain, k)), row.plain[i], 1e-12);
      expect_relative(std::sqrt(lattice_lambda<1>(row.kernel, corrected, k)), row.corrected[i], 1e-12);
      expect_relative(std::sqrt(continuum_lambda(row.kernel, horizon, 1, k[0])), row.continuum[i], 1e-12);
    }
  }
}

TEST(Separation, LongWaveSpeedOfTheConstantKernelInABar) {
  for (const int m : {1, 2, 3, 5, 10}) {
    const Point<1> k(1e-6);
    const double plain =
        lattice_lambda<1>({Kernel::constant}, make_family<1>(1.0 / m, 1.0, VolumeCorrection::none), k);
    const double corrected =
        lattice_lambda<1>({Kernel::constant}, make_family<1>(1.0 / m, 1.0, VolumeCorrection::linear), k);
    expect_relative(std::sqrt(plain) / k[0], std::sqrt(1.0 + 1.0 / m), 1e-12);
    expect_relative(std::sqrt(corrected) / k[0], 1.0, 1e-12);
  }
}

TEST(Separation, LongWaveSpeedOfTheGaussianKernelInABar) {
  for (const auto& [m, factor] : {std::pair{3, 0.95474}, {5, 0.98435}, {10, 0.99615}}) {
    const Family<1> family = make_family<1>(1.0 / m, 1.0, VolumeCorrection::linear);
    EXPECT_NEAR(std::sqrt(lattice_lambda<1>({Kernel::gaussian, 2.0}, family, Point<1>(1e-6))) / 1e-6, factor,
                6e-6);
  }
}

TEST(AxisWaves, EveryComponentHasAsManyModesAsCells) {
  for (const Ends ends : {Ends::mirror, Ends::antimirror, Ends::mixed, Ends::periodic}) {
    for (const int cells : {1, 2, 3, 8, 9}) {
      int normal = 0, tangential = 0;
      for (const AxisWave& wave : axis_waves(ends, 2.0, cells)) {
        normal += wave.normal ? wave.multiplicity : 0;
        tangential += wave.tangential ? wave.multiplicity : 0;
      }
      EXPECT_EQ(normal, cells);
      EXPECT_EQ(tangential, cells);
    }
  }
}

TEST(AxisWaves, FollowTheirWalls) {
  const auto mirror = axis_waves(Ends::mirror, 2.0, 4);
  EXPECT_EQ(mirror.size(), 5U);
  EXPECT_FALSE(mirror.front().normal);
  EXPECT_FALSE(mirror.back().tangential);
  EXPECT_DOUBLE_EQ(mirror[3].k, 1.5 * pi);
  const auto antimirror = axis_waves(Ends::antimirror, 2.0, 4);
  EXPECT_FALSE(antimirror.front().tangential);
  EXPECT_FALSE(antimirror.back().normal);
  EXPECT_DOUBLE_EQ(axis_waves(Ends::mixed, 2.0, 4).front().k, 0.25 * pi);
  EXPECT_DOUBLE_EQ(axis_waves(Ends::periodic, 2.0, 4)[1].k, pi);
  EXPECT_EQ(axis_waves(Ends::periodic, 2.0, 4)[2].multiplicity, 1);
}

}  // namespace
}  // namespace perimode
