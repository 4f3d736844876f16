// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/io/exodus.hpp"

#include <exodusII.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "perimode/core/error.hpp"
#include "unit/io/temporary_folder.hpp"

namespace perimode {
namespace {

using test::TemporaryFolder;
using testing::ElementsAre;

/// Three particles of a plate, the middle one in a block of its own; two modes.
Particles<2> plate() {
  Particles<2> particles;
  particles.position = {{0.0, 0.5}, {1.0, 0.5}, {2.0, 0.5}};
  particles.volume = {1, 1, 1};
  particles.block = {0, 2, 0};
  particles.block_names = {"", "unused", "an inclusion with a rather long name"};
  return particles;
}

void write_modes(const std::filesystem::path& file, const std::string& title = "plate") {
  ExodusMesh mesh = exodus_mesh(plate());
  mesh.title = title;
  mesh.info = {"perimode 0.1.0", std::string(100, 'i')};
  ExodusWriter writer(file, mesh, {"frequency_hz"}, {"displacement_x", "displacement_y", "displacement_z"});
  const std::vector<double> first = {1, 2, 3, 4, 5, 6};
  const std::vector<double> second = {-1, -2, -3, -4, -5, -6};
  writer.write({1.0, {2509.5}, three_components(first, 2)});
  writer.write({2.0, {5023.5}, three_components(second, 2)});
  writer.close();
}

class OpenExodus {
 public:
  explicit OpenExodus(const std::filesystem::path& file) {
    int word = sizeof(double);
    int stored = 0;
    float version = 0;
    id = ex_open(file.c_str(), EX_READ, &word, &stored, &version);
    EXPECT_GE(id, 0);
    EXPECT_EQ(stored, 8);
    (void)ex_set_max_name_length(id, 255);
  }
  ~OpenExodus() { (void)ex_close(id); }
  OpenExodus(const OpenExodus&) = delete;
  OpenExodus& operator=(const OpenExodus&) = delete;
  int id = -1;
};

TEST(Exodus, MeshReadsBack) {
  const TemporaryFolder folder;
  write_modes(folder.path() / "modes.exo");
  const OpenExodus file(folder.path() / "modes.exo");
  ex_init_params init = {};
  ASSERT_EQ(ex_get_init_ext(file.id, &init), 0);
  EXPECT_STREQ(init.title, "plate");
  EXPECT_EQ(init.num_dim, 3);
  EXPECT_EQ(init.num_nodes, 3);
  EXPECT_EQ(init.num_elem, 3);
  EXPECT_EQ(init.num_elem_blk, 2);
  std::vector<double> x(3), y(3), z(3);
  ASSERT_EQ(ex_get_coord(file.id, x.data(), y.data(), z.data()), 0);
  EXPECT_THAT(x, ElementsAre(0, 1, 2));
  EXPECT_THAT(y, ElementsAre(0.5, 0.5, 0.5));
  EXPECT_THAT(z, ElementsAre(0, 0, 0));
}

TEST(Exodus, BlocksAreSpheresAndEmptyOnesAreLeftOut) {
  const TemporaryFolder folder;
  write_modes(folder.path() / "modes.exo");
  const OpenExodus file(folder.path() / "modes.exo");
  std::vector<char> name(256), type(256);
  ASSERT_EQ(ex_get_name(file.id, EX_ELEM_BLOCK, 1, name.data()), 0);
  EXPECT_STREQ(name.data(), "body");
  ASSERT_EQ(ex_get_name(file.id, EX_ELEM_BLOCK, 2, name.data()), 0);
  EXPECT_STREQ(name.data(), "an inclusion with a rather long name");
  ex_block block = {};
  block.type = EX_ELEM_BLOCK;
  block.id = 1;
  ASSERT_EQ(ex_get_block_param(file.id, &block), 0);
  EXPECT_STREQ(block.topology, "SPHERE");
  std::vector<int> nodes(2);
  ASSERT_EQ(block.num_entry, 2);
  ASSERT_EQ(ex_get_conn(file.id, EX_ELEM_BLOCK, 1, nodes.data(), nullptr, nullptr), 0);
  EXPECT_THAT(nodes, ElementsAre(1, 3));
}

TEST(Exodus, StepsReadBackWithTimesGlobalsAndVectors) {
  const TemporaryFolder folder;
  write_modes(folder.path() / "modes.exo");
  const OpenExodus file(folder.path() / "modes.exo");
  ASSERT_EQ(ex_inquire_int(file.id, EX_INQ_TIME), 2);
  double time = 0.0;
  ASSERT_EQ(ex_get_time(file.id, 2, &time), 0);
  EXPECT_EQ(time, 2.0);
  double frequency = 0.0;
  ASSERT_EQ(ex_get_var(file.id, 2, EX_GLOBAL, 1, 1, 1, &frequency), 0);
  EXPECT_EQ(frequency, 5023.5);
  std::vector<double> u(3);
  ASSERT_EQ(ex_get_var(file.id, 1, EX_NODAL, 2, 1, 3, u.data()), 0);
  EXPECT_THAT(u, ElementsAre(2, 4, 6));
  ASSERT_EQ(ex_get_var(file.id, 2, EX_NODAL, 1, 1, 3, u.data()), 0);
  EXPECT_THAT(u, ElementsAre(-1, -3, -5));
  ASSERT_EQ(ex_get_var(file.id, 2, EX_NODAL, 3, 1, 3, u.data()), 0);
  EXPECT_THAT(u, ElementsAre(0, 0, 0));
  std::vector<char> name(256);
  ASSERT_EQ(ex_get_variable_name(file.id, EX_NODAL, 3, name.data()), 0);
  EXPECT_STREQ(name.data(), "displacement_z");
}

TEST(Exodus, GoesOnAfterAStepAndWritesOverLaterOnes) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "modes.exo";
  write_modes(file);
  const std::string whole = test::content(file);
  const std::vector<double> second = {-1, -2, -3, -4, -5, -6};
  {
    ExodusWriter writer(file, 1);
    writer.write({9.0, {1.0}, three_components(std::vector<double>(6, 7.0), 2)});
    writer.sync();
    writer.close();
  }
  EXPECT_NE(test::content(file), whole);
  {
    ExodusWriter writer(file, 1);
    writer.write({2.0, {5023.5}, three_components(second, 2)});
    writer.close();
  }
  EXPECT_EQ(test::content(file), whole);
  EXPECT_THROW(ExodusWriter(file, 3), Error);
  EXPECT_THROW(ExodusWriter(folder.write("text.exo", "no Exodus file"), 1), Error);
}

TEST(Exodus, LongTitlesAndInformationAreCut) {
  const TemporaryFolder folder;
  write_modes(folder.path() / "modes.exo", std::string(200, 't'));
  const OpenExodus file(folder.path() / "modes.exo");
  ex_init_params init = {};
  ASSERT_EQ(ex_get_init_ext(file.id, &init), 0);
  EXPECT_EQ(std::string(init.title), std::string(MAX_LINE_LENGTH, 't'));
  EXPECT_EQ(ex_inquire_int(file.id, EX_INQ_INFO), 2);
}

TEST(Exodus, FileIsClassicNetcdfWithLargeOffsets) {
  const TemporaryFolder folder;
  write_modes(folder.path() / "modes.exo");
  EXPECT_EQ(test::content(folder.path() / "modes.exo").substr(0, 4), std::string("CDF\x02"));
}

TEST(Exodus, BarAndSolidHaveThreeCoordinates) {
  Particles<1> bar;
  bar.position.push_back(Point<1>(0.25));
  bar.block = {0};
  const ExodusMesh line = exodus_mesh(bar);
  EXPECT_THAT(line.x, ElementsAre(0.25));
  EXPECT_THAT(line.y, ElementsAre(0.0));
  EXPECT_THAT(line.z, ElementsAre(0.0));
  Particles<3> solid;
  solid.position.push_back({1, 2, 3});
  solid.block = {0};
  EXPECT_THAT(exodus_mesh(solid).z, ElementsAre(3.0));
}

TEST(Exodus, FolderThatIsNotThereIsAnErrorOfTheEnvironment) {
  try {
    const ExodusWriter writer("/nowhere/modes.exo", exodus_mesh(plate()), {}, {});
    FAIL() << "written without an error";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::environment);
  }
}

}  // namespace
}  // namespace perimode
