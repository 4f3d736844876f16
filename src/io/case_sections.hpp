// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/cursor.hpp"
#include "perimode/assembly/model.hpp"
#include "perimode/io/case.hpp"

namespace perimode::case_file {

/// What the meaning of a region depends on.
struct BodyFacts {
  int dimension = 2;
  bool grid = true;
};
[[nodiscard]] BodyFacts facts_of(const Model& model);

/// Where relative paths of the case start, and the files it has been found to name.
struct InputFiles {
  std::filesystem::path directory = {};
  std::vector<std::filesystem::path> found = {};

  /// The file that a value of the case names. Throws invalid_input, at the value, where there is none, unless
  /// it may still have to be made, as by another analysis of the case.
  std::filesystem::path add(const Cursor& cursor, const char* example, bool from_a_run = false);
};

/// One of "x-", "x+", "y-", ...
[[nodiscard]] Face read_face(const Cursor& cursor, int dimension);
/// 0 for x, 1 for y, 2 for z.
[[nodiscard]] int read_axis(const Cursor& cursor, int dimension);
/// {face, layers | depth} | {box} | {ball} | {block} | {nearest}.
[[nodiscard]] Region read_region(const Cursor& cursor, const BodyFacts& facts);

/// The `body` section: everything of the model but materials and boundary.
void read_body(const Cursor& cursor, InputFiles& files, Model& model);
/// The `material` and `materials` sections of a model whose body has been read.
void read_materials(const Cursor& material, const std::optional<Cursor>& overrides, InputFiles& files,
                    Model& model);
/// The `micromodulus` section: what it gives replaces that of `result`. The body has been read.
[[nodiscard]] Micromodulus read_micromodulus(const Cursor& cursor, const Model& model, InputFiles& files,
                                             Micromodulus result);
/// The `boundary` section of a model whose body has been read.
void read_boundary(const Cursor& cursor, InputFiles& files, Model& model);
/// constant | {ramp | step | half_sine | ricker | gaussian | table | expression}.
[[nodiscard]] TimeFunction read_time(const Cursor& cursor, InputFiles& files);
/// A number, or a formula of the first of x, y, z that the body has.
[[nodiscard]] Expression read_formula(const Cursor& cursor, int dimension);
/// One number or formula per component.
[[nodiscard]] std::vector<Expression> read_formulas(const Cursor& cursor, int dimension);
/// A list of loads: {traction | body_force | force, at, time}.
[[nodiscard]] std::vector<Load> read_loads(const Cursor& cursor, const BodyFacts& facts, InputFiles& files);
/// The section analysis.static.
[[nodiscard]] StaticOptions read_static(const Cursor& cursor, const BodyFacts& facts, InputFiles& files);
/// The section analysis.transient of a case whose model and kinematics have been read.
void read_transient(const Cursor& cursor, InputFiles& files, Case& result);
/// The section analysis.quasistatic of a case whose model has been read.
void read_quasistatic(const Cursor& cursor, InputFiles& files, Case& result);
/// The section analysis.dispersion of a case whose model has been read.
void read_dispersion(const Cursor& cursor, InputFiles& files, Case& result);
/// The `analysis` section of a case whose model and kinematics have been read.
void read_analysis(const Cursor& cursor, InputFiles& files, Case& result);
[[nodiscard]] OutputSpec read_output(const Cursor& cursor);

/// Block names in use (regions, materials) against those the body has.
void check_block_names(const Case& result);
/// The family of a grid: neither empty nor absurdly large.
void check_horizon(const Model& model);

}  // namespace perimode::case_file
