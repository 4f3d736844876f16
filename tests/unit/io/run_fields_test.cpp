// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/io/run_fields.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>

#include "perimode/dispersion/symbol.hpp"
#include "perimode/io/exodus.hpp"
#include "support/models.hpp"
#include "unit/io/temporary_folder.hpp"

namespace perimode {
namespace {

using std::numbers::pi;
using test::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;

const std::vector<Point<2>> to_x = {{0, 0}, {1, 0}};
const Where place = {"case.yaml", 7, 3};

Model plate() {
  Model m = test::box_model({8, 4}, 0.5, 2.0);
  m.periodic = {true, true, false};
  return m;
}

Particles<2> particles_of(const Model& m) {
  const auto& grid = std::get<GridSpec>(m.particles);
  return grid_particles<2>(make_grid<2>(grid.lower, grid.upper, grid.spacing), 1.0);
}

/// A run in which the wave of two lengths per period along x turns with omega, at these times.
void write_run(const TemporaryFolder& folder, const std::vector<double>& times, double omega = 1.0,
               const std::string& name = "displacement") {
  const Particles<2> particles = particles_of(plate());
  ExodusWriter writer(folder.path() / "fields.exo", exodus_mesh(particles), {},
                      {name + "_x", name + "_y", name + "_z"});
  for (const double t : times) {
    const Eigen::VectorXd u =
        plane_wave<2>(particles.position, Point<2>(2.0 * pi * 2 / 4.0, 0.0), Point<2>(1.0, 0.25), -omega * t);
    writer.write({t, {}, three_components({u.data(), static_cast<std::size_t>(u.size())}, 2)});
  }
  writer.close();
}

std::vector<double> every(double step, int count) {
  std::vector<double> times;
  times.reserve(static_cast<std::size_t>(count));
  for (int n = 0; n < count; ++n) times.push_back(step * n);
  return times;
}

std::string complaint(const std::filesystem::path& folder, const Model& model,
                      const std::vector<Point<2>>& corners = to_x) {
  try {
    (void)record_run<2>(folder, model, corners, place);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
    return error.what();
  }
  return "no error";
}

TEST(RecordRun, FindsTheWaveThatRan) {
  const TemporaryFolder folder;
  const double step = 0.05, bin = 2.0 * pi / (100 * step), omega = 17.4 * bin;
  std::vector<double> times = every(step, 100);
  times.push_back(99.3 * step);  // the end of a run comes out of turn
  write_run(folder, times, omega);
  const WaveRecorder<2> record = record_run<2>(folder.path(), plate(), to_x);
  EXPECT_EQ(record.frames(), 100U);
  ASSERT_EQ(record.waves().k.size(), 5U);
  const Spectrum along = wave_spectrum(record, std::vector<Point<2>>(5, Point<2>(1, 0)));
  const Spectrum across = wave_spectrum(record, std::vector<Point<2>>(5, Point<2>(0, 1)));
  EXPECT_NEAR(spectrum_ridge(along)[2].omega, omega, 4.0 / std::pow(100.0, 4) * bin);
  EXPECT_NEAR(across.amplitude(2, 17) / along.amplitude(2, 17), 0.25, 1e-12);
  EXPECT_NEAR(along.resolution, bin, 1e-12);
}

TEST(RecordRun, EveryFrameComesWithItsTime) {
  const TemporaryFolder folder;
  write_run(folder, {0.0, 0.3, 0.4});
  std::vector<double> times;
  for_each_run_frame<2>(folder.path(), particles_of(plate()), place, [&](double t, const Eigen::VectorXd& u) {
    times.push_back(t);
    ASSERT_EQ(u.size(), 64);
    EXPECT_NEAR(u[1], 0.25 * u[0], 1e-15);
    EXPECT_NEAR(u[0], std::cos(pi * 0.25 - t), 1e-14);  // first particle at x = 0.25, k = pi
  });
  EXPECT_EQ(times, (std::vector<double>{0.0, 0.3, 0.4}));
}

TEST(RecordRun, SaysWhatTheRunLacks) {
  const TemporaryFolder folder;
  EXPECT_THAT(complaint(folder.path() / "none", plate()),
              AllOf(HasSubstr("case.yaml:7:3"), HasSubstr("no folder"), HasSubstr("perimode transient")));
  EXPECT_THAT(complaint(folder.path(), plate()), HasSubstr("expected fields.exo in the result folder"));
  std::ofstream(folder.path() / "fields.exo") << "no Exodus file";
  EXPECT_THAT(complaint(folder.path(), plate()), HasSubstr("an Exodus file that can be read"));
  write_run(folder, every(0.1, 3));
  EXPECT_THAT(complaint(folder.path(), plate()),
              AllOf(HasSubstr("4 steps or more"), HasSubstr("fields_every")));
  write_run(folder, {0.0, 0.1, 0.2, 0.35, 0.45});
  EXPECT_THAT(complaint(folder.path(), plate()), HasSubstr("got step 4 at 3.5"));
  write_run(folder, {0.0, 0.1, 0.2, 0.3, 0.7});
  EXPECT_THAT(complaint(folder.path(), plate()), HasSubstr("got step 5 at 7.0"));
  write_run(folder, every(0.1, 6), 1.0, "velocity");
  EXPECT_THAT(complaint(folder.path(), plate()), HasSubstr("no variable displacement_x"));
}

TEST(RecordRun, RefusesAnotherBody) {
  const TemporaryFolder folder;
  write_run(folder, every(0.1, 6));
  EXPECT_EQ(complaint(folder.path(), plate()), "no error");
  Model larger = plate();
  std::get<GridSpec>(larger.particles).upper[1] = 2.5;
  EXPECT_THAT(complaint(folder.path(), larger),
              AllOf(HasSubstr("40 particles of this body"), HasSubstr("got 32 particles")));
  Model moved = plate();
  std::get<GridSpec>(moved.particles).lower[0] = 0.5;
  std::get<GridSpec>(moved.particles).upper[0] = 4.5;
  EXPECT_THAT(complaint(folder.path(), moved), HasSubstr("particle 1 has x = 0.75"));
  Model walled = plate();
  walled.periodic[1] = false;
  EXPECT_THAT(complaint(folder.path(), walled), HasSubstr("y not periodic"));
  Model holed = plate();
  std::get<GridSpec>(holed.particles).remove = {Region{}};
  EXPECT_THAT(complaint(folder.path(), holed), HasSubstr("cells removed"));
  Model cloud = plate();
  cloud.particles = CloudSpec{};
  EXPECT_THAT(complaint(folder.path(), cloud), HasSubstr("a cloud"));
  Model bar = test::box_model({8}, 0.5, 2.0);
  EXPECT_THAT(complaint(folder.path(), bar), HasSubstr("dimension 2"));
  EXPECT_THAT(complaint(folder.path(), plate(), {{0, 0}}),
              AllOf(HasSubstr("case.yaml:7:3"), HasSubstr("two corners")));
}

}  // namespace
}  // namespace perimode
