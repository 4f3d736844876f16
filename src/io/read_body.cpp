// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "io/case_sections.hpp"
#include "perimode/geometry/grid.hpp"

namespace perimode::case_file {

namespace {

void check_whole_cells(const GridSpec& grid, int dimension) {
  switch (dimension) {
    case 1:
      (void)make_grid<1>(grid.lower, grid.upper, grid.spacing, grid.where);
      break;
    case 2:
      (void)make_grid<2>(grid.lower, grid.upper, grid.spacing, grid.where);
      break;
    default:
      (void)make_grid<3>(grid.lower, grid.upper, grid.spacing, grid.where);
      break;
  }
}

GridSpec read_grid(const Cursor& cursor, int dimension) {
  const Section section(cursor, {"lower", "upper", "spacing", "remove"});
  GridSpec grid;
  grid.where = cursor.where();
  grid.lower = section.need("lower", "[0, 0]").point(dimension);
  grid.upper = section.need("upper", "[1, 1]").point(dimension);
  grid.spacing = section.need("spacing", "0.01").number({"m", "0.01"});
  for (int a = 0; a < dimension; ++a) {
    if (!(grid.lower[a] < grid.upper[a])) {
      section.need("upper", "")
          .complain(fmt::format("a number > lower ({}) along {}", grid.lower[a], "xyz"[a]),
                    "exchange lower and upper, or widen the box");
    }
  }
  check_whole_cells(grid, dimension);
  if (const auto remove = section.find("remove")) {
    for (const Cursor& item : remove->items("[ { ball: { centre: [0, 0], radius: 0.1 } } ]")) {
      grid.remove.push_back(read_region(item, {dimension, true}));
    }
  }
  return grid;
}

CloudSpec read_cloud_file(const Cursor& cursor, InputFiles& files) {
  const std::string extension = std::filesystem::path(cursor.text("cloud.csv")).extension();
  if (extension != ".csv" && extension != ".msh" && extension != ".exo") {
    cursor.complain("a .csv, .msh or .exo file",
                    "give a table x[,y[,z]],volume[,block], a Gmsh mesh or an Exodus mesh");
  }
  return {files.add(cursor, "cloud.csv"), cursor.where(), {}};
}

HorizonSpec read_horizon(const Cursor& cursor, bool grid) {
  const Section section(cursor, {"ratio", "length", "neighbours"});
  const std::string_view rule = section.exactly_one({"ratio", "length", "neighbours"});
  HorizonSpec horizon;
  horizon.where = section.find(rule)->where();
  const Cursor value = *section.find(rule);
  if (rule == "ratio") {
    if (!grid) {
      section.refuse("ratio", "`length` or `neighbours` for a cloud, which has no spacing",
                     "write for example horizon: { neighbours: 30 }");
    }
    horizon.rule = HorizonSpec::Rule::ratio;
    horizon.value = value.number({"spacings", "3"});
  } else if (rule == "length") {
    horizon.rule = HorizonSpec::Rule::length;
    horizon.value = value.number({"m", "0.03"});
  } else {
    horizon.rule = HorizonSpec::Rule::neighbours;
    horizon.value = value.integer(1, "30");
  }
  return horizon;
}

std::array<bool, 3> read_periodic(const Cursor& cursor, const Section& particles, const Model& model) {
  const auto* cloud = std::get_if<CloudSpec>(&model.particles);
  std::array<bool, 3> periodic = {false, false, false};
  for (const Cursor& item : cursor.items("[x]")) {
    if (cloud != nullptr && cloud->period.empty()) {
      cursor.complain("no periodic axes on a cloud without a period",
                      "write particles: { file: cloud.csv, period: [1.0, 0.5] }");
    }
    const int axis = read_axis(item, model.dimension);
    if (periodic[axis]) item.complain("every axis once", "remove it");
    if (cloud != nullptr && !(cloud->period[axis] > 0.0)) {
      particles.find("period")->complain(
          fmt::format("a number > 0 along {}, which is periodic", "xyz"[axis]),
          "give the length in m after which the cloud repeats itself, or remove the axis from body.periodic");
    }
    periodic[axis] = true;
  }
  return periodic;
}

PrecrackSpec read_precrack(const Cursor& cursor, int dimension) {
  const Section section(cursor, {"from", "to", "at", "polygon"});
  PrecrackSpec crack{{}, cursor.where()};
  if (dimension == 3) {
    for (const char* key : {"from", "to", "at"})
      section.refuse(key, "`polygon` for a crack in 3D", "write polygon: [[x, y, z], ...]");
    const Cursor polygon = section.need("polygon", "[[0, 0, 0], [1, 0, 0], [1, 1, 0]]");
    const std::vector<Cursor> corners = polygon.items("[[0, 0, 0], [1, 0, 0], [1, 1, 0]]");
    if (corners.size() < 3) polygon.complain("at least 3 corners", "a crack in 3D is a plane polygon");
    for (const Cursor& corner : corners) crack.points.push_back(corner.point(3));
    return crack;
  }
  section.refuse("polygon", "a point (1D) or a segment (2D)", "a polygon is a crack in 3D");
  if (dimension == 1 && section.exactly_one({"at", "from"}) == "at") {
    section.refuse("to", "no `to` with `at`", "remove it");
    crack.points.push_back(section.find("at")->point(1));
    return crack;
  }
  section.refuse("at", "`from` and `to` for a crack in 2D", "write { from: [0, 0.5], to: [0.2, 0.5] }");
  const Coordinates from = section.need("from", dimension == 1 ? "[0.5]" : "[0, 0.5]").point(dimension);
  const Cursor to = section.need("to", dimension == 1 ? "[0.5]" : "[0.2, 0.5]");
  crack.points = {from, to.point(dimension)};
  const bool same = crack.points[0] == crack.points[1];
  if (dimension == 1) {
    if (!same) to.complain("the point of `from`", "a crack in 1D is a point: write { at: [0.5] }");
    crack.points.pop_back();
  } else if (same) {
    to.complain("a point other than `from`", "a crack has a length");
  }
  return crack;
}

std::vector<BlockSpec> read_blocks(const Cursor& cursor, const BodyFacts& facts) {
  std::vector<BlockSpec> blocks;
  for (const Cursor& entry : cursor.entries("{ inclusion: { box: { lower: [0, 0], upper: [1, 1] } } }")) {
    const std::string& name = entry.node().key;
    if (name.empty()) {
      invalid_input({"a name for the block", "an empty key", "write for example inclusion: { ... }",
                     entry.node().key_where});
    }
    BlockSpec block{name, read_region(entry, facts)};
    if (std::holds_alternative<BlockRegion>(block.region.shape)) {
      entry.complain("a place (face, box, ball or nearest)", "a block is not defined by a block");
    }
    blocks.push_back(std::move(block));
  }
  return blocks;
}

void read_section_size(const Section& body, Model& model) {
  if (model.dimension != 2) {
    const std::string only = fmt::format("no such key in {}D", model.dimension);
    body.refuse("plane", only, "plane belongs to dimension 2");
    body.refuse("thickness", only, "thickness belongs to dimension 2");
  }
  if (model.dimension != 1) {
    body.refuse("area", fmt::format("no such key in {}D", model.dimension), "area belongs to dimension 1");
  }
  if (const auto plane = body.find("plane")) {
    model.plane = plane->choice<Plane>({{"stress", Plane::stress}, {"strain", Plane::strain}});
  }
  if (const auto thickness = body.find("thickness")) model.thickness = thickness->number({"m", "0.01"});
  if (const auto area = body.find("area")) model.area = area->number({"m2", "1.0e-4"});
}

}  // namespace

void read_body(const Cursor& cursor, InputFiles& files, Model& model) {
  const Section body(cursor, {"dimension", "plane", "thickness", "area", "particles", "horizon", "periodic",
                              "precracks", "blocks"});
  model.where = cursor.where();
  model.dimension = body.need("dimension", "2").choice<int>({{"1", 1}, {"2", 2}, {"3", 3}});
  read_section_size(body, model);

  const Section particles(body.need("particles", "{ grid: { lower: [0, 0], upper: [1, 1], spacing: 0.01 } }"),
                          {"grid", "file", "period"});
  if (particles.exactly_one({"grid", "file"}) == "grid") {
    particles.refuse("period", "no `period` on a grid", "its box is the period; remove it");
    model.particles = read_grid(*particles.find("grid"), model.dimension);
  } else {
    CloudSpec cloud = read_cloud_file(*particles.find("file"), files);
    if (const auto period = particles.find("period")) cloud.period = period->point(model.dimension);
    model.particles = std::move(cloud);
  }
  const BodyFacts facts = facts_of(model);
  model.horizon = read_horizon(body.need("horizon", "{ ratio: 3 }"), facts.grid);
  if (const auto periodic = body.find("periodic"))
    model.periodic = read_periodic(*periodic, particles, model);
  if (const auto cracks = body.find("precracks")) {
    for (const Cursor& item : cracks->items("[ { from: [0, 0.5], to: [0.2, 0.5] } ]")) {
      model.precracks.push_back(read_precrack(item, model.dimension));
    }
  }
  if (const auto blocks = body.find("blocks")) model.blocks = read_blocks(*blocks, facts);
}

}  // namespace perimode::case_file
