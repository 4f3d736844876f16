// SPDX-License-Identifier: BSD-3-Clause
#include "unit/io/bad_case.hpp"

namespace perimode {
namespace {

using test::replace_line;
using test::TemporaryFolder;

Case read_static(const std::string& section) {
  const TemporaryFolder folder;
  const std::string text =
      replace_line(test::sample_cases().at("plate"), "analysis", "analysis: { static: " + section + " }");
  return read_case(folder.write("case.yaml", text));
}

TEST(ReadStatic, LoadsOfEveryKind) {
  const Case c = read_static(
      "{ solver: jacobi, tolerance: 1e-6, loads: [ { traction: [1, -2], at: { face: y-, layers: 2 }, time: "
      "constant }, "
      "{ body_force: [3, 4] }, { force: [5, 6], at: { block: inclusion }, time: { ricker: 100 } } ] }");
  ASSERT_TRUE(c.statics.has_value());
  EXPECT_FALSE(c.modal.has_value());
  EXPECT_EQ(c.statics->solver, StaticSolver::jacobi);
  EXPECT_EQ(c.statics->tolerance, 1e-6);
  ASSERT_EQ(c.statics->loads.size(), 3U);
  EXPECT_EQ(std::get<Traction>(c.statics->loads[0].what).value, (Coordinates{1.0, -2.0}));
  EXPECT_EQ(std::get<FaceRegion>(c.statics->loads[0].at->shape).layers, 2);
  EXPECT_EQ(std::get<BodyForce>(c.statics->loads[1].what).value, (Coordinates{3.0, 4.0}));
  EXPECT_FALSE(c.statics->loads[1].at.has_value());
  EXPECT_EQ(std::get<TotalForce>(c.statics->loads[2].what).value, (Coordinates{5.0, 6.0}));
  EXPECT_EQ(std::get<BlockRegion>(c.statics->loads[2].at->shape).name, "inclusion");
  EXPECT_GT(c.static_where.line, 0);
}

TEST(ReadStatic, AnEmptySectionIsAllDefaults) {
  for (const char* section : {"", "{}", "{ loads: [] }"}) {
    const Case c = read_static(section);
    ASSERT_TRUE(c.statics.has_value());
    EXPECT_TRUE(c.statics->loads.empty());
    EXPECT_EQ(c.statics->solver, StaticSolver::automatic);
    EXPECT_EQ(c.statics->tolerance, 1e-8);
  }
}

}  // namespace
}  // namespace perimode
