// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "perimode/assembly/model.hpp"
#include "perimode/reference/wave_in_bar.hpp"

namespace perimode::studies {

/// What stands at the two ends of a bar: a wall each, or nothing (a free end).
using BarEnds = std::pair<std::optional<WallType>, std::optional<WallType>>;

/// The bar of [scabbia2023]: length 1 m, inverse-distance kernel, wave speed 5000 m/s, bonds at the horizon
/// counted half; `ratio` cells per horizon, so ratio/horizon cells in all.
/// @pre ratio/horizon is a whole number.
[[nodiscard]] Model separable_bar(double horizon, int ratio, const BarEnds& ends, bool self_cell = false);

/// What that bar is let go from, [scabbia2023] eq. (10): 0.02 exp(-100 (x - 1/2)^2), m.
[[nodiscard]] double scabbia_pulse(double x);

/// Its motion by separation of variables, [scabbia2023] eq. (11): 40 odd terms with frequencies omega(k).
[[nodiscard]] std::vector<StandingWave> scabbia_series(const DispersionRelation& omega);

/// Plate 1 m x 0.5 m in plane stress with E = rho = 1 and the same wall (mirror or antimirror) on its four
/// edges, linear volume correction; `cells` along x, an even number.
[[nodiscard]] Model separable_plate(int cells, double ratio, const Micromodulus& kernel, WallType wall);

/// The bar of [bouaraquia2024] fig. 12: 1 m, 1 mm2, steel of E = 200 GPa and rho = 7850 kg/m3, odd wall at
/// x = 0 (or what `ends` say), even wall at x = 1.
[[nodiscard]] Model steel_bar(int cells, int ratio, const Micromodulus& kernel, VolumeCorrection correction,
                              Calibration calibration, const BarEnds& ends = {WallType::odd, WallType::even});

/// The solid of [ganzenmueller2013]: bulk modulus 1 (E = 3/2, nu = 1/4), rho = 1, bonds of energy density
/// c s^2/2, which is the inverse-distance kernel; a cubic (3D) or square (2D, plane strain)
/// lattice of spacing `spacing`, horizon sqrt(squared_ratio) spacings, all bonds at the horizon counted
/// whole. `cells` along each axis; walls and periodic axes are the caller's.
[[nodiscard]] Model pmb_lattice(const std::vector<int>& cells, double spacing, int squared_ratio,
                                Calibration calibration);

/// A row of `cells` of that solid over 0 <= x <= 1, one cell thick and periodic in y and z: planes of a 3D
/// lattice that move along x. Antimirror walls at its ends (their motion is even about them), or periodic in
/// x.
[[nodiscard]] Model pmb_row(int cells, int squared_ratio, Calibration calibration, bool periodic = false);

/// A bar of that solid over 0 <= x <= 1 made of a file's particles, each with a horizon that holds its
/// `neighbours` nearest, constants normalised, that moves along x alone (u_y = u_z = 0): pressure waves
/// between free ends.
[[nodiscard]] Model pmb_cloud(const std::filesystem::path& file, int neighbours);

/// Speed of pressure waves of that solid in three dimensions, sqrt(1.8 K/rho), m/s.
[[nodiscard]] double pmb_speed();

}  // namespace perimode::studies
