// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/dispersion/wave_record.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "perimode/core/error.hpp"
#include "perimode/dispersion/symbol.hpp"
#include "perimode/geometry/particles.hpp"

namespace perimode {
namespace {

using std::numbers::pi;
using testing::HasSubstr;

constexpr double dx = 0.5;

template <int Dim>
Particles<Dim> box(const std::array<int, Dim>& cells) {
  Coordinates lower, upper;
  for (const int n : cells) {
    lower.push_back(-1.0);
    upper.push_back(-1.0 + n * dx);
  }
  return grid_particles<Dim>(make_grid<Dim>(lower, upper, dx), 1.0);
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

std::span<const double> span_of(const Eigen::VectorXd& u) {
  return {u.data(), static_cast<std::size_t>(u.size())};
}

TEST(WavesOnPath, AreAllThatFitTheContourOfASquare) {
  const Particles<2> plate = box<2>({8, 8});
  const GridWaves<2> waves = waves_on_path<2>(*plate.grid, {{0, 0}, {1, 0}, {1, 1}, {0, 0}});
  const std::vector<std::array<Index, 2>> expected = {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {4, 1}, {4, 2},
                                                      {4, 3}, {4, 4}, {3, 3}, {2, 2}, {1, 1}, {0, 0}};
  EXPECT_EQ(waves.number, expected);
  for (std::size_t w = 0; w < expected.size(); ++w) {
    const Point<2> k(2.0 * pi * expected[w][0] / (8 * dx), 2.0 * pi * expected[w][1] / (8 * dx));
    EXPECT_NEAR((waves.k[w] - k).norm(), 0.0, 1e-13);
    EXPECT_NEAR(waves.direction[w].norm(), 1.0, 1e-14);
    if (k.norm() > 0.0) {
      EXPECT_NEAR(waves.direction[w].dot(k), k.norm(), 1e-13);
    }
    if (w > 0) {
      const double apart = (waves.k[w] - waves.k[w - 1]).norm();
      EXPECT_NEAR(waves.length[w] - waves.length[w - 1], apart, 1e-12);
    }
  }
  EXPECT_NEAR((waves.direction.front() - Point<2>(1, 0)).norm(), 0.0, 1e-14);
  EXPECT_NEAR(std::abs(waves.direction.back().dot(Point<2>(1, 1).normalized())), 1.0, 1e-14);
}

TEST(WavesOnPath, LeavesOutWhatDoesNotFit) {
  // 9 cells: pi/dx is 4.5 waves; along the diagonal of 9 x 6 cells only every third of 4.5 and second
  // of 3.
  const GridWaves<1> bar = waves_on_path<1>(*box<1>({9}).grid, {Point<1>(0.0), Point<1>(1.0)});
  EXPECT_EQ(bar.number, (std::vector<std::array<Index, 1>>{{0}, {1}, {2}, {3}, {4}}));
  EXPECT_NEAR(bar.length.back(), bar.k.back()[0], 1e-13);
  const GridWaves<2> plate = waves_on_path<2>(*box<2>({9, 6}).grid, {{0, 0}, {1, 1}});
  EXPECT_EQ(plate.number, (std::vector<std::array<Index, 2>>{{0, 0}, {3, 2}}));
  const GridWaves<1> back = waves_on_path<1>(*box<1>({8}).grid, {Point<1>(0.9), Point<1>(-0.6)});
  EXPECT_EQ(back.number, (std::vector<std::array<Index, 1>>{{3}, {2}, {1}, {0}, {-1}, {-2}}));
  EXPECT_NEAR(back.length.front(), 0.15 * pi / dx, 1e-13);  // from 0.9 to 0.75
}

TEST(WavesOnPath, RefusesWhatIsNoPath) {
  const Grid<1> bar = *box<1>({8}).grid;
  EXPECT_THAT(complaint([&] { (void)waves_on_path<1>(bar, {Point<1>(1.0)}); }),
              HasSubstr("two corners or more"));
  EXPECT_THAT(complaint([&] {
                (void)waves_on_path<1>(bar, {Point<1>(1.0), Point<1>(1.0)});
              }),
              HasSubstr("corner 1 twice"));
  EXPECT_THAT(complaint([&] {
                (void)waves_on_path<1>(bar, {Point<1>(0.1), Point<1>(0.3)});
              }),
              HasSubstr("got 1 of them"));
}

template <int Dim>
void expect_sums(const std::array<int, Dim>& cells, const std::vector<std::array<Index, Dim>>& numbers) {
  const Particles<Dim> body = box<Dim>(cells);
  GridWaves<Dim> waves;
  for (const auto& q : numbers) {
    Point<Dim> k;
    for (int a = 0; a < Dim; ++a) k[a] = 2.0 * pi * q[a] / (cells[a] * dx);
    waves.number.push_back(q);
    waves.k.push_back(k);
    waves.direction.push_back(Point<Dim>::Unit(0));
    waves.length.push_back(k.norm());
  }
  WaveRecorder<Dim> record(*body.grid, waves, 2);
  std::mt19937 gen(7);
  for (int frame = 0; frame < 2; ++frame) {
    Eigen::VectorXd u(body.count() * Dim);
    for (double& value : u) value = static_cast<double>(gen()) / 4294967296.0 - 0.5;
    record.add(0.1 * frame, span_of(u));
    for (std::size_t w = 0; w < numbers.size(); ++w) {
      Eigen::Matrix<std::complex<double>, Dim, 1> sum = Eigen::Matrix<std::complex<double>, Dim, 1>::Zero();
      for (Index i = 0; i < body.count(); ++i) {
        const double phase = waves.k[w].dot(body.position[static_cast<std::size_t>(i)] - body.position[0]);
        sum +=
            std::polar(1.0, -phase) * u.template segment<Dim>(Dim * i).template cast<std::complex<double>>();
      }
      sum /= body.count();
      EXPECT_LE((record.amplitude(frame, w) - sum).norm(), 1e-14) << Dim << "D, wave " << w;
    }
  }
}

TEST(WaveRecorder, HoldsTheSumsOfItsDefinition) {
  expect_sums<1>({9}, {{0}, {1}, {4}, {-3}, {5}, {13}});
  expect_sums<1>({8}, {{4}, {-4}, {8}});
  expect_sums<2>({6, 5}, {{0, 0}, {3, 2}, {2, -2}, {-1, 4}, {5, 1}, {-3, -7}});
  expect_sums<3>({4, 3, 5}, {{0, 0, 0}, {1, 1, 1}, {2, -1, 2}, {-1, 2, 4}, {3, 1, -2}});
}

TEST(WaveSpectrum, TellsPFromSAndOneWaveFromAnother) {
  const Particles<2> plate = box<2>({12, 12});
  const GridWaves<2> waves = waves_on_path<2>(*plate.grid, {{0, 0}, {1, 1}});
  const Point<2> along = Point<2>(1, 1).normalized(), across = Point<2>(-1, 1).normalized();
  const int instants = 128;
  const double off_grid = 4.0 / std::pow(128.0, 4);  // sums where integrals would be
  const double step = 0.1, bin = 2.0 * pi / (instants * step);
  WaveRecorder<2> record(*plate.grid, waves);
  for (int n = 0; n < instants; ++n) {
    const double t = step * n;
    const Eigen::VectorXd u =
        plane_wave<2>(plate.position, waves.k[3], along * 2.0, -30.4 * bin * t) +
        plane_wave<2>(plate.position, waves.k[3], across * 0.5, -15.7 * bin * t) +
        plane_wave<2>(plate.position, waves.k[5], across, 22.2 * bin * t) +
        plane_wave<2>(plate.position, Point<2>(waves.k[3][0], 0.0), Point<2>(3.0, 3.0), -40.0 * bin * t);
    record.add(t, span_of(u));
  }
  EXPECT_EQ(record.frames(), 128U);
  EXPECT_NEAR(record.time_step(), step, 1e-15);
  const std::vector<Point<2>> p(waves.k.size(), along), s(waves.k.size(), across);
  const auto pressure = spectrum_ridge(wave_spectrum(record, p)),
             shear = spectrum_ridge(wave_spectrum(record, s));
  EXPECT_NEAR(pressure[3].omega / bin, 30.4, off_grid);
  EXPECT_NEAR(shear[3].omega / bin, 15.7, off_grid);
  EXPECT_NEAR(shear[5].omega / bin, 22.2, off_grid);
  EXPECT_NEAR(pressure[3].k, waves.k[3].norm(), 1e-12);
  for (std::size_t w = 0; w < waves.k.size(); ++w) {  // the wave (k, 0) that is not on the path shows nowhere
    EXPECT_EQ(std::isnan(pressure[w].omega), w != 3);
    EXPECT_EQ(std::isnan(shear[w].omega), w != 3 && w != 5);
  }
  EXPECT_EQ(spectrum_peaks(wave_spectrum(record, p), 0.03).size(), 1U);
}

TEST(WaveRecorder, RefusesFramesThatDoNotFit) {
  const Particles<1> bar = box<1>({8});
  const GridWaves<1> waves = waves_on_path<1>(*bar.grid, {Point<1>(0.0), Point<1>(1.0)});
  EXPECT_THROW((WaveRecorder<1>(*bar.grid, GridWaves<1>{})), Error);
  WaveRecorder<1> record(*bar.grid, waves);
  EXPECT_EQ(record.time_step(), 0.0);
  Eigen::VectorXd u = Eigen::VectorXd::Ones(8);
  record.add(0.5, span_of(u));
  EXPECT_THAT(complaint([&] { record.add(0.5, span_of(u)); }), HasSubstr("a later frame"));
  record.add(0.6, span_of(u));
  EXPECT_THAT(complaint([&] { record.add(0.8, span_of(u)); }), HasSubstr("frames every 1.0"));
  EXPECT_THAT(complaint([&] { record.add(0.7, {u.data(), 7}); }), HasSubstr("displacements of 8 cells"));
  u[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(complaint([&] { record.add(0.7, span_of(u)); }), HasSubstr("displacements that are none"));
  u[3] = 1.0;
  const std::vector<Point<1>> x(waves.k.size(), Point<1>(1.0));
  record.add(0.7, span_of(u));
  EXPECT_THAT(complaint([&] { (void)wave_spectrum(record, x); }), HasSubstr("4 instants or more"));
  record.add(0.8, span_of(u));
  EXPECT_EQ(wave_spectrum(record, x).instants, 4);
  EXPECT_THAT(complaint([&] { (void)wave_spectrum<1>(record, {Point<1>(1.0)}); }), HasSubstr("one per wave"));
}

}  // namespace
}  // namespace perimode
