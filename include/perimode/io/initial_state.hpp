// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <variant>
#include <vector>

#include "perimode/core/expression.hpp"
#include "perimode/dynamics/transient.hpp"
#include "perimode/geometry/particles.hpp"

namespace perimode {

/// One formula of x, y, z per component.
struct FormulaField {
  std::vector<Expression> component;
};
/// A CSV file, one line per particle in their order, with the header x, [y, [z]] of the field's components.
struct TableField {
  std::filesystem::path file;
};
/// A mode of a modal run (its modes.exo), number from 1, times `scale`.
struct ModeField {
  std::filesystem::path file;
  int mode = 1;
  double scale = 1.0;
};
using InitialField = std::variant<std::monostate, FormulaField, TableField, ModeField>;

/// The case file's `initial`.
struct InitialSpec {
  InitialField displacement;
  InitialField velocity;
  Where where = {};
};

/// Throws invalid_input: a formula without a finite value, a file that does not fit the particles (count,
/// places), a mode it does not hold.
template <int Dim>
[[nodiscard]] InitialState initial_state(const InitialSpec& spec, const Particles<Dim>& particles);

}  // namespace perimode
