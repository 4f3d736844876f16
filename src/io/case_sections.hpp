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

/// One of "x-", "x+", "y-", ...
[[nodiscard]] Face read_face(const Cursor& cursor, int dimension);
/// 0 for x, 1 for y, 2 for z.
[[nodiscard]] int read_axis(const Cursor& cursor, int dimension);
/// {face, layers | depth} | {box} | {ball} | {block} | {nearest}.
[[nodiscard]] Region read_region(const Cursor& cursor, const BodyFacts& facts);

/// The `body` section: everything of the model but materials and boundary. `directory` is that of
/// the case file.
void read_body(const Cursor& cursor, const std::filesystem::path& directory, Model& model);
/// The `material` and `materials` sections of a model whose body has been read.
void read_materials(const Cursor& material, const std::optional<Cursor>& overrides, Model& model);
/// The `boundary` section of a model whose body has been read.
void read_boundary(const Cursor& cursor, Model& model);
/// The time function of a load: checked by name, its values are read where time passes.
void check_time(const Cursor& cursor);
/// A list of loads: {traction | body_force | force, at, time}.
[[nodiscard]] std::vector<Load> read_loads(const Cursor& cursor, const BodyFacts& facts);
/// The section analysis.static.
[[nodiscard]] StaticOptions read_static(const Cursor& cursor, const BodyFacts& facts);
/// The `analysis` section of a case whose model has been read.
void read_analysis(const Cursor& cursor, Case& result);
[[nodiscard]] OutputSpec read_output(const Cursor& cursor);

/// Block names in use (regions, materials) against those the body has.
void check_block_names(const Model& model);
/// The family of a grid: neither empty nor absurdly large.
void check_horizon(const Model& model);

}  // namespace perimode::case_file
