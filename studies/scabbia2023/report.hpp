// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "bars.hpp"

namespace perimode::studies {

/// Prints max and L2 errors of one kind of ends against the series at the four instants, one line per m, and
/// under it the expected ones.
void print_errors(const std::string& name, const std::vector<int>& ratios, const Results& results,
                  const ExpectedResults& expected);

/// Prints observed orders of the errors at 0.2 ms.
void print_rates(const std::vector<std::string>& names, const std::vector<int>& ratios,
                 const Results& results);

/// Prints how far odd walls and surface nodes are from the closed form of odd walls, and the largest
/// displacement, at the given instants.
void print_long(const std::vector<std::string>& names, const std::vector<int>& ratios,
                const std::vector<double>& times, const Results& results);

/// Prints displacements of three cells, with the expected ones.
void print_probes(const std::vector<std::string>& names, const std::vector<int>& ratios,
                  const Results& results, const ExpectedResults& expected);

}  // namespace perimode::studies
