// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "studies/common/results.hpp"

namespace perimode::studies {

/// Prints one line per m and listed mode: relative errors of a bar's frequencies at one horizon against
/// separation of variables, under each the expected ones (where known) and the order of convergence.
void print_bar(const std::string& name, double horizon, const std::vector<int>& ratios,
               const Results& results, const ExpectedResults& expected);

/// Prints how far surface nodes stay away from odd walls, and how real their spectrum is.
void print_surface_nodes(double horizon, const std::vector<int>& ratios, const Results& results,
                         const ExpectedResults& expected);

/// Prints the first mode of a bar for falling horizons at fixed m against both continua.
void print_horizons(const std::string& name, const std::vector<double>& horizons, int ratio,
                    const Results& results);

/// Prints the plates: lattice against its closed form and against the continuum.
void print_plates(const std::vector<int>& ratios, const Results& results, const ExpectedResults& expected);

}  // namespace perimode::studies
