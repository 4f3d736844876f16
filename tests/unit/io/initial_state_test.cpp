// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/io/initial_state.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "perimode/geometry/grid.hpp"
#include "perimode/io/exodus.hpp"
#include "unit/io/temporary_folder.hpp"

namespace perimode {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;

/// 3 x 2 particles at x = 0.5, 1.5, 2.5 and y = 0.5, 1.5.
Particles<2> six() { return grid_particles<2>(make_grid<2>({0, 0}, {3, 2}, 1.0, {}), 1.0); }

/// A modes.exo of these particles with two modes, the values 1, 2, 3, ... and their negatives.
std::filesystem::path modes_of(const Particles<2>& particles, const TemporaryFolder& folder) {
  auto file = folder.path() / "modes.exo";
  ExodusWriter writer(file, exodus_mesh(particles), {"frequency_hz"},
                      {"displacement_x", "displacement_y", "displacement_z"});
  std::vector<double> shape(static_cast<std::size_t>(particles.count()) * 2);
  for (std::size_t k = 0; k < shape.size(); ++k) shape[k] = static_cast<double>(k) + 1.0;
  writer.write({1.0, {10.0}, three_components(shape, 2)});
  for (double& value : shape) value = -value;
  writer.write({2.0, {20.0}, three_components(shape, 2)});
  writer.close();
  return file;
}

template <int Dim>
std::string complaint(const InitialSpec& spec, const Particles<Dim>& particles) {
  try {
    (void)initial_state<Dim>(spec, particles);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
    return error.what();
  }
  return "no error";
}

TEST(InitialStateTest, NothingGivenIsEmpty) {
  const InitialState state = initial_state<2>({}, six());
  EXPECT_EQ(state.displacement.size(), 0);
  EXPECT_EQ(state.velocity.size(), 0);
}

TEST(InitialStateTest, FormulasAtTheParticles) {
  const InitialSpec spec{FormulaField{{Expression("x + 10*y"), Expression("-2")}}, {}, {}};
  const Particles<2> particles = six();
  const InitialState state = initial_state<2>(spec, particles);
  ASSERT_EQ(state.displacement.size(), 12);
  for (Index i = 0; i < particles.count(); ++i) {
    const Point<2>& p = particles.position[static_cast<std::size_t>(i)];
    EXPECT_EQ(state.displacement[2 * i], p[0] + 10.0 * p[1]);
    EXPECT_EQ(state.displacement[2 * i + 1], -2.0);
  }
  EXPECT_EQ(state.velocity.size(), 0);
}

TEST(InitialStateTest, FormulasInOneAndThreeDimensions) {
  const auto bar = grid_particles<1>(make_grid<1>({0}, {2}, 1.0, {}), 1.0);
  EXPECT_EQ(initial_state<1>({{}, FormulaField{{Expression("3*x")}}, {}}, bar).velocity[1], 4.5);
  const auto solid = grid_particles<3>(make_grid<3>({0, 0, 0}, {1, 1, 2}, 1.0, {}), 1.0);
  const FormulaField field{{Expression("x"), Expression("0"), Expression("z")}};
  EXPECT_EQ(initial_state<3>({field, {}, {}}, solid).displacement[5], solid.position[1][2]);
}

TEST(InitialStateTest, AFormulaWithoutAValueNamesThePlace) {
  const InitialSpec spec{
      FormulaField{{Expression("1/(x-1.5)", {"case.yaml", 7, 5}), Expression("0")}}, {}, {}};
  EXPECT_THAT(complaint(spec, six()), HasSubstr("case.yaml:7:5: expected a formula with finite values"));
  EXPECT_THAT(complaint(spec, six()), HasSubstr("x = 1.5"));
}

TEST(InitialStateTest, TableLineByLine) {
  const TemporaryFolder folder;
  const auto file = folder.write("u0.csv", "x,y\n1,2\n3,4\n5,6\n7,8\n9,10\n11,-12.5\n");
  const InitialState state = initial_state<2>({{}, TableField{file}, {}}, six());
  ASSERT_EQ(state.velocity.size(), 12);
  for (int k = 0; k < 11; ++k) EXPECT_EQ(state.velocity[k], k + 1.0);
  EXPECT_EQ(state.velocity[11], -12.5);
}

TEST(InitialStateTest, ATableThatDoesNotFit) {
  const TemporaryFolder folder;
  const auto about = [&](const char* text) {
    return complaint({TableField{folder.write("u0.csv", text)}, {}, {}}, six());
  };
  EXPECT_THAT(about("x,y\n1,2\n3,4\n"), HasSubstr("u0.csv:3:1: expected 6 lines of numbers"));
  EXPECT_THAT(about("x,y,z\n1,2,3\n"), HasSubstr("u0.csv:1:1: expected the header x,y, got 'x,y,z'"));
  EXPECT_THAT(about("x,y\n1,a\n"), HasSubstr("u0.csv:2:3: expected a finite number for y, got 'a'"));
  EXPECT_THAT(about(""), HasSubstr("u0.csv:1:1: expected the header x,y"));
}

TEST(InitialStateTest, AModeTimesItsScale) {
  const TemporaryFolder folder;
  const Particles<2> particles = six();
  const auto file = modes_of(particles, folder);
  const InitialState state =
      initial_state<2>({ModeField{file, 1, 0.5}, ModeField{file, 2, 2.0}, {}}, particles);
  ASSERT_EQ(state.displacement.size(), 12);
  for (int k = 0; k < 12; ++k) {
    EXPECT_EQ(state.displacement[k], 0.5 * (k + 1.0));
    EXPECT_EQ(state.velocity[k], -2.0 * (k + 1.0));
  }
}

TEST(InitialStateTest, AModeThatDoesNotFit) {
  const TemporaryFolder folder;
  const auto file = modes_of(six(), folder);
  const auto about = [&](const ModeField& field, const Particles<2>& particles) {
    return complaint({field, {}, {"case.yaml", 9, 3}}, particles);
  };
  EXPECT_THAT(about({file, 3, 1.0}, six()), HasSubstr("case.yaml:9:3: expected a mode from 1 to 2, got 3"));
  const auto more = grid_particles<2>(make_grid<2>({0, 0}, {3, 3}, 1.0, {}), 1.0);
  EXPECT_THAT(about({file, 1, 1.0}, more), HasSubstr("the 9 particles of this body, got 6 particles"));
  const auto shifted = grid_particles<2>(make_grid<2>({1, 0}, {4, 2}, 1.0, {}), 1.0);
  EXPECT_THAT(about({file, 1, 1.0}, shifted), HasSubstr("whose particle 1 has x = 1.5 m, got 0.5 m"));
  const auto text = folder.write("text.exo", "no Exodus file");
  EXPECT_THAT(about({text, 1, 1.0}, six()), HasSubstr("an Exodus file that can be read"));

  const auto other = folder.path() / "fields.exo";
  ExodusWriter writer(other, exodus_mesh(six()), {}, {"damage"});
  writer.write({0.0, {}, {std::vector<double>(6, 0.0)}});
  writer.close();
  EXPECT_THAT(about({other, 1, 1.0}, six()), HasSubstr("no variable displacement_x"));
}

}  // namespace
}  // namespace perimode
