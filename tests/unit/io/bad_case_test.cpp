// SPDX-License-Identifier: BSD-3-Clause
#include "unit/io/bad_case.hpp"

namespace perimode {
namespace {

using test::BadCase;
using test::replace_line;
using test::TemporaryFolder;

class BadCaseTest : public testing::TestWithParam<BadCase> {};

TEST_P(BadCaseTest, GivesOneErrorWithPlaceExpectationAndRemedy) { test::expect_complaint(GetParam()); }

const BadCase syntax[] = {
    {"tab", "plate", "plane", "^\tplane: stress", {"YAML", "spaces, no tabs"}},
    {"unclosed_list", "plate", "output", "output: { fields: [displacement ^}", {"YAML"}},
    {"two_colons", "plate", "title", "title: a^: b", {"YAML"}},
    {"open_quote", "plate", "title", "title: ^\"plate", {"closing \"", "end of the file"}},
    {"two_documents", "plate", "output", "^---\noutput: {}", {"one YAML document", "a second one"}},
    {"stray_comma", "plate", "title", "^,title: plate", {"the end of the YAML text", "','"}},
    {"duplicate_key",
     "plate",
     "plane",
     "  plane: stress\n  ^plane: stress",
     {"every key once", "'plane' again", "line 4"}},
    {"duplicate_in_flow_map", "plate", "horizon", "  horizon: { ratio: 3, ^ratio: 4 }", {"'ratio' again"}},
    {"duplicate_section", "plate", "output", "^material: {}", {"'material' again"}},
    {"anchor_in_itself", "plate", "output", "output: &a { ^fields: *a }", {"anchor that contains itself"}},
    {"key_is_list", "plate", "output", "output: { ^[a]: b }", {"a key (a word)", "a list of 1"}},
    {"merge_key", "plate", "output", "output: { ^<<: { directory: a } }", {"merge keys are not read"}},
    {"control_byte", "plate", "title", "title: a^\x01", {"UTF-8", "0x01"}},
};

const BadCase keys[] = {
    {"unknown_root_key",
     "plate",
     "output",
     "^outputs: {}",
     {"'outputs'", "nearest valid key is output", "analysis"}},
    {"unknown_body_key",
     "plate",
     "horizon",
     "  ^horizn: { ratio: 3 }",
     {"'horizn'", "nearest valid key is horizon", "precracks"}},
    {"swapped_letters", "plate", "horizon", "  horizon: { ^ratoi: 3 }", {"nearest valid key is ratio"}},
    {"no_space_after_colon", "plate", "horizon", "  horizon: { ^ratio:3 }", {"a space must follow the ':'"}},
    {"unknown_modal_key",
     "plate",
     "analysis",
     "analysis: { modal: { ^mode: 3 } }",
     {"nearest valid key is modes"}},
    {"unknown_analysis", "plate", "analysis", "analysis: { ^modl: {} }", {"nearest valid key is modal"}},
    {"missing_spacing",
     "plate",
     "particles",
     "  particles: { ^grid: { lower: [0, 0], upper: [1, 1] } }",
     {"'spacing' in body.particles.grid"}},
    {"missing_at", "plate", "- { fix", "  - ^{ fix: [x] }", {"'at' in boundary.0"}},
    {"missing_type", "plate", "- { wall", "  - ^{ wall: y+ }", {"'type' in boundary.1"}},
    {"body_is_text", "plate", "output", "output: ^here", {"output: a map", "'here'"}},
    {"section_is_empty", "plate", "output", "^output:", {"output: a map", "nothing"}},
    {"list_is_map", "plate", "periodic", "  periodic: ^{ x: true }", {"body.periodic: a list", "a map"}},
    {"neither_grid_nor_file", "plate", "particles", "  ^particles: {}", {"one of grid, file", "none"}},
    {"both_grid_and_file",
     "plate",
     "particles",
     "  particles: { grid: { lower: [0, 0], upper: [1, 1], spacing: 0.1 }, ^file: a.csv }",
     {"both 'grid' and 'file'"}},
    {"two_horizons",
     "plate",
     "horizon",
     "  horizon: { ratio: 3, ^length: 0.3 }",
     {"both 'ratio' and 'length'"}},
    {"no_horizon_rule", "plate", "horizon", "  ^horizon: {}", {"one of ratio, length, neighbours"}},
    {"modes_and_range",
     "plate",
     "analysis",
     "analysis: { modal: { modes: 3, ^range: [0, 5] } }",
     {"both 'modes' and 'range'"}},
    {"range_and_shift",
     "plate",
     "analysis",
     "analysis: { modal: { range: [0, 5], ^shift: 3 } }",
     {"both 'range' and 'shift'"}},
    {"fix_and_wall",
     "plate",
     "- { wall",
     "  - { wall: y+, type: mirror, ^fix: [x] }",
     {"both 'wall' and 'fix'"}},
};

const BadCase numbers[] = {
    {"unit",
     "plate",
     "youngs_modulus",
     "  youngs_modulus: ^210 GPa",
     {"a number > 0 in Pa", "'210 GPa'", "units are not read", "210.0e+9"}},
    {"quoted_unit",
     "plate",
     "youngs_modulus",
     "  youngs_modulus: ^\"210 GPa\"",
     {"'210 GPa'", "plain SI number in Pa"}},
    {"unit_without_blank",
     "plate",
     "particles",
     "  particles: { grid: { lower: [0, 0], upper: [1, 1], spacing: ^10mm } }",
     {"'10mm'", "units are not read"}},
    {"nan", "plate", "density", "  density: ^nan", {"'nan'"}},
    {"yaml_nan", "plate", "density", "  density: ^.nan", {"'.nan'"}},
    {"inf", "plate", "density", "  density: ^inf", {"'inf'", "finite"}},
    {"overflow", "plate", "density", "  density: ^1e400", {"fit a double"}},
    {"decimal_comma", "plate", "density", "  density: ^7850,5", {"a number > 0"}},
    {"negative", "plate", "density", "  density: ^-7850", {"a number > 0 in kg/m3", "'-7850'"}},
    {"zero", "plate", "youngs_modulus", "  youngs_modulus: ^0", {"a number > 0"}},
    {"zero_thickness", "plate", "thickness", "  thickness: ^0.0", {"a number > 0 in m"}},
    {"empty_number", "plate", "density", "  ^density:", {"nothing"}},
    {"list_for_number", "plate", "density", "  density: ^[1, 2]", {"a list of 2"}},
    {"negative_ratio", "plate", "horizon", "  horizon: { ratio: ^-3 }", {"body.horizon.ratio: a number > 0"}},
    {"broken_count", "plate", "horizon", "  horizon: { neighbours: ^2.5 }", {"a whole number >= 1", "'2.5'"}},
    {"no_modes", "plate", "analysis", "analysis: { modal: { modes: ^0 } }", {"a whole number >= 1"}},
    {"too_many_modes", "plate", "analysis", "analysis: { modal: { modes: ^3e9 } }", {"below 2^31"}},
    {"range_backwards",
     "plate",
     "analysis",
     "analysis: { modal: { range: [50, ^5] } }",
     {"a frequency > 50 Hz"}},
    {"range_of_three",
     "plate",
     "analysis",
     "analysis: { modal: { range: ^[1, 2, 3] } }",
     {"2 frequencies in Hz", "a list of 3"}},
    {"negative_shift", "plate", "analysis", "analysis: { modal: { shift: ^-1 } }", {"a number >= 0 in Hz"}},
    {"no_layers",
     "plate",
     "- { fix",
     "  - { fix: [x], at: { face: y-, layers: ^0 } }",
     {"a whole number >= 1"}},
    {"gaussian_p", "plate", "micromodulus", "  micromodulus: { kernel: gaussian, p: ^0 }", {"a number > 0"}},
    {"true_of_other_spelling", "bar", "volume_correction", "  self_cell: ^yes", {"one of true, false"}},
};

INSTANTIATE_TEST_SUITE_P(Syntax, BadCaseTest, testing::ValuesIn(syntax), test::name_of);
INSTANTIATE_TEST_SUITE_P(Keys, BadCaseTest, testing::ValuesIn(keys), test::name_of);
INSTANTIATE_TEST_SUITE_P(Numbers, BadCaseTest, testing::ValuesIn(numbers), test::name_of);

std::string message_of(const std::filesystem::path& file, const std::vector<std::string>& overrides = {}) {
  try {
    (void)read_case(file, overrides);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
    return error.what();
  }
  return "no error";
}

TEST(BadCaseFile, MissingFileSaysItsPath) {
  EXPECT_THAT(message_of("/nowhere/plate.yaml"),
              testing::HasSubstr("/nowhere/plate.yaml: expected a case file, got no such file"));
}

TEST(BadCaseFile, DirectoryIsRefused) {
  const TemporaryFolder folder;
  EXPECT_THAT(message_of(folder.path()), testing::HasSubstr("a directory"));
}

TEST(BadCaseFile, EmptyFileAndCommentsOnlyAreRefused) {
  const TemporaryFolder folder;
  EXPECT_THAT(message_of(folder.write("a.yaml", "")),
              testing::HasSubstr("a.yaml:1:1: expected a case, got an empty file"));
  EXPECT_THAT(message_of(folder.write("b.yaml", "# nothing\n")), testing::HasSubstr("an empty file"));
}

TEST(BadCaseFile, BinaryIsRefusedAsNoText) {
  const TemporaryFolder folder;
  EXPECT_THAT(message_of(folder.write("a.yaml", std::string("\x7F"
                                                            "ELF\0\0\xFF\xFE",
                                                            8))),
              testing::HasSubstr("UTF-8"));
  EXPECT_THAT(message_of(folder.write("b.yaml", "title: \xFF\xFE\n")), testing::HasSubstr("b.yaml:1:8"));
}

TEST(BadCaseFile, ListInsteadOfMapIsRefused) {
  const TemporaryFolder folder;
  EXPECT_THAT(message_of(folder.write("a.yaml", "- body\n")),
              testing::HasSubstr("a.yaml:1:1: expected a map, got a list of 1"));
}

TEST(BadCaseFile, DeepNestingIsRefused) {
  const TemporaryFolder folder;
  const std::string deep = "title: " + std::string(200, '[') + std::string(200, ']') + "\n";
  EXPECT_THAT(message_of(folder.write("a.yaml", deep)), testing::HasSubstr("64 levels"));
}

TEST(BadCaseFile, MissingKeyPointsAtItsSection) {
  const TemporaryFolder folder;
  const std::string plate = test::sample_cases().at("plate");
  const auto without = [&](const char* word) {
    return folder.write("a.yaml", replace_line(plate, word, "#"));
  };
  EXPECT_THAT(
      message_of(without("dimension")),
      testing::HasSubstr(
          "a.yaml:2:1: expected the key 'dimension' in body, got none; add for example `dimension: 2`"));
  EXPECT_THAT(message_of(without("horizon")),
              testing::HasSubstr("a.yaml:2:1: expected the key 'horizon' in body"));
  EXPECT_THAT(message_of(without("youngs_modulus")),
              testing::HasSubstr("a.yaml:11:1: expected the key 'youngs_modulus' in material"));
  EXPECT_THAT(message_of(without("density")),
              testing::HasSubstr("a.yaml:11:1: expected the key 'density' in material"));
  EXPECT_THAT(message_of(folder.write("b.yaml", "title: nothing\n")),
              testing::HasSubstr("b.yaml:1:1: expected the key 'body' in the case"));
}

TEST(BadOverride, NamesItselfAsThePlace) {
  const TemporaryFolder folder;
  const auto file = folder.write("a.yaml", test::sample_cases().at("plate"));
  EXPECT_THAT(message_of(file, {"body.horizon.ratio=-3"}),
              testing::StartsWith("--set body.horizon.ratio=-3: expected"));
  EXPECT_THAT(message_of(file, {"body.horizn.ratio=3"}), testing::HasSubstr("nearest valid key is horizon"));
  EXPECT_THAT(message_of(file, {"body.horizon=[3"}), testing::HasSubstr("syntax error"));
  EXPECT_THAT(message_of(file, {"body.horizon"}), testing::HasSubstr("key=value"));
  EXPECT_THAT(message_of(file, {"=3"}), testing::HasSubstr("key=value"));
  EXPECT_THAT(message_of(file, {"body..ratio=3"}), testing::HasSubstr("dotted path"));
  EXPECT_THAT(message_of(file, {"boundary.7.wall=x-"}), testing::HasSubstr("from 0 to 2"));
  EXPECT_THAT(message_of(file, {"boundary.first.wall=x-"}), testing::HasSubstr("an item of the list"));
  EXPECT_THAT(message_of(file, {"title.a=3"}), testing::HasSubstr("title to be a map or a list"));
}

}  // namespace
}  // namespace perimode
