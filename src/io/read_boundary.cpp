// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <map>

#include "io/case_sections.hpp"

namespace perimode::case_file {

namespace {

Fix read_fix(const Section& section, const BodyFacts& facts) {
  section.refuse("time", "no time function with fix", "fix is u = 0 at all times");
  const Cursor list = *section.find("fix");
  Fix fix;
  for (const Cursor& item : list.items("[x]")) {
    const int component = read_axis(item, facts.dimension);
    for (int earlier : fix.components) {
      if (earlier == component) item.complain("every component once", "remove it");
    }
    fix.components.push_back(component);
  }
  if (fix.components.empty()) list.complain("at least one component", "for example [x]");
  fix.at = read_region(section.need("at", "{ face: x-, layers: 3 }"), facts);
  return fix;
}

Prescribe read_prescribe(const Section& section, const BodyFacts& facts) {
  const Cursor map = *section.find("prescribe");
  const Section components = facts.dimension == 1   ? Section(map, {"x"})
                             : facts.dimension == 2 ? Section(map, {"x", "y"})
                                                    : Section(map, {"x", "y", "z"});
  Prescribe prescribe;
  for (int a = 0; a < facts.dimension; ++a) {
    const auto value = components.find(std::string_view("xyz").substr(a, 1));
    if (value) prescribe.components.emplace_back(a, value->number({"m", "1.0e-4", Sign::any}));
  }
  if (prescribe.components.empty()) map.complain("at least one component", "for example { y: 1.0e-4 }");
  prescribe.at = read_region(section.need("at", "{ face: y+, layers: 3 }"), facts);
  if (const auto time = section.find("time")) check_time(*time);
  return prescribe;
}

Wall read_wall(const Section& section, const Model& model, std::map<std::pair<int, bool>, Where>& walls) {
  const Cursor face = *section.find("wall");
  section.refuse("at", "no `at` with a wall", "a wall lies on its face");
  section.refuse("time", "no time function with a wall", "a wall does not move");
  if (!std::holds_alternative<GridSpec>(model.particles)) {
    face.complain("no wall on a cloud", "walls need a grid; fix the outermost particles instead");
  }
  Wall wall;
  wall.face = read_face(face, model.dimension);
  if (model.periodic[wall.face.axis]) {
    face.complain(fmt::format("no wall along {}, which is periodic", "xyz"[wall.face.axis]),
                  "remove the wall, or the axis from body.periodic");
  }
  const auto [earlier, is_new] = walls.emplace(std::pair{wall.face.axis, wall.face.upper}, face.where());
  if (!is_new) {
    const int line = earlier->second.line;
    face.complain("one wall on a face",
                  line > 0 ? fmt::format("the first is in line {}: keep one", line) : "keep one");
  }
  const Cursor type = section.need("type", "mirror");
  wall.type = type.choice<WallType>({{"odd", WallType::odd},
                                     {"even", WallType::even},
                                     {"mirror", WallType::mirror},
                                     {"antimirror", WallType::antimirror},
                                     {"zero_layer", WallType::zero_layer},
                                     {"surface_nodes", WallType::surface_nodes}});
  if (wall.type != WallType::surface_nodes) {
    section.refuse("displacement", "`displacement` with the type surface_nodes only", "remove it");
  } else if (model.dimension != 1) {
    type.complain("odd, even, mirror, antimirror or zero_layer", "surface_nodes is available in 1D only");
  }
  if (const auto u = section.find("displacement")) {
    for (const double component : u->point(model.dimension))
      wall.displacement.emplace_back(fmt::format("{:.17g}", component), u->where());
  }
  return wall;
}

}  // namespace

void check_time(const Cursor& cursor) {
  if (cursor.node().kind == CaseNode::Kind::scalar && cursor.node().text == "constant") return;
  const Section time(cursor,
                     {"constant", "ramp", "step", "half_sine", "ricker", "gaussian", "table", "expression"});
  (void)time.exactly_one(
      {"constant", "ramp", "step", "half_sine", "ricker", "gaussian", "table", "expression"});
}

void read_boundary(const Cursor& cursor, Model& model) {
  const BodyFacts facts = facts_of(model);
  std::map<std::pair<int, bool>, Where> walls;
  for (const Cursor& item : cursor.items("[ { fix: [x], at: { face: x-, layers: 3 } } ]")) {
    const Section section(item, {"fix", "prescribe", "wall", "at", "type", "displacement", "time"});
    BoundaryCondition condition;
    condition.where = item.where();
    const std::string_view kind = section.exactly_one({"fix", "prescribe", "wall"});
    if (kind != "wall") {
      section.refuse("type", fmt::format("no `type` with {}", kind), "it belongs to a wall");
      section.refuse("displacement", fmt::format("no `displacement` with {}", kind),
                     "it belongs to a wall of type surface_nodes");
    }
    if (kind == "fix") condition.what = read_fix(section, facts);
    if (kind == "prescribe") condition.what = read_prescribe(section, facts);
    if (kind == "wall") condition.what = read_wall(section, model, walls);
    model.boundary.push_back(std::move(condition));
  }
}

}  // namespace perimode::case_file
