// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "unit/io/bad_case.hpp"

namespace perimode {
namespace {

using test::BadCase;
using test::replace_line;
using test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;

/// The solid (horizon 2: orbits (1,0,0), (1,1,0), (1,1,1), (2,0,0)) with a micromodulus.
std::string solid(const std::string& micromodulus, const std::string& more = "") {
  return replace_line(test::sample_cases().at("solid"), "density",
                      "  density: 2700\n  micromodulus: " + micromodulus + more);
}

std::vector<double> alphas(const Micromodulus& m) {
  std::vector<double> result(m.shells.size());
  std::transform(m.shells.begin(), m.shells.end(), result.begin(), [](const Shell& s) { return s.alpha; });
  return result;
}

TEST(ReadMicromodulus, FourierTakesTheSpacingOfTheGrid) {
  const TemporaryFolder folder;
  const auto file = folder.write("case.yaml", solid("{ kernel: fourier, a0: -1.5, a: [2, -0.25], w: 0.75 }"));
  const Micromodulus m = read_case(file).model.material.micromodulus;
  EXPECT_EQ(m.kernel, Kernel::fourier);
  EXPECT_EQ(m.a0, -1.5);
  EXPECT_THAT(m.a, ElementsAre(2.0, -0.25));
  EXPECT_EQ(m.w, 0.75);
  EXPECT_EQ(m.spacing, 0.1);
  const Case finer = read_case(file, {"body.particles.grid.spacing=0.05"});
  EXPECT_EQ(finer.model.material.micromodulus.spacing, 0.05);
}

TEST(ReadMicromodulus, AListOfShellsFollowsTheOrbits) {
  const TemporaryFolder folder;
  const auto file = folder.write("case.yaml", solid("{ kernel: shells, alpha: [4, 3, 2, -1] }"));
  const Micromodulus m = read_case(file).model.material.micromodulus;
  EXPECT_EQ(m.kernel, Kernel::shells);
  EXPECT_THAT(alphas(m), ElementsAre(4.0, 3.0, 2.0, -1.0));
  EXPECT_THAT(m.shells[2].offset, ElementsAre(1, 1, 1));
  EXPECT_THAT(m.shells[3].offset, ElementsAre(2, 0, 0));
}

TEST(ReadMicromodulus, OrbitsOfOneDistanceAreLexicographic) {
  // sqrt(9): (2,2,1) before (3,0,0); the horizon 3 holds 9 orbits.
  const TemporaryFolder folder;
  const auto file =
      folder.write("case.yaml", solid("{ kernel: shells, alpha: [1, 2, 3, 4, 5, 6, 7, 8, 9] }"));
  const Case c = read_case(file, {"body.horizon.ratio=3"});
  const std::vector<Shell>& shells = c.model.material.micromodulus.shells;
  ASSERT_EQ(shells.size(), 9U);
  EXPECT_THAT(shells[7].offset, ElementsAre(2, 2, 1));
  EXPECT_THAT(shells[8].offset, ElementsAre(3, 0, 0));
}

TEST(ReadMicromodulus, AFileOfShellsIsReadInAnyOrderWithOrWithoutDistances) {
  const TemporaryFolder folder;
  const auto file = folder.write("case.yaml", solid("{ kernel: shells, file: tables/c.csv }"));
  std::filesystem::create_directory(file.parent_path() / "tables");
  for (const char* table :
       {"dx,dy,dz,distance,alpha\n1,0,0,0.1,4\n1,1,0,0.1414,3\n1,1,1,0.1732,2\n2,0,0,0.2,-1.5e0\n",
        "dx,dy,dz,alpha\r\n2,0,0,-1.5\r\n\r\n 1, 1, 1, 2\r\n1,1,0,3\r\n1,0,0,4\r\n"}) {
    const auto csv = folder.write("tables/c.csv", table);
    const Case c = read_case(file);
    EXPECT_THAT(alphas(c.model.material.micromodulus), ElementsAre(4.0, 3.0, 2.0, -1.5)) << table;
    EXPECT_THAT(c.files, ElementsAre(csv));
  }
}

TEST(ReadMicromodulus, BlocksKeepTheTableOrTakeTheirOwn) {
  const TemporaryFolder folder;
  const std::string blocks =
      "\nmaterials:\n  a: { density: 1 }\n  b: { micromodulus: { alpha: [5, 6, 7, 8] } }\n"
      "  c: { micromodulus: { kernel: constant }, break_negative: true }\n"
      "  d: { micromodulus: { kernel: fourier, a0: 1, a: [], w: 0 } }";
  std::string text = solid("{ kernel: shells, alpha: [4, 3, 2, -1] }", blocks);
  const std::string region = ": { nearest: [0, 0, 0] }";
  text = replace_line(text, "horizon",
                      "  horizon: { ratio: 2 }\n  blocks: { a" + region + ", b" + region + ", c" + region +
                          ", d" + region + " }");
  const Model model = read_case(folder.write("case.yaml", text)).model;
  EXPECT_THAT(alphas(model.block_materials.at("a").micromodulus), ElementsAre(4.0, 3.0, 2.0, -1.0));
  EXPECT_THAT(alphas(model.block_materials.at("b").micromodulus), ElementsAre(5.0, 6.0, 7.0, 8.0));
  EXPECT_EQ(model.block_materials.at("b").micromodulus.kernel, Kernel::shells);
  EXPECT_EQ(model.block_materials.at("c").micromodulus.kernel, Kernel::constant);
  EXPECT_EQ(model.block_materials.at("d").micromodulus.kernel, Kernel::fourier);
  EXPECT_TRUE(model.block_materials.at("c").break_negative);
  EXPECT_FALSE(model.material.break_negative);
}

/// The error of a case whose table is `table`: at its file and line.
void expect_table_complaint(const std::string& table, int line, const std::vector<std::string>& says) {
  const TemporaryFolder folder;
  const auto csv = folder.write("c.csv", table);
  const auto file = folder.write("case.yaml", solid("{ kernel: shells, file: c.csv }"));
  try {
    (void)read_case(file);
    FAIL() << "read without an error:\n" << table;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
    EXPECT_EQ(error.where().file, csv.string()) << error.what();
    EXPECT_EQ(error.where().line, line) << error.what();
    for (const std::string& part : says) EXPECT_THAT(error.what(), HasSubstr(part));
  }
}

TEST(ReadMicromodulus, BadTablesAreToldWithFileAndLine) {
  const std::string head = "dx,dy,dz,alpha\n";
  const std::string good = "1,0,0,1\n1,1,0,1\n1,1,1,1\n";
  expect_table_complaint("dx,dy,alpha\n1,0,1\n", 1,
                         {"the header dx,dy,dz,distance,alpha or dx,dy,dz,alpha", "'dx,dy,alpha'"});
  expect_table_complaint(head + good + "2,0,0,one\n", 5, {"a finite number for alpha", "'one'"});
  expect_table_complaint(head + good + "2,0,0\n", 5, {"4 fields"});
  expect_table_complaint(head + good + "0,0,2,1\n", 5, {"dx >= dy >= dz >= 0", "largest component first"});
  expect_table_complaint(head + good + "1,2,0,1\n", 5, {"dx >= dy >= dz >= 0", "2 for dy"});
  expect_table_complaint(head + good + "1.5,0,0,1\n", 5, {"whole numbers", "1.5 for dx"});
  expect_table_complaint(head + good + "1,-1,0,1\n", 5, {"-1 for dy"});
  expect_table_complaint(head + good + "1e300,0,0,1\n", 5, {"for dx"});
  expect_table_complaint(head + good + "0,0,0,1\n", 5, {"for dx"});
  expect_table_complaint(head + good + "2,1,0,1\n", 5, {"one of the 4 orbits", "(2, 1, 0)", "horizon"});
  expect_table_complaint(head + good + "1,1,0,1\n", 5, {"every orbit once", "(1, 1, 0) again"});
  expect_table_complaint(head + good, 0,
                         {"a line for each of the 4 orbits", "none for (2, 0, 0)", "horizon"});
  expect_table_complaint(head, 1, {"at least one line"});
}

TEST(ReadMicromodulus, ATableOfAnEndlessHorizonIsRefusedBeforeItsOrbitsAreListed) {
  const TemporaryFolder folder;
  const auto file = folder.write("case.yaml", solid("{ kernel: shells, alpha: [4, 3, 2, -1] }"));
  try {
    (void)read_case(file, {"body.horizon.ratio=90"});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
    EXPECT_THAT(error.what(), HasSubstr("at most 78 spacings with the kernel shells"));
  }
}

class BadMicromodulusTest : public testing::TestWithParam<BadCase> {};

TEST_P(BadMicromodulusTest, GivesOneErrorWithPlaceExpectationAndRemedy) {
  test::expect_complaint(GetParam());
}

#define PERIMODE_SOLID(text) "  density: 2700\n  micromodulus: " text
const BadCase bad[] = {
    {"a0_of_constant",
     "solid",
     "density",
     PERIMODE_SOLID("{ ^a0: 1 }"),
     {"`a0` with the kernel fourier only"}},
    {"w_of_shells",
     "solid",
     "density",
     PERIMODE_SOLID("{ kernel: shells, alpha: [1, 1, 1, 1], ^w: 1 }"),
     {"`w` with the kernel fourier only"}},
    {"p_of_fourier",
     "solid",
     "density",
     PERIMODE_SOLID("{ kernel: fourier, a0: 1, a: [1], w: 1, ^p: 2 }"),
     {"`p` with the kernel gaussian only"}},
    {"alpha_of_fourier",
     "solid",
     "density",
     PERIMODE_SOLID("{ kernel: fourier, a0: 1, a: [1], w: 1, ^alpha: [1] }"),
     {"`alpha` with the kernel shells only"}},
    {"file_of_conical",
     "solid",
     "density",
     PERIMODE_SOLID("{ kernel: conical, ^file: c.csv }"),
     {"`file` with the kernel shells only", "kernel: shells"}},
    {"fourier_without_a",
     "solid",
     "density",
     "  density: 2700\n  ^micromodulus: { kernel: fourier, a0: 1, w: 1 }",
     {"'a' in material.micromodulus"}},
    {"fourier_word",
     "solid",
     "density",
     PERIMODE_SOLID("{ kernel: fourier, a0: 1, a: [1, ^x], w: 1 }"),
     {"material.micromodulus.a.1"}},
    {"fourier_no_list",
     "solid",
     "density",
     PERIMODE_SOLID("{ kernel: fourier, a0: 1, a: ^1, w: 1 }"),
     {"a list"}},
    {"shells_without_any",
     "solid",
     "density",
     "  density: 2700\n  ^micromodulus: { kernel: shells }",
     {"one of file, alpha"}},
    {"shells_with_both",
     "solid",
     "density",
     PERIMODE_SOLID("{ kernel: shells, file: c.csv, ^alpha: [1] }"),
     {"both 'file' and 'alpha'"}},
    {"shells_no_file",
     "solid",
     "density",
     PERIMODE_SOLID("{ kernel: shells, file: ^c.csv }"),
     {"an existing file", "relative to the case file"}},
    {"shells_too_few",
     "solid",
     "density",
     PERIMODE_SOLID("{ kernel: shells, alpha: ^[1, 2, 3] }"),
     {"a list of 4 numbers", "ascending order of distance", "(1, 0, 0) (1, 1, 0) (1, 1, 1) (2, 0, 0)",
      "a list of 3"}},
    {"shells_word",
     "solid",
     "density",
     PERIMODE_SOLID("{ kernel: shells, alpha: [1, 2, ^x, 4] }"),
     {"material.micromodulus.alpha.2"}},
    {"shells_correction",
     "solid",
     "density",
     PERIMODE_SOLID("{ kernel: shells, alpha: [1, 2, 3, 4] }\n  volume_correction: ^linear"),
     {"none with the kernel shells"}},
    {"fourier_calibration",
     "solid",
     "density",
     PERIMODE_SOLID("{ kernel: fourier, a0: 1, a: [1], w: 1 }\n  calibration: ^discrete"),
     {"continuum with the kernel fourier"}},
    {"fourier_correction_of_block",
     "solid",
     "density",
     "  density: 2700\n  volume_correction: ^linear\n"
     "materials: { core: { micromodulus: { kernel: fourier, a0: 1, a: [], w: 1 } } }",
     {"none with the kernel fourier of the block core"}},
    {"fourier_of_cloud",
     "cloud",
     "density",
     "  density: 1\n  micromodulus: { kernel: ^fourier, a0: 1, a: [1], w: 1 }",
     {"for a cloud", "lattice of a grid"}},
    {"shells_of_cloud",
     "cloud",
     "density",
     "  density: 1\n  micromodulus: { kernel: ^shells, alpha: [1] }",
     {"for a cloud", "lattice of a grid"}},
    {"break_negative_word",
     "plate",
     "density",
     "  density: 1\n  break_negative: ^maybe",
     {"one of true, false"}},
};
INSTANTIATE_TEST_SUITE_P(Reader, BadMicromodulusTest, testing::ValuesIn(bad), test::name_of);

}  // namespace
}  // namespace perimode
