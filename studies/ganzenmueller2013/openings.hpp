// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "perimode/material/material.hpp"
#include "studies/common/results.hpp"

namespace perimode::studies {

// The crack opening (studies/common/crack_opening.hpp). Key::ratio is horizon/spacing, Key::at cells across
// the width, Key::body the constants: "full" (families as before the crack is cut), "cut" (as after it),
// "bulk" (the moment integral). Loads are over that of linear elastic fracture mechanics.

[[nodiscard]] const char* name_of_constants(Calibration calibration);

/// Adds first (load of the first failure), peak (largest load until it has fallen by 30 %), griffith (load
/// by compliance, over LEFM in the middle of its increment), and what the run took: events, bonds, seconds,
/// balance, updated and fresh (solutions), factor_seconds.
void add_opening(int cells, int ratio, Calibration calibration, Results& results);

/// Adds griffith alone.
void add_opening_griffith(int cells, int ratio, Calibration calibration, Results& results);

/// The same patch as the paper did it: tractions that rise from 0 to 1.5 times the critical one within
/// `seconds`, in explicit steps. Adds ramp_first (load at the first break) and ramp_collapse (load when
/// bonds for ten spacings of crack have broken), both over LEFM with the critical stretch of
/// crack_opening_run, ramp_transits (waves through the height within the ramp) and ramp_velocity (speed of
/// the loaded rows until the first break, mean, over that of sound). Horizon of 3 spacings, "full".
void add_ramped_opening(int cells, double seconds, Results& results);

}  // namespace perimode::studies
