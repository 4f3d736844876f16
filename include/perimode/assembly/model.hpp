// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "perimode/bonds/family.hpp"
#include "perimode/boundary/conditions.hpp"
#include "perimode/core/error.hpp"
#include "perimode/geometry/region.hpp"
#include "perimode/material/material.hpp"

namespace perimode {

/// Cell-centred grid: particle i sits at lower + (i + 1/2) spacing. The box holds a whole number
/// of cells to 1e-9 of one.
struct GridSpec {
  Coordinates lower, upper;
  double spacing = 0.0;
  std::vector<Region> remove = {};
  Where where = {};
};

/// Particles of a CSV file with the header x[,y[,z]],volume[,block], or of a mesh (geometry/mesh.hpp).
struct CloudSpec {
  std::filesystem::path file;
  Where where = {};
  std::vector<double> period = {};  ///< per axis, m, of the axes in Model::periodic; others are of no meaning
};

/// How far bonds reach: delta = value * spacing (ratio, grids only), delta = value (length, m),
/// or delta_i = distance to the value-th nearest other particle (neighbours).
struct HorizonSpec {
  enum class Rule { ratio, length, neighbours };
  Rule rule = Rule::ratio;
  double value = 3.0;
  Where where = {};
};

/// 1D: one point. 2D: the two ends of a segment. 3D: the corners of a plane polygon.
struct PrecrackSpec {
  std::vector<Coordinates> points;
  Where where = {};
};

struct BlockSpec {
  std::string name;
  Region region;
};

/// Everything that defines a body, before its dimension is fixed at compile time: the meaning of
/// the case file's `body`, `material(s)` and `boundary` sections (docs/case_reference.md).
struct Model {
  int dimension = 2;
  Plane plane = Plane::stress;  ///< 2D only
  double thickness = 1.0;       ///< 2D, m
  double area = 1.0;            ///< 1D, m2
  std::variant<GridSpec, CloudSpec> particles = GridSpec{};
  HorizonSpec horizon = {};
  std::array<bool, 3> periodic = {false, false, false};
  std::vector<PrecrackSpec> precracks = {};
  std::vector<BlockSpec> blocks = {};
  Material material = {};                                ///< of everything not overridden
  std::map<std::string, Material> block_materials = {};  ///< complete materials, by block name
  Calibration calibration = Calibration::continuum;
  VolumeCorrection volume_correction = VolumeCorrection::none;
  bool self_cell = false;  ///< 1D, inverse_distance: the self-cell term (docs/theory)
  std::vector<BoundaryCondition> boundary = {};
  Where where = {};  ///< of the `body` section
};

}  // namespace perimode
