// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "perimode/assembly/model.hpp"
#include "perimode/dispersion/lattice.hpp"
#include "studies/common/results.hpp"

namespace perimode::studies {

// The units of [alebrahim2021]: spacing, E and rho are 1, so V = sqrt(E/rho) = 1; the horizon is N spacings,
// bonds at it count whole; plates are in plane strain.

inline const std::array<std::string, 4> method_names = {"P.C", "S.C", "L.S", "G"};

/// Multipliers by name and N, one per orbit.
using Kernels = std::map<std::pair<std::string, int>, std::vector<double>>;

/// The key of a number that belongs to horizon N.
[[nodiscard]] Key key(const std::string& quantity, const std::string& body, int n, double at = 0.0);

/// The lattice with the constant kernel, the paper's original model.
template <int Dim>
[[nodiscard]] Lattice<Dim> original_lattice(int n);

/// The lattice whose bonds are multiplied by alpha (one per orbit).
template <int Dim>
[[nodiscard]] Lattice<Dim> modified_lattice(int n, const std::vector<double>& alpha);

/// A periodic body of `cells` cells along each axis with that lattice in its interior.
template <int Dim>
[[nodiscard]] Model periodic_model(int n, const std::vector<double>& alpha, int cells);

/// A printed column: the numbers quantity/body/N at 1, 2, ...; empty where there is none.
[[nodiscard]] std::vector<double> printed_column(const ExpectedResults& paper, const std::string& quantity,
                                                 const std::string& body, int n);

/// Orbit (place in Family::shell) of alpha_1, alpha_2, ... of table 2. The numbering of fig. 3 is lost; this
/// is the only one with which columns satisfy eq. (39) (add_numbering): N = 2 (1,1) (2,0) (1,0); N = 3 (2,2)
/// (2,1) (2,1) (1,1) (3,0) (2,0) (1,0).
[[nodiscard]] std::vector<int> table2_orbits(int n);

/// Numbers of a column of table 2 in the order of the orbits.
[[nodiscard]] std::vector<double> by_orbit(const std::vector<double>& numbers,
                                           const std::vector<int>& orbits);

/// omega (rad/s) of the wave with wave number k in a bar.
[[nodiscard]] double bar_frequency(const Lattice<1>& bar, double k);

/// omega^2/k^2 of long waves along x: pressure (A) and shear (B), linear in the multipliers.
[[nodiscard]] std::array<double, 2> long_wave_moduli(const Lattice<2>& plate);

}  // namespace perimode::studies
