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

Prescribe read_prescribe(const Section& section, const BodyFacts& facts, InputFiles& files) {
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
  if (const auto time = section.find("time")) prescribe.time = read_time(*time, files);
  return prescribe;
}

/// What surface nodes do: u_s(x, y, z), or in 1D the force through the surface.
void read_surface(const Section& section, int dimension, InputFiles& files, Wall& wall) {
  const std::string_view given = section.at_most_one({"displacement", "traction"});
  if (dimension != 1) {
    section.refuse("traction", fmt::format("no `traction` of a wall in {}D", dimension),
                   "give the load as a traction on the particles at the face, in the analysis' loads");
  }
  if (given.empty()) section.refuse("time", "no time function with a surface at rest", "remove it");
  if (given == "displacement") {
    wall.displacement = read_formulas(*section.find("displacement"), dimension);
  } else if (given == "traction") {
    wall.traction = section.find("traction")->number({"Pa", "1.0e+6", Sign::any});
  }
  if (const auto time = section.find("time")) wall.time = read_time(*time, files);
}

Wall read_wall(const Section& section, const Model& model, InputFiles& files,
               std::map<std::pair<int, bool>, Where>& walls) {
  const Cursor face = *section.find("wall");
  section.refuse("at", "no `at` with a wall", "a wall lies on its face");
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
  if (wall.type == WallType::surface_nodes) {
    read_surface(section, model.dimension, files, wall);
  } else {
    for (const char* key : {"displacement", "traction", "time"})
      section.refuse(key, fmt::format("`{}` with the type surface_nodes only", key), "remove it");
  }
  return wall;
}

}  // namespace

void read_boundary(const Cursor& cursor, InputFiles& files, Model& model) {
  const BodyFacts facts = facts_of(model);
  std::map<std::pair<int, bool>, Where> walls;
  for (const Cursor& item : cursor.items("[ { fix: [x], at: { face: x-, layers: 3 } } ]")) {
    const Section section(item,
                          {"fix", "prescribe", "wall", "at", "type", "displacement", "traction", "time"});
    BoundaryCondition condition;
    condition.where = item.where();
    const std::string_view kind = section.exactly_one({"fix", "prescribe", "wall"});
    if (kind != "wall") {
      section.refuse("type", fmt::format("no `type` with {}", kind), "it belongs to a wall");
      for (const char* key : {"displacement", "traction"})
        section.refuse(key, fmt::format("no `{}` with {}", key, kind),
                       "it belongs to a wall of type surface_nodes");
    }
    if (kind == "fix") condition.what = read_fix(section, facts);
    if (kind == "prescribe") condition.what = read_prescribe(section, facts, files);
    if (kind == "wall") condition.what = read_wall(section, model, files, walls);
    model.boundary.push_back(std::move(condition));
  }
}

}  // namespace perimode::case_file
