// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/dispersion/waves.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "lattices.hpp"
#include "perimode/core/error.hpp"
#include "perimode/dispersion/zone.hpp"
#include "perimode/linalg/threads.hpp"
#include "support/models.hpp"
#include "support/relative.hpp"

namespace perimode {
namespace {

using std::numbers::pi;
using test::expect_relative;
using test::lattice_of;

const std::vector<double> mixed_alpha_2d = {9.1, 2.3, -2.9, 1.4, 0.9, -0.2};  // m = 3: 6 orbits

// [alebrahim2021] eqs. (21)-(28): plane strain, constant kernel, no correction, over the classical speeds.
TEST(PlaneWaves, SpeedsOfLongWavesOfUncorrectedPlanes) {
  struct Row {
    int m, bonds;
    double p0, p45, s0, s45;
  };
  for (const Row& row : {Row{1, 4, 1.5957691216, 1.1283791671, 0.0, 1.9544100476},
                         Row{2, 12, 1.0862820709, 0.9631318639, 0.8217282015, 1.1968268412},
                         Row{3, 28, 1.0260450663, 1.0143700404, 1.0025590655, 1.0375887321},
                         Row{4, 48, 0.9870783572, 0.9749268397, 0.9626219416, 0.9990820905},
                         Row{10, 316, 1.0009409980, 1.0129031516, 1.0247256744, 0.9888341461}}) {
    const auto lattice = lattice_of<2>({Kernel::constant}, 0.1, row.m);
    EXPECT_EQ(lattice.family.size(), row.bonds);
    const double p = classical_speed(lattice.medium, Branch::pressure),
                 s = classical_speed(lattice.medium, Branch::shear);
    const auto axis = plane_waves<2>(lattice, Point<2>::Zero(), Point<2>(1.0, 0.0));
    const auto diagonal = plane_waves<2>(lattice, Point<2>::Zero(), Point<2>(1.0, 1.0).normalized());
    EXPECT_NEAR(axis.phase_velocity[0] / p, row.p0, 1e-9);  // digits given
    EXPECT_NEAR(axis.phase_velocity[1] / s, row.s0, 1e-9);
    EXPECT_NEAR(diagonal.phase_velocity[0] / p, row.p45, 1e-9);
    EXPECT_NEAR(diagonal.phase_velocity[1] / s, row.s45, 1e-9);
    EXPECT_EQ(axis.angular_frequency[0], 0.0);
  }
}

// m = 1: M = diag, eq. (28): |cos| and |sin| of the angle, sorted: P is the wave more parallel to k.
TEST(PlaneWaves, OfFourNeighboursAreNamedByPolarisation) {
  const auto lattice = lattice_of<2>({Kernel::constant}, 1.0, 1.0);
  const double scale = 1.5957691216 * classical_speed(lattice.medium, Branch::pressure);
  for (const double degrees : {10.0, 30.0, 44.0, 46.0, 60.0, 85.0}) {
    const double angle = degrees * pi / 180.0, c = std::cos(angle), s = std::sin(angle);
    const auto waves = plane_waves<2>(lattice, Point<2>::Zero(), Point<2>(c, s));
    EXPECT_NEAR(waves.phase_velocity[0], scale * std::max(c, s), 2e-9);
    EXPECT_NEAR(waves.phase_velocity[1], scale * std::min(c, s), 2e-9);
    EXPECT_NEAR(waves.polarisation(degrees < 45.0 ? 0 : 1, 0), 1.0, 1e-15);
    // grad (V |cos|k|) is V along x whatever the direction.
    EXPECT_NEAR(waves.group_velocity[0].norm(), scale, 2e-9);
  }
}

TEST(PlaneWaves, LimitsAreThoseOfShortWaveVectors) {
  for (const Point<3>& direction : {Point<3>(1.0, 0.0, 0.0), Point<3>(0.36, 0.48, 0.8)}) {
    const auto lattice = lattice_of<3>({Kernel::gaussian, 1.4}, 0.2, 2.3, VolumeCorrection::linear);
    const auto limit = plane_waves<3>(lattice, Point<3>::Zero(), direction);
    // (k delta)^2 = 2e-7 bends the branch by a twelfth of that at most.
    const auto near = plane_waves<3>(lattice, 1e-3 * direction, direction);
    for (std::size_t b = 0; b < 3; ++b) {
      expect_relative(near.phase_velocity[b], limit.phase_velocity[b], 1e-7);
      EXPECT_LT((near.group_velocity[b] - limit.group_velocity[b]).norm(), 1e-6 * limit.phase_velocity[0]);
      // Homogeneous of degree one: the group velocity's part along k is the phase velocity.
      expect_relative(limit.group_velocity[b].dot(direction), limit.phase_velocity[b], 1e-13);
    }
    const auto tiny = plane_waves<3>(lattice, 1e-7 * direction, Point<3>(0.0, 0.0, 1.0));
    expect_relative(tiny.angular_frequency[1], 1e-7 * limit.phase_velocity[1], 1e-13);
  }
}

template <int Dim>
void expect_gradients(const Lattice<Dim>& lattice, const Point<Dim>& k) {
  const auto waves = plane_waves<Dim>(lattice, k, k.normalized());
  const double h = 1e-4 / lattice.family.horizon;
  for (std::size_t b = 0; b < Dim; ++b) {
    for (int c = 0; c < Dim; ++c) {
      // Fourth-order central differences: error (h delta)^4 and round-off 1e-16/(h delta).
      const auto omega = [&](double step) {
        const Point<Dim> at = k + step * h * Point<Dim>::Unit(c);
        return plane_waves<Dim>(lattice, at, at.normalized()).angular_frequency[b];
      };
      const double slope = (8.0 * (omega(1.0) - omega(-1.0)) - (omega(2.0) - omega(-2.0))) / (12.0 * h);
      EXPECT_NEAR(waves.group_velocity[b][c], slope, 1e-9 * waves.phase_velocity[0])
          << Dim << "D, branch " << b << ", component " << c;
    }
    const Point<Dim> a = waves.polarisation.col(static_cast<int>(b));
    const auto symbol = lattice_symbol<Dim>(lattice.family, lattice.rates, k);
    EXPECT_LT((symbol * a - waves.squared[b] * a).norm(), 1e-13 * symbol.norm());
    EXPECT_NEAR(a.norm(), 1.0, 1e-14);
  }
}

TEST(PlaneWaves, GroupVelocityIsTheGradientOfTheFrequency) {
  expect_gradients<1>(lattice_of<1>({Kernel::conical}, 0.3, 4.0), Point<1>(2.2));
  expect_gradients<2>(lattice_of<2>({Kernel::gaussian, 2.0}, 0.3, 3.0), Point<2>(5.1, 2.2));
  expect_gradients<2>(lattice_of<2>(test::shells_of<2>(3.0, mixed_alpha_2d), 1.0, 3.0), Point<2>(0.7, 1.9));
  expect_gradients<3>(lattice_of<3>({Kernel::inverse_distance}, 0.5, 2.5), Point<3>(1.1, 3.2, 2.1));
}

TEST(PlaneWaves, AreFiniteWhereBranchesMeetOrHaveNoStiffness) {
  const auto finite = [](const auto& waves) {
    for (const auto& v : waves.group_velocity) EXPECT_TRUE(v.allFinite());
    EXPECT_TRUE(waves.polarisation.allFinite());
    EXPECT_LT((waves.polarisation.transpose() * waves.polarisation - decltype(waves.polarisation)::Identity())
                  .norm(),
              1e-13);
  };
  for (const double ratio : {1.0, 2.0, 3.0}) {
    const auto plane = lattice_of<2>({Kernel::constant}, 1.0, ratio);
    finite(plane_waves<2>(plane, Point<2>(pi, pi), Point<2>(1.0, 0.0)));  // P and S share their frequency
    finite(plane_waves<2>(plane, Point<2>(1.0, 1.0), Point<2>(1.0, 0.0)));
    const auto space = lattice_of<3>({Kernel::constant}, 1.0, ratio);
    finite(plane_waves<3>(space, Point<3>(1.0, 0.0, 0.0), Point<3>(1.0, 0.0, 0.0)));
    finite(plane_waves<3>(space, Point<3>(1.0, 1.0, 1.0), Point<3>(1.0, 0.0, 0.0)));
    finite(plane_waves<3>(space, Point<3>(pi, pi, pi), Point<3>(1.0, 0.0, 0.0)));
  }
  // m = 1 has no stiffness across an axis.
  const auto waves =
      plane_waves<2>(lattice_of<2>({Kernel::constant}, 1.0, 1.0), Point<2>(1.0, 0.0), Point<2>(1.0, 0.0));
  EXPECT_EQ(waves.angular_frequency[1], 0.0);
  EXPECT_EQ(waves.group_velocity[1].norm(), 0.0);
}

TEST(PlaneWaves, OfTheDiagonalOfACubeAreParallelAndAcross) {
  const auto lattice = lattice_of<3>({Kernel::constant}, 1.0, 3.0);
  const Point<3> d = Point<3>(1.0, 1.0, 1.0).normalized();
  for (const double k : {0.0, 0.8, 2.0}) {
    const auto waves = plane_waves<3>(lattice, k * d, d);
    EXPECT_LT((waves.polarisation.col(0) - d).norm(), 1e-12);
    EXPECT_NEAR(waves.squared[1], waves.squared[2], 1e-13 * std::max(waves.squared[0], 1e-30));
  }
}

TEST(PlaneWaves, OfAnUnstableLatticeHaveNoFrequency) {
  // 1D: omega^2 = sum_j alpha_j (1 - cos jk) 4/(m^2 j), m = 2, alpha 1, -4: at k = pi only the first counts
  // (2), at pi/2 the second turns it negative (1 - 4).
  const auto bar = lattice_of<1>(test::shells_of<1>(2.0, {1.0, -4.0}), 1.0, 2.0);
  const auto bad = plane_waves<1>(bar, Point<1>(0.5 * pi), Point<1>(1.0));
  expect_relative(bad.squared[0], 1.0 - 4.0, 1e-14);
  EXPECT_TRUE(std::isnan(bad.angular_frequency[0]));
  const auto good = plane_waves<1>(bar, Point<1>(pi), Point<1>(1.0));
  expect_relative(good.squared[0], 2.0, 1e-14);
  EXPECT_TRUE(std::isnan(plane_waves<1>(bar, Point<1>(0.0), Point<1>(1.0)).phase_velocity[0]));
}

// [bouaraquia2024], 1D, horizon 4 mm, m = 3: omega/v in 1/m at k = 500, 1000, 1500 1/m.
TEST(PlaneWaves, OfBarsWithAndWithoutTheEndFactor) {
  struct Row {
    Micromodulus kernel;
    double printed[3], corrected[3], continuum[3];
  };
  for (const Row& row : {Row{{Kernel::constant},
                             {516.8517432706, 751.7712835516, 751.0401484101},
                             {456.2122382536, 704.4559924061, 749.9344858948},
                             {460.2667750030, 725.3433193854, 780.5498667643}},
                         Row{{Kernel::gaussian, 1.0},
                             {491.3462006403, 768.3758463504, 844.2626191223},
                             {455.0614272103, 741.8235561020, 843.6904279148},
                             {466.7434683653, 768.9268189026, 884.6273273653}},
                         Row{{Kernel::gaussian, 2.0},
                             {463.1271377547, 820.0140532854, 1033.2208957645},
                             {458.3482868758, 816.8726604727, 1033.1609586887},
                             {481.4121559929, 866.4373643017, 1119.7172977711}}}) {
    const auto printed = lattice_of<1>(row.kernel, 0.004 / 3.0, 3.0);
    const auto corrected = lattice_of<1>(row.kernel, 0.004 / 3.0, 3.0, VolumeCorrection::linear);
    for (int i = 0; i < 3; ++i) {
      const Point<1> k(500.0 * (i + 1)), x(1.0);
      expect_relative(plane_waves<1>(printed, k, x).angular_frequency[0], row.printed[i], 1e-9);
      expect_relative(plane_waves<1>(corrected, k, x).angular_frequency[0], row.corrected[i], 1e-9);
      expect_relative(continuum_frequency(printed.medium, Branch::pressure, k[0]), row.continuum[i], 1e-9);
    }
  }
  for (const int m : {1, 2, 3, 5, 10}) {
    const Point<1> zero(0.0), x(1.0);
    const auto plain = lattice_of<1>({Kernel::constant}, 1.0, m);
    const auto corrected = lattice_of<1>({Kernel::constant}, 1.0, m, VolumeCorrection::linear);
    expect_relative(plane_waves<1>(plain, zero, x).phase_velocity[0], std::sqrt(1.0 + 1.0 / m), 1e-14);
    expect_relative(plane_waves<1>(corrected, zero, x).phase_velocity[0], 1.0, 1e-14);
  }
}

TEST(ZonePath, HoldsItsCornersAndSpreadsItsPoints) {
  const auto path = zone_path<2>(irreducible_contour<2>(), 0.5, 342);
  const double side = pi / 0.5;
  ASSERT_EQ(path.k.size(), 342U);
  ASSERT_EQ(path.corner.size(), 4U);
  EXPECT_EQ(path.corner.front(), 0);
  EXPECT_EQ(path.corner.back(), 341);
  expect_relative(path.length.back(), (2.0 + std::sqrt(2.0)) * side, 1e-14);
  EXPECT_LT((path.k[static_cast<std::size_t>(path.corner[1])] - Point<2>(side, 0.0)).norm(), 1e-14 * side);
  EXPECT_LT((path.k[static_cast<std::size_t>(path.corner[2])] - Point<2>(side, side)).norm(), 1e-14 * side);
  EXPECT_EQ(path.k.back().norm(), 0.0);
  const double mean = path.length.back() / 341.0;
  for (std::size_t i = 1; i < path.k.size(); ++i) {
    const double step = (path.k[i] - path.k[i - 1]).norm();
    expect_relative(step, mean, 0.02);  // sides take whole numbers of steps
    expect_relative(path.length[i] - path.length[i - 1], step, 1e-11);
  }
  EXPECT_EQ(zone_path<3>(irreducible_contour<3>(), 1.0, 5).corner, (std::vector<int>{0, 1, 2, 3, 4}));
  // A side a thousand times shorter than the other keeps a step of its own.
  const auto uneven = zone_path<1>({Point<1>(0.0), Point<1>(1.0), Point<1>(0.999)}, 1.0, 11);
  EXPECT_EQ(uneven.corner, (std::vector<int>{0, 9, 10}));
}

TEST(ZonePath, RefusesWhatIsNoPath) {
  EXPECT_THROW((void)zone_path<1>({Point<1>(0.0)}, 1.0, 10), Error);
  EXPECT_THROW((void)zone_path<1>({}, 1.0, 10), Error);
  EXPECT_THROW((void)zone_path<1>({Point<1>(0.0), Point<1>(1.0), Point<1>(1.0)}, 1.0, 10), Error);
  EXPECT_THROW((void)zone_path<2>(irreducible_contour<2>(), 1.0, 3), Error);
}

TEST(WavesAlong, AreTheWavesOfThePathForAnyNumberOfThreads) {
  const auto lattice = lattice_of<2>({Kernel::constant}, 1.0, 3.0);
  const auto path = zone_path<2>(irreducible_contour<2>(), 1.0, 100);
  const int before = threads();
  set_threads(1);
  const auto one = waves_along<2>(lattice, path);
  set_threads(4);
  const auto four = waves_along<2>(lattice, path);
  set_threads(before);
  ASSERT_EQ(one.size(), 100U);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].squared, four[i].squared);
    EXPECT_EQ(one[i].group_velocity[1], four[i].group_velocity[1]);
    EXPECT_EQ(one[i].k, path.k[i]);
  }
  // At both ends k = 0, approached from within: along the first side and back along the last.
  const double diagonal = std::sqrt(0.5);
  EXPECT_GT(one.front().group_velocity[0].dot(Point<2>(1.0, 0.0)), 0.9);
  EXPECT_GT(one.back().group_velocity[0].dot(Point<2>(diagonal, diagonal)), 0.9);
  EXPECT_LT((one.back().group_velocity[0] - one[98].group_velocity[0]).norm(), 0.05);
}

// [alebrahim2021]: on the contour's sides P and S are entries of the symbol, linear in the multipliers.
TEST(WavesAlong, BranchesOfTheContourAreEntriesOfTheSymbol) {
  const auto lattice = lattice_of<2>(test::shells_of<2>(3.0, mixed_alpha_2d), 1.0, 3.0);
  const auto path = zone_path<2>(irreducible_contour<2>(), 1.0, 200);
  const auto waves = waves_along<2>(lattice, path);
  for (std::size_t i = 1; i + 1 < waves.size(); ++i) {
    const auto m = lattice_symbol<2>(lattice.family, lattice.rates, path.k[i]);
    const bool diagonal = static_cast<int>(i) >= path.corner[2];
    const double p = m(0, 0) + (diagonal ? m(1, 0) : 0.0), s = m(1, 1) - (diagonal ? m(1, 0) : 0.0);
    EXPECT_NEAR(waves[i].squared[0], p, 1e-12 * m.norm());
    EXPECT_NEAR(waves[i].squared[1], s, 1e-12 * m.norm());
  }
}

TEST(WavesAround, AreThePlaneWavesOfTheirDirections) {
  const auto lattice = lattice_of<3>({Kernel::constant}, 1.0, 2.0);
  for (const double k : {0.0, 1.3}) {
    const auto waves = waves_around<3>(lattice, k, 12);
    ASSERT_EQ(waves.size(), 12U);
    for (int i = 0; i < 12; ++i) {
      const Point<3> d(std::cos(pi * i / 6.0), std::sin(pi * i / 6.0), 0.0);
      const auto own = plane_waves<3>(lattice, k * d, d);
      EXPECT_EQ(waves[static_cast<std::size_t>(i)].squared, own.squared);
      EXPECT_EQ(waves[static_cast<std::size_t>(i)].phase_velocity, own.phase_velocity);
    }
    // Four-fold symmetry.
    expect_relative(waves[3].phase_velocity[0], waves[0].phase_velocity[0], 1e-13);
    expect_relative(waves[4].phase_velocity[2], waves[1].phase_velocity[2], 1e-13);
  }
  EXPECT_EQ(waves_around<1>(lattice_of<1>({Kernel::constant}, 1.0, 2.0), 0.3, 90).size(), 1U);
  EXPECT_THROW((void)waves_around<3>(lattice, 1.0, 0), Error);
}

TEST(BranchName, OfEveryDimension) {
  EXPECT_EQ(branch_name(0, 1), "P");
  EXPECT_EQ(branch_name(1, 2), "S");
  EXPECT_EQ(branch_name(2, 3), "S2");
}

}  // namespace
}  // namespace perimode
