// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

namespace perimode::test {

/// Good cases, one per kind of body. Tests replace single lines (found by their first word).
inline const std::map<std::string, std::string>& sample_cases() {
  static const std::map<std::string, std::string> cases = {
      {"plate", R"(title: plate
body:
  dimension: 2
  plane: stress
  thickness: 0.01
  particles: { grid: { lower: [0, 0], upper: [1, 0.5], spacing: 0.1 } }
  horizon: { ratio: 3 }
  periodic: [x]
  precracks: [ { from: [0.5, 0], to: [0.5, 0.2] } ]
  blocks: { inclusion: { box: { lower: [0.4, 0.2], upper: [0.6, 0.3] } } }
material:
  youngs_modulus: 210.0e+9
  density: 7850
  micromodulus: { kernel: constant }
  volume_correction: linear
materials: { inclusion: { density: 2700 } }
boundary:
  - { fix: [x, y], at: { face: y-, layers: 2 } }
  - { wall: y+, type: mirror }
analysis: { modal: { modes: 10 } }
output: { directory: out/plate }
)"},
      {"bar", R"(title: bar
body:
  dimension: 1
  area: 1.0e-4
  particles: { grid: { lower: [0], upper: [1], spacing: 0.01 } }
  horizon: { ratio: 3 }
  precracks: []
material:
  youngs_modulus: 68.0e+9
  density: 2700
  micromodulus: { kernel: constant }
  volume_correction: linear
boundary:
  - { wall: x-, type: odd }
  - { wall: x+, type: surface_nodes, displacement: [0] }
analysis: { modal: { modes: 10 } }
)"},
      {"solid", R"(title: solid
body:
  dimension: 3
  particles: { grid: { lower: [0, 0, 0], upper: [1, 1, 1], spacing: 0.1 } }
  horizon: { ratio: 2 }
  precracks: [ { polygon: [[0, 0, 0.5], [0.5, 0, 0.5], [0.5, 1, 0.5]] } ]
material:
  youngs_modulus: 68.0e+9
  density: 2700
analysis: { modal: { modes: 10 } }
)"},
      {"cloud", R"(title: cloud
body:
  dimension: 2
  particles: { file: cloud.csv }
  horizon: { neighbours: 2 }
material:
  youngs_modulus: 68.0e+9
  density: 2700
materials: { core: { density: 1000 } }
boundary:
  - { fix: [x], at: { face: x-, depth: 0.1 } }
analysis: { modal: { modes: 2 } }
)"},
  };
  return cases;
}

inline const char* sample_cloud() { return "x,y,volume,block\n0,0,0.5,core\n1,0,0.5,\n0,1,0.5,core\n"; }

}  // namespace perimode::test
