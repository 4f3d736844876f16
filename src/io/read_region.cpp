// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "io/case_sections.hpp"

namespace perimode::case_file {

namespace {

constexpr std::string_view axis_names = "xyz";

FaceRegion read_face_region(const Section& region, const BodyFacts& facts) {
  FaceRegion result;
  result.face = read_face(region.need("face", "x-"), facts.dimension);
  if (facts.grid) {
    region.refuse("depth", "`layers` with a face of a grid", "write for example layers: 3");
    result.layers = region.need("layers", "3").integer(1, "3");
  } else {
    region.refuse("layers", "`depth` (m) with a face of a cloud, which has no layers",
                  "write for example depth: 0.03");
    result.depth = region.need("depth", "0.03").number({"m", "0.03"});
  }
  return result;
}

BoxRegion read_box(const Cursor& cursor, int dimension) {
  const Section box(cursor, {"lower", "upper"});
  BoxRegion result{box.need("lower", "[0, 0]").point(dimension),
                   box.need("upper", "[1, 1]").point(dimension)};
  for (int a = 0; a < dimension; ++a) {
    if (result.lower[a] > result.upper[a]) {
      box.need("upper", "")
          .complain(fmt::format("a number >= lower ({}) along {}", result.lower[a], axis_names[a]),
                    "exchange lower and upper");
    }
  }
  return result;
}

BallRegion read_ball(const Cursor& cursor, int dimension) {
  const Section ball(cursor, {"centre", "radius"});
  return {ball.need("centre", "[0, 0]").point(dimension), ball.need("radius", "0.1").number({"m", "0.1"})};
}

}  // namespace

BodyFacts facts_of(const Model& model) {
  return {model.dimension, std::holds_alternative<GridSpec>(model.particles)};
}

int read_axis(const Cursor& cursor, int dimension) {
  switch (dimension) {
    case 1:
      return cursor.choice<int>({{"x", 0}});
    case 2:
      return cursor.choice<int>({{"x", 0}, {"y", 1}});
    default:
      return cursor.choice<int>({{"x", 0}, {"y", 1}, {"z", 2}});
  }
}

Face read_face(const Cursor& cursor, int dimension) {
  const Face xl{0, false}, xu{0, true}, yl{1, false}, yu{1, true}, zl{2, false}, zu{2, true};
  switch (dimension) {
    case 1:
      return cursor.choice<Face>({{"x-", xl}, {"x+", xu}});
    case 2:
      return cursor.choice<Face>({{"x-", xl}, {"x+", xu}, {"y-", yl}, {"y+", yu}});
    default:
      return cursor.choice<Face>({{"x-", xl}, {"x+", xu}, {"y-", yl}, {"y+", yu}, {"z-", zl}, {"z+", zu}});
  }
}

Region read_region(const Cursor& cursor, const BodyFacts& facts) {
  const Section region(cursor, {"face", "layers", "depth", "box", "ball", "block", "nearest"});
  const std::string_view shape = region.exactly_one({"face", "box", "ball", "block", "nearest"});
  Region result;
  result.where = region.where();
  if (shape == "face") {
    result.shape = read_face_region(region, facts);
    return result;
  }
  for (const char* key : {"layers", "depth"}) {
    region.refuse(key, fmt::format("no {} with {}", key, shape), fmt::format("{} belongs to a face", key));
  }
  const Cursor value = *region.find(shape);
  if (shape == "box") result.shape = read_box(value, facts.dimension);
  if (shape == "ball") result.shape = read_ball(value, facts.dimension);
  if (shape == "block") result.shape = BlockRegion{value.text("inclusion")};
  if (shape == "nearest") result.shape = NearestRegion{value.point(facts.dimension)};
  return result;
}

}  // namespace perimode::case_file
