// SPDX-License-Identifier: BSD-3-Clause
#include "io/case_sections.hpp"
#include "perimode/io/case.hpp"

namespace perimode {

Case read_case(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  return read_case_text(case_file::read_case_bytes(file), file, overrides);
}

namespace {

/// The case without the place of its results.
std::string canonical(case_file::CaseNode tree) {
  for (auto output = tree.children.begin(); output != tree.children.end(); ++output) {
    if (output->key != "output") continue;
    std::erase_if(output->children,
                  [](const case_file::CaseNode& child) { return child.key == "directory"; });
    if (output->children.empty()) tree.children.erase(output);
    break;
  }
  return json_text(tree);
}

}  // namespace

Case read_case_text(std::string_view text, const std::filesystem::path& file,
                    const std::vector<std::string>& overrides) {
  using namespace case_file;
  CaseNode tree = parse_case_tree(text, file);
  for (const std::string& key_value : overrides) apply_override(tree, key_value);

  const Section root(Cursor(tree, ""), {"title", "body", "material", "materials", "boundary", "analysis",
                                        "output", "kinematics"});
  Case result;
  result.file = file;
  if (const auto title = root.find("title")) result.title = title->text("a plate");
  InputFiles files{file.parent_path()};
  read_body(root.need("body", "{ dimension: 2, ... }"), files, result.model);
  read_materials(root.need("material", "{ youngs_modulus: 210.0e+9, density: 7850 }"), root.find("materials"),
                 files, result.model);
  check_horizon(result.model);
  if (const auto boundary = root.find("boundary")) read_boundary(*boundary, files, result.model);
  if (const auto kinematics = root.find("kinematics")) {
    result.kinematics = kinematics->choice<Kinematics>(
        {{"linear", Kinematics::linear}, {"large_rotation", Kinematics::large_rotation}});
  }
  if (const auto analysis = root.find("analysis")) read_analysis(*analysis, files, result);
  check_block_names(result);
  if (const auto output = root.find("output")) result.output = read_output(*output);
  result.files = std::move(files.found);
  result.canonical = canonical(std::move(tree));
  return result;
}

}  // namespace perimode
