// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "perimode/io/table.hpp"
#include "perimode/material/material.hpp"
#include "studies/common/results.hpp"

namespace perimode::studies {

// In this study Key::ratio is (horizon/spacing)^2, a whole number, and Key::horizon is not used. A body is
// named by its constants: "original" (moment integral) or "normalised" (each family exact for pure dilation).

/// "original" or "normalised".
[[nodiscard]] const char* name_of(Calibration calibration);

/// Strain energy density of a body of particles under pure dilation by 0.05, at a particle with a complete
/// family: adds energy_error, relative to 9 K s^2/2 (3D) or (12/5) K s^2 (2D plane strain; "original 2D",
/// ...).
void add_energy_error(int dimension, int squared_ratio, Calibration calibration, Results& results);

/// Rows (curve, time, x, u) = ("energy ...", 0, horizon/spacing, error) from 2 to 6 spacings, for the
/// picture.
void add_energy_scan(Table& profiles);

/// Speed of long waves along [100] over that of classical elasticity: adds speed (from the symbol of the
/// lattice at k = 1e-5/spacing) and, if `in_time`, signal_speed, measured on a standing wave of k =
/// 0.016/spacing.
void add_speed(int squared_ratio, Calibration calibration, bool in_time, Results& results);

/// The pulse exp(-(x/0.03)^2) let go at the end of a row of `cells`: adds peak (at = cells), the top of a
/// parabola through the three highest planes when a classical wave has gone 0.7, and peak_difference from the
/// closed form of the lattice. `steps`: time steps till then.
void add_peak(int cells, int squared_ratio, Calibration calibration, int steps, Results& results,
              Table& profiles);

}  // namespace perimode::studies
