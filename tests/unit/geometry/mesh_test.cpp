// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/geometry/mesh.hpp"

#include <exodusII.h>
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <numeric>

#include "perimode/core/error.hpp"

namespace perimode {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pointwise;

/// A unit cube as six tetrahedra about its diagonal, in two physical groups, with its surface partly meshed.
const std::string cube_41 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
2
2 7 "skin"
3 5 "soft half"
$EndPhysicalNames
$Entities
0 0 1 2
3 0 0 0 1 1 0 1 7 0
10 0 0 0 1 1 1 2 5 9 0
11 0 0 0 1 1 1 0 0
$EndEntities
$Nodes
2 8 1 108
0 1 0 1
101
0 0 0
3 10 0 7
102
103
104
105
106
107
108
1 0 0
1 1 0
0 1 0
0 0 1
1 0 1
1 1 1
0 1 1
$EndNodes
$Elements
3 7 1 9
2 3 2 1
1 101 102 103
3 10 4 3
2 101 102 103 107
3 101 103 104 107
4 101 104 108 107
3 11 4 3
5 101 108 105 107
6 101 105 106 107
9 101 106 102 107
$EndElements
)";

/// Two triangles and a square of a 2 m x 1 m plate, with an edge, in Windows lines.
const std::string plate_22 =
    "$MeshFormat\r\n2.2 0 8\r\n$EndMeshFormat\r\n$PhysicalNames\r\n1\r\n2 3 \"left\"\r\n$EndPhysicalNames\r\n"
    "$Nodes\r\n6\r\n1 0 0 0\r\n2 1 0 0\r\n3 2 0 0\r\n4 0 1 0\r\n5 1 1 0\r\n6 2 1 0\r\n$EndNodes\r\n"
    "$Elements\r\n4\r\n1 1 2 0 1 1 2\r\n2 2 2 3 1 1 2 5\r\n3 2 2 3 1 1 5 4\r\n4 3 2 4 1 2 3 6 "
    "5\r\n$EndElements\r\n"
    "$NodeData\r\n1\r\n\"x\"\r\n$EndNodeData\r\n";

double sum(const std::vector<double>& v) { return std::accumulate(v.begin(), v.end(), 0.0); }

TEST(Mesh, TetrahedraOfFormat41) {
  const CloudData cloud = read_msh_text(cube_41, "cube.msh", 3, 1.0);
  ASSERT_EQ(cloud.count(), 6U);
  EXPECT_THAT(cloud.volume, testing::Each(DoubleNear(1.0 / 6.0, 1e-15)));
  EXPECT_THAT(std::vector(cloud.position.begin(), cloud.position.begin() + 3),
              Pointwise(DoubleNear(1e-15), {0.75, 0.5, 0.25}));
  EXPECT_THAT(cloud.block, ElementsAre("soft half", "soft half", "soft half", "", "", ""));
}

TEST(Mesh, TrianglesAndQuadrilateralsOfFormat22) {
  const CloudData cloud = read_msh_text(plate_22, "plate.msh", 2, 0.1);
  ASSERT_EQ(cloud.count(), 3U);
  EXPECT_THAT(cloud.volume, Pointwise(DoubleNear(1e-16), {0.05, 0.05, 0.1}));
  EXPECT_THAT(cloud.position, Pointwise(DoubleNear(1e-15), {2.0 / 3, 1.0 / 3, 1.0 / 3, 2.0 / 3, 1.5, 0.5}));
  EXPECT_THAT(cloud.block, ElementsAre("left", "left", "physical_4"));
}

/// One hexahedron of given corners, whose numbers are sparse and unsorted.
std::string hexahedron(const std::array<std::array<double, 3>, 8>& x) {
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n8\n";
  for (int c = 7; c >= 0; --c) {
    const auto& [x1, x2, x3] = x[static_cast<std::size_t>(c)];
    text += fmt::format("{} {} {} {}\n", 1000 * c + 1, x1, x2, x3);
  }
  text += "$EndNodes\n$Elements\n1\n77 5 0";
  for (int c = 0; c < 8; ++c) text += fmt::format(" {}", 1000 * c + 1);
  return text + "\n$EndElements\n";
}

TEST(Mesh, AFrustumHasItsVolumeAndCentroid) {
  // Squares of side 2 and 1 at z = 0 and 3: V = h (A + sqrt(A B) + B) / 3, centroid h (A + 2 sqrt(AB) + 3 B)
  // / 4 over (A + sqrt(AB) + B).
  const CloudData cloud = read_msh_text(hexahedron({{{-1, -1, 0},
                                                     {1, -1, 0},
                                                     {1, 1, 0},
                                                     {-1, 1, 0},
                                                     {-0.5, -0.5, 3},
                                                     {0.5, -0.5, 3},
                                                     {0.5, 0.5, 3},
                                                     {-0.5, 0.5, 3}}}),
                                        "frustum.msh", 3, 1.0);
  EXPECT_NEAR(cloud.volume[0], 7.0, 1e-14);
  EXPECT_THAT(cloud.position, Pointwise(DoubleNear(1e-14), {0.0, 0.0, 3.0 * 11.0 / 28.0}));
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

void expect_error(const std::string& text, int dimension, const std::vector<std::string>& words) {
  try {
    (void)read_msh_text(text, "mesh.msh", dimension, 1.0);
    ADD_FAILURE() << words[0] << ": read";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
    for (const auto& word : words) EXPECT_THAT(error.what(), HasSubstr(word));
  }
}

TEST(Mesh, WhatIsNoUsableMeshIsAnErrorThatNamesTheElement) {
  expect_error(with(cube_41, "4.1 0 8", "4.1 1 8"), 3, {"binary", "Mesh.Binary = 0", "mesh.msh:2"});
  expect_error(with(cube_41, "4.1 0 8", "4.0 0 8"), 3, {"4.0", "msh41"});
  expect_error(with(cube_41, "3 101 103 104 107", "3 101 104 103 107"), 3,
               {"element 3", "inverted", "mesh.msh:42"});
  expect_error(with(cube_41, "3 101 103 104 107", "3 101 103 103 107"), 3, {"element 3", "without volume"});
  expect_error(with(cube_41, "3 101 103 104 107", "3 101 103 999 107"), 3, {"node 999", "element 3"});
  expect_error(with(cube_41, "3 101 103 104 107", "3 101 102 103 107"), 3, {"element 3", "element 2"});
  expect_error(with(cube_41, "3 101 103 104 107", "3 101 103 104"), 3, {"mesh.msh:42"});
  expect_error(with(cube_41, "3 101 103 104 107", "3 101 103 104 107 108"), 3, {"4 nodes"});
  expect_error(with(cube_41, "3 10 4 3", "3 10 11 3"), 3, {"type 11", "ElementOrder = 1"});
  expect_error(with(cube_41, "3 10 4 3", "3 10 6 3"), 3, {"type 6", "prisms"});
  expect_error(with(cube_41, "1 1 1\n0 1 1", "1 nan 1\n0 1 1"), 3, {"finite number", "nan"});
  expect_error(with(cube_41, "1 1 1\n0 1 1", "1 1e400 1\n0 1 1"), 3, {"finite number"});
  expect_error(cube_41.substr(0, cube_41.size() - 40), 3, {"mesh.msh"});
  expect_error(cube_41, 1, {"dimension 2 or 3"});
  expect_error(plate_22, 3, {"elements of dimension 3", "none"});
  expect_error(with(plate_22, "5 1 1 0", "5 1 1 0.5"), 2, {"plane", "element 2"});
  expect_error(cube_41, 2, {"type 4"});
  expect_error("x,y,volume\n", 2, {"$MeshFormat"});
  expect_error("", 2, {"$MeshFormat"});
}

/// A file that is gone when the test ends.
struct TemporaryFile {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() /
      (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".exo");
  ~TemporaryFile() { std::filesystem::remove(path); }
};

/// A unit cube of a hexahedron beside one of six tetrahedra, written with 64-bit numbers.
void write_blocks(const std::filesystem::path& path, bool inverted) {
  int word = sizeof(double);
  const int id =
      ex_create(path.c_str(), EX_CLOBBER | EX_NETCDF4 | EX_ALL_INT64_API | EX_ALL_INT64_DB, &word, &word);
  ASSERT_GE(id, 0);
  ASSERT_EQ(ex_put_init(id, "cubes", 3, 12, 7, 2, 0, 0), 0);
  const std::array<double, 12> x = {0, 1, 1, 0, 0, 1, 1, 0, 2, 2, 2, 2},
                               y = {0, 0, 1, 1, 0, 0, 1, 1, 0, 1, 0, 1},
                               z = {0, 0, 0, 0, 1, 1, 1, 1, 0, 0, 1, 1};
  ASSERT_EQ(ex_put_coord(id, x.data(), y.data(), z.data()), 0);
  ASSERT_EQ(ex_put_block(id, EX_ELEM_BLOCK, 4, "HEX8", 1, 8, 0, 0, 0), 0);
  ASSERT_EQ(ex_put_block(id, EX_ELEM_BLOCK, 3000000000, "TETRA", 6, 4, 0, 0, 0), 0);
  ASSERT_EQ(ex_put_name(id, EX_ELEM_BLOCK, 4, "brick"), 0);
  const std::array<std::int64_t, 8> hex = {2, 9, 10, 3, 6, 11, 12, 7};
  std::array<std::int64_t, 24> tet = {1, 2, 3, 7, 1, 3, 4, 7, 1, 4, 8, 7, 1, 8, 5, 7, 1, 5, 6, 7, 1, 6, 2, 7};
  if (inverted) std::swap(tet[8], tet[9]);
  ASSERT_EQ(ex_put_conn(id, EX_ELEM_BLOCK, 4, hex.data(), nullptr, nullptr), 0);
  ASSERT_EQ(ex_put_conn(id, EX_ELEM_BLOCK, 3000000000, tet.data(), nullptr, nullptr), 0);
  ex_close(id);
}

TEST(Mesh, BlocksOfAnExodusFile) {
  const TemporaryFile file;
  write_blocks(file.path, false);
  const CloudData cloud = read_particles(file.path, 3, 1.0);
  ASSERT_EQ(cloud.count(), 7U);
  EXPECT_NEAR(sum(cloud.volume), 2.0, 1e-14);
  EXPECT_THAT(std::vector(cloud.position.begin(), cloud.position.begin() + 3),
              Pointwise(DoubleNear(1e-15), {1.5, 0.5, 0.5}));
  EXPECT_EQ(cloud.block[0], "brick");
  EXPECT_EQ(cloud.block[1], "block_3000000000");
}

TEST(Mesh, AnInvertedElementOfAnExodusFileIsNamed) {
  const TemporaryFile file;
  write_blocks(file.path, true);
  try {
    (void)read_particles(file.path, 3, 1.0);
    ADD_FAILURE() << "read";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("element 4"), HasSubstr("inverted")));
  }
  std::ofstream(file.path) << "no mesh";
  EXPECT_THROW((void)read_particles(file.path, 3, 1.0), Error);
}

}  // namespace
}  // namespace perimode
