// SPDX-License-Identifier: BSD-3-Clause
#include "io/case_sections.hpp"

namespace perimode::case_file {

namespace {

Region read_traction_face(const Section& section, const BodyFacts& facts) {
  const char* example = facts.grid ? "{ face: y+, layers: 1 }" : "{ face: y+, depth: 0.01 }";
  const Cursor cursor = section.need("at", example);
  Region at = read_region(cursor, facts);
  if (!std::holds_alternative<FaceRegion>(at.shape)) {
    cursor.complain("a face for a traction", std::string("for example ") + example +
                                                 ", or give a body_force (N/m3) or a force (N) instead");
  }
  return at;
}

}  // namespace

std::vector<Load> read_loads(const Cursor& cursor, const BodyFacts& facts, InputFiles& files) {
  std::vector<Load> loads;
  for (const Cursor& item : cursor.items("[ { traction: [0, 1.0e+6], at: { face: y+, layers: 1 } } ]")) {
    const Section section(item, {"traction", "body_force", "force", "at", "time"});
    const std::string_view kind = section.exactly_one({"traction", "body_force", "force"});
    const Cursor value = *section.find(kind);
    Load load;
    load.where = item.where();
    if (kind == "traction") {
      load.what = Traction{value.point(facts.dimension, "Pa")};
      load.at = read_traction_face(section, facts);
    } else {
      if (kind == "body_force") load.what = BodyForce{value.point(facts.dimension, "N/m3")};
      if (kind == "force") load.what = TotalForce{value.point(facts.dimension, "N")};
      if (const auto at = section.find("at")) load.at = read_region(*at, facts);
    }
    if (const auto time = section.find("time")) load.time = read_time(*time, files);
    loads.push_back(std::move(load));
  }
  return loads;
}

}  // namespace perimode::case_file
