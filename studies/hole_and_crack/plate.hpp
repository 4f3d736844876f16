// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "perimode/assembly/body.hpp"
#include "perimode/fracture/quasistatic.hpp"

namespace perimode::studies {

// A square plate of 0.1 m, 5 mm thick, plane stress, E = 3 GPa, G0 = 300 J/m2, with an edge crack of 25 mm
// at half its height and a hole of 12 mm radius above the crack's line, gripped below and pulled up at the
// top (both grips rigid, three rows of particles).

inline constexpr double plate_side = 0.1;                                ///< m
inline constexpr double crack_tip_x = 0.025, crack_y = 0.05;             ///< m
inline constexpr double hole_x = 0.058, hole_y = 0.061, hole_r = 0.012;  ///< m

/// `cells` along each side; horizon of 3 spacings. Given motion: 0.1 mm at load factor 1.
[[nodiscard]] Model plate_with_hole_and_crack(int cells);

/// The run from the first broken bond to separation; bonds within two horizons of the grips hold.
[[nodiscard]] QuasistaticOptions tear_apart(const Model& model, const Body<2>& body);

/// Load factor at which the first bond breaks, from one static solution and the largest stretch in it.
[[nodiscard]] double first_load_by_statics(const Model& model, const Body<2>& body);

/// What the path did, from its broken bonds.
struct Landmarks {
  std::int64_t meets = 0;   ///< event whose bonds come within a spacing of the hole from the left
  std::int64_t leaves = 0;  ///< event whose bonds are the first to the right of the hole
  double gap = 0.0;  ///< smallest distance of a broken bond's middle, left of the hole, from its rim, m
};
[[nodiscard]] Landmarks landmarks(const std::vector<BrokenBond<2>>& broken, double spacing);

}  // namespace perimode::studies
