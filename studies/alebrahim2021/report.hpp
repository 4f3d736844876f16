// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "verdicts.hpp"

namespace perimode::studies {

/// Table 1: printed, computed, difference; eq. (49) and int R^2 of all methods and of the printed columns.
void print_bars(const ExpectedResults& paper, const Results& results);
/// Speeds of long waves of the original plates, and the bar with N = 1 and 2.
void print_long_waves(const Results& results);
/// Table 2: moduli, speeds and errors of the columns as printed.
void print_table2(const Results& results);
/// Our optima: multipliers, errors, the whole zone.
void print_optima(const Results& results);
/// Eq. (50) and eq. (52).
void print_influence(const ExpectedResults& paper, const Results& results);
/// Ridges of the simulations.
void print_ridges(const Results& results);
void print_verdicts(const std::vector<Verdict>& verdicts);

}  // namespace perimode::studies
