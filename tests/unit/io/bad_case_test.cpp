// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "perimode/io/case.hpp"
#include "unit/io/sample_cases.hpp"
#include "unit/io/temporary_folder.hpp"

namespace perimode {
namespace {

using test::TemporaryFolder;

/// A good case in which the line that begins with `word` is replaced by `line`. The mark ^ (which is
/// taken out) stands where the error must point.
struct BadCase {
  const char* name;
  const char* base;
  const char* word;
  const char* line;
  std::vector<const char*> says;  ///< parts of the message
};

void PrintTo(const BadCase& bad, std::ostream* out) { *out << bad.name; }

std::string replace_line(const std::string& text, const std::string& word, const std::string& line) {
  std::size_t at = 0;
  while (text.compare(text.find_first_not_of(' ', at), word.size(), word) != 0) at = text.find('\n', at) + 1;
  return text.substr(0, at) + line + text.substr(text.find('\n', at));
}

class BadCaseTest : public testing::TestWithParam<BadCase> {};

TEST_P(BadCaseTest, GivesOneErrorWithPlaceExpectationAndRemedy) {
  const BadCase& bad = GetParam();
  std::string text = replace_line(test::sample_cases().at(bad.base), bad.word, bad.line);
  const std::size_t mark = text.find('^');
  ASSERT_NE(mark, std::string::npos);
  text.erase(mark, 1);
  const auto before = text.substr(0, mark);
  const int line = 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n'));
  const int column = static_cast<int>(mark - (before.rfind('\n') + 1)) + 1;

  const TemporaryFolder folder;
  (void)folder.write("cloud.csv", test::sample_cloud());
  const auto file = folder.write("case.yaml", text);
  try {
    (void)read_case(file);
    FAIL() << "read without an error:\n" << text;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
    EXPECT_EQ(error.where().line, line) << error.what();
    EXPECT_EQ(error.where().column, column) << error.what();
    EXPECT_THAT(error.what(), testing::StartsWith(file.string() + ":" + std::to_string(line) + ":"));
    EXPECT_THAT(error.what(), testing::HasSubstr("; "));  // the remedy
    EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n")));
    for (const char* part : bad.says) EXPECT_THAT(error.what(), testing::HasSubstr(part));
  }
}

const BadCase syntax[] = {
    {"tab", "plate", "plane", "^\tplane: stress", {"YAML", "spaces, no tabs"}},
    {"unclosed_list", "plate", "output", "output: { fields: [displacement ^}", {"YAML"}},
    {"two_colons", "plate", "title", "title: a^: b", {"YAML"}},
    {"open_quote", "plate", "title", "title: ^\"plate", {"closing \"", "end of the file"}},
    {"two_documents", "plate", "output", "---\n^output: {}", {"one YAML document", "2"}},
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

const BadCase body[] = {
    {"dimension_4", "plate", "dimension", "  dimension: ^4", {"one of 1, 2, 3"}},
    {"plane_of_other_spelling",
     "plate",
     "plane",
     "  plane: ^stres",
     {"one of stress, strain", "nearest is stress"}},
    {"plane_in_1d", "bar", "area", "  ^plane: stress", {"1D", "plane belongs to dimension 2"}},
    {"plane_in_3d", "solid", "horizon", "  horizon: { ratio: 2 }\n  ^plane: stress", {"3D"}},
    {"thickness_in_3d",
     "solid",
     "horizon",
     "  horizon: { ratio: 2 }\n  ^thickness: 1",
     {"thickness belongs to dimension 2"}},
    {"area_in_2d", "plate", "thickness", "  ^area: 1", {"area belongs to dimension 1"}},
    {"short_vector",
     "plate",
     "particles",
     "  particles: { grid: { lower: ^[0], upper: [1, 1], spacing: 0.1 } }",
     {"a list of 2 numbers in m", "dimension 2"}},
    {"long_vector",
     "plate",
     "precracks",
     "  precracks: [ { from: [0, 0], to: ^[0, 1, 2] } ]",
     {"a list of 3"}},
    {"text_in_vector",
     "plate",
     "particles",
     "  particles: { grid: { lower: [0, ^a], upper: [1, 1], spacing: 0.1 } }",
     {"body.particles.grid.lower.1"}},
    {"box_upside_down",
     "plate",
     "particles",
     "  particles: { grid: { lower: [0, 1], upper: ^[1, 0], spacing: 0.1 } }",
     {"along y", "lower"}},
    {"part_of_a_cell",
     "plate",
     "particles",
     "  particles: { grid: ^{ lower: [0, 0], upper: [1, 1], spacing: 0.3 } }",
     {"whole number of cells", "0.3"}},
    {"too_many_cells",
     "plate",
     "particles",
     "  particles: { grid: ^{ lower: [0, 0], upper: [1, 1], spacing: 1e-9 } }",
     {"2^31"}},
    {"absurd_spacing",
     "plate",
     "particles",
     "  particles: { grid: ^{ lower: [0, 0], upper: [1, 1], spacing: 1e-300 } }",
     {"2^31"}},
    {"mesh_file", "plate", "particles", "  particles: { file: ^part.msh }", {".csv", "this version"}},
    {"no_cloud_file",
     "plate",
     "particles",
     "  particles: { file: ^none.csv }",
     {"an existing file", "relative to the case file"}},
    {"ratio_on_cloud", "cloud", "horizon", "  horizon: { ^ratio: 3 }", {"cloud", "neighbours"}},
    {"periodic_cloud", "cloud", "horizon", "  horizon: { neighbours: 2 }\n  periodic: ^[x]", {"need a grid"}},
    {"empty_family", "plate", "horizon", "  horizon: { ratio: ^0.5 }", {"no particle would have a bond"}},
    {"absurd_horizon", "plate", "horizon", "  horizon: { length: ^1e9 }", {"at most", "spacings"}},
    {"periodic_axis", "plate", "periodic", "  periodic: [^z]", {"one of x, y"}},
    {"periodic_twice", "plate", "periodic", "  periodic: [x, ^x]", {"every axis once"}},
    {"polygon_of_two",
     "solid",
     "precracks",
     "  precracks: [ { polygon: ^[[0, 0, 0], [1, 0, 0]] } ]",
     {"at least 3 corners"}},
    {"segment_in_3d",
     "solid",
     "precracks",
     "  precracks: [ { ^from: [0, 0, 0], to: [1, 0, 0] } ]",
     {"polygon"}},
    {"polygon_in_2d",
     "plate",
     "precracks",
     "  precracks: [ { ^polygon: [[0, 0], [1, 0], [1, 1]] } ]",
     {"3D"}},
    {"crack_without_length",
     "plate",
     "precracks",
     "  precracks: [ { from: [0, 0], to: ^[0, 0] } ]",
     {"a crack has a length"}},
    {"long_crack_in_1d",
     "bar",
     "precracks",
     "  precracks: [ { from: [0.2], to: ^[0.3] } ]",
     {"a crack in 1D is a point"}},
    {"crack_without_end",
     "plate",
     "precracks",
     "  precracks: [ ^{ from: [0, 0] } ]",
     {"'to' in body.precracks.0"}},
    {"block_of_block",
     "plate",
     "blocks",
     "  blocks: { inclusion: ^{ block: inclusion } }",
     {"not defined by a block"}},
    {"region_without_shape",
     "plate",
     "blocks",
     "  blocks: { ^inclusion: {} }",
     {"one of face, box, ball, block, nearest"}},
    {"two_shapes",
     "plate",
     "blocks",
     "  blocks: { inclusion: { nearest: [0, 0], ^ball: { centre: [0, 0], radius: 1 } } }",
     {"both 'nearest' and 'ball'"}},
    {"ball_radius",
     "plate",
     "blocks",
     "  blocks: { inclusion: { ball: { centre: [0, 0], radius: ^0 } } }",
     {"a number > 0 in m"}},
    {"face_in_1d",
     "bar",
     "- { wall: x-",
     "  - { fix: [x], at: { face: ^y-, layers: 2 } }",
     {"one of x-, x+"}},
    {"face_without_sign",
     "plate",
     "- { fix",
     "  - { fix: [x], at: { face: ^x, layers: 2 } }",
     {"one of x-, x+, y-, y+"}},
    {"depth_on_grid", "plate", "- { fix", "  - { fix: [x], at: { face: x-, ^depth: 0.1 } }", {"layers"}},
    {"layers_on_cloud", "cloud", "- { fix", "  - { fix: [x], at: { face: x-, ^layers: 1 } }", {"depth"}},
    {"layers_of_a_ball",
     "plate",
     "- { fix",
     "  - { fix: [x], at: { nearest: [0, 0], ^layers: 1 } }",
     {"belongs to a face"}},
};

const BadCase material_and_boundary[] = {
    {"poissons_ratio",
     "plate",
     "density",
     "  density: 7850\n  poissons_ratio: ^0.3",
     {"1/3", "plane stress", "leave the key out"}},
    {"poissons_ratio_3d", "solid", "density", "  density: 7850\n  poissons_ratio: ^0.333", {"1/4", "3D"}},
    {"poissons_ratio_1d", "bar", "density", "  density: 7850\n  ^poissons_ratio: 0.3", {"1D"}},
    {"kernel_of_other_spelling",
     "plate",
     "micromodulus",
     "  micromodulus: { kernel: ^gausian }",
     {"nearest is gaussian"}},
    {"kernel_fourier",
     "plate",
     "micromodulus",
     "  micromodulus: { kernel: ^fourier, a0: 1, a: [1], w: 1 }",
     {"this version", "inverse_distance"}},
    {"kernel_shells",
     "plate",
     "micromodulus",
     "  micromodulus: { kernel: ^shells, file: a.csv }",
     {"this version"}},
    {"p_of_constant",
     "plate",
     "micromodulus",
     "  micromodulus: { kernel: constant, ^p: 2 }",
     {"gaussian only"}},
    {"alpha_of_constant",
     "plate",
     "micromodulus",
     "  micromodulus: { kernel: constant, ^alpha: [1] }",
     {"shells"}},
    {"exact_in_2d", "plate", "volume_correction", "  volume_correction: ^exact", {"none or linear in 2D"}},
    {"self_cell_in_2d", "plate", "volume_correction", "  self_cell: ^true", {"1D", "inverse_distance"}},
    {"self_cell_of_constant", "bar", "volume_correction", "  self_cell: ^true", {"inverse_distance"}},
    {"two_strengths",
     "plate",
     "density",
     "  density: 1\n  fracture_energy: 1\n  ^critical_stretch: 1",
     {"both"}},
    {"unknown_block",
     "plate",
     "materials",
     "materials: { ^inclusio: { density: 1 } }",
     {"(inclusion)", "nearest is inclusion"}},
    {"unknown_block_of_cloud",
     "cloud",
     "materials",
     "materials: { ^cores: { density: 1 } }",
     {"(core)", "nearest is core"}},
    {"no_blocks_at_all",
     "bar",
     "analysis",
     "materials: { ^a: { density: 1 } }",
     {"none is defined", "body.blocks"}},
    {"unknown_block_in_region", "plate", "- { fix", "  - { fix: [x], at: ^{ block: hole } }", {"'hole'"}},
    {"calibration_of_block",
     "plate",
     "materials",
     "materials: { inclusion: { ^calibration: discrete } }",
     {"whole body"}},
    {"correction_of_block",
     "plate",
     "materials",
     "materials: { inclusion: { ^volume_correction: none } }",
     {"whole body"}},
    {"bad_number_of_block",
     "plate",
     "materials",
     "materials: { inclusion: { density: ^-1 } }",
     {"materials.inclusion.density"}},
    {"component", "plate", "- { fix", "  - { fix: [^z], at: { face: y-, layers: 2 } }", {"one of x, y"}},
    {"component_twice",
     "plate",
     "- { fix",
     "  - { fix: [x, ^x], at: { face: y-, layers: 2 } }",
     {"every component once"}},
    {"no_component",
     "plate",
     "- { fix",
     "  - { fix: ^[], at: { face: y-, layers: 2 } }",
     {"at least one component"}},
    {"component_without_list",
     "plate",
     "- { fix",
     "  - { fix: ^x, at: { face: y-, layers: 2 } }",
     {"a list", "[x]"}},
    {"prescribe_component",
     "plate",
     "- { fix",
     "  - { prescribe: { ^z: 1 }, at: { face: y-, layers: 2 } }",
     {"boundary.0.prescribe (x, y)"}},
    {"prescribe_time",
     "plate",
     "- { fix",
     "  - { prescribe: { x: 1 }, at: { face: y-, layers: 2 }, time: { ^rampe: 1 } }",
     {"nearest valid key is ramp"}},
    {"wall_face", "plate", "- { wall", "  - { wall: ^top, type: mirror }", {"one of x-, x+, y-, y+"}},
    {"wall_type", "plate", "- { wall", "  - { wall: y+, type: ^miror }", {"nearest is mirror"}},
    {"wall_on_periodic_axis", "plate", "- { wall", "  - { wall: ^x+, type: mirror }", {"periodic"}},
    {"two_walls_on_a_face",
     "plate",
     "- { wall",
     "  - { wall: y+, type: mirror }\n  - { wall: ^y+, type: odd }",
     {"one wall on a face", "line 19"}},
    {"wall_on_cloud", "cloud", "- { fix", "  - { wall: ^x-, type: mirror }", {"need a grid"}},
    {"surface_nodes_in_2d", "plate", "- { wall", "  - { wall: y+, type: ^surface_nodes }", {"1D only"}},
    {"displacement_of_mirror",
     "plate",
     "- { wall",
     "  - { wall: y+, type: mirror, ^displacement: [0, 0] }",
     {"surface_nodes only"}},
    {"wall_with_region",
     "plate",
     "- { wall",
     "  - { wall: y+, type: mirror, ^at: { face: y+, layers: 1 } }",
     {"a wall lies on its face"}},
    {"type_of_fix",
     "plate",
     "- { fix",
     "  - { fix: [x], ^type: odd, at: { face: y-, layers: 2 } }",
     {"belongs to a wall"}},
    {"solver", "plate", "analysis", "analysis: { modal: { solver: ^lancos } }", {"nearest is lanczos"}},
    {"certificate",
     "plate",
     "analysis",
     "analysis: { modal: { certificate: ^sturm } }",
     {"auto, inertia, restart, none"}},
    {"reference", "plate", "analysis", "analysis: { modal: { reference: ^exact } }", {"none, closed_form"}},
    {"other_analysis", "plate", "analysis", "analysis: { static: ^3 }", {"analysis.static: a map"}},
    {"output_field", "plate", "output", "output: { fields: [^displacment] }", {"nearest is displacement"}},
};

const auto name_of = [](const auto& info) { return std::string(info.param.name); };
INSTANTIATE_TEST_SUITE_P(Syntax, BadCaseTest, testing::ValuesIn(syntax), name_of);
INSTANTIATE_TEST_SUITE_P(Keys, BadCaseTest, testing::ValuesIn(keys), name_of);
INSTANTIATE_TEST_SUITE_P(Numbers, BadCaseTest, testing::ValuesIn(numbers), name_of);
INSTANTIATE_TEST_SUITE_P(Body, BadCaseTest, testing::ValuesIn(body), name_of);
INSTANTIATE_TEST_SUITE_P(MaterialAndBoundary, BadCaseTest, testing::ValuesIn(material_and_boundary), name_of);

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
