// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "perimode/assembly/bond_forces.hpp"
#include "perimode/assembly/model.hpp"
#include "perimode/dynamics/transient.hpp"
#include "perimode/fracture/quasistatic.hpp"
#include "perimode/io/dispersion_spec.hpp"
#include "perimode/io/initial_state.hpp"
#include "perimode/modal/options.hpp"
#include "perimode/statics/static.hpp"

namespace perimode {

struct OutputSpec {
  std::filesystem::path directory = "out";
  std::vector<std::string> fields = {"displacement"};
  Where where = {};
};

/// A case file, read and checked on its own (not yet built).
struct Case {
  std::string title;
  Model model;
  std::optional<ModalOptions> modal;
  Where modal_where = {};
  std::optional<StaticOptions> statics;
  Where static_where = {};
  std::optional<TransientOptions> transient;  ///< with the case's kinematics
  InitialSpec initial;                        ///< of the transient analysis
  Where transient_where = {};
  std::optional<QuasistaticOptions> quasistatic;  ///< as the case gives it: no critical stretches yet
  Where quasistatic_where = {};
  std::optional<DispersionSpec> dispersion;
  Kinematics kinematics = Kinematics::linear;
  OutputSpec output;
  std::filesystem::path file;

  /// Every file the case names, in its order: particles, tables of coefficients and of time functions,
  /// initial fields.
  std::vector<std::filesystem::path> files;
  /// The case after overrides as JSON in one line, values as they are written: the same for two cases that
  /// differ in comments, layout or output.directory alone.
  std::string canonical;
};

/// Reads a YAML or JSON case (docs/case_reference.md). `overrides` are `key=value` texts, the key a
/// dotted path ("body.horizon.ratio=4", "boundary.0.wall=x-"), applied before checking.
/// Throws Error(invalid_input) with file:line:column for anything that is not exactly as
/// documented: unknown, duplicate or missing keys, wrong types, values out of range.
[[nodiscard]] Case read_case(const std::filesystem::path& file,
                             const std::vector<std::string>& overrides = {});

/// The same of text at hand: errors name it `file`, and its relative paths start at the folder of `file`.
[[nodiscard]] Case read_case_text(std::string_view text, const std::filesystem::path& file,
                                  const std::vector<std::string>& overrides = {});

}  // namespace perimode
