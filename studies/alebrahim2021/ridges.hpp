// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "figure.hpp"
#include "lattices.hpp"

namespace perimode::studies {

/// A run from which omega(k) is read: a periodic body let go at rest from a Gaussian of width 0.6 spacings,
/// central differences of step 0.1, `instants` of them.
struct RidgeRun {
  std::string panel;  ///< of the figure; plates: of pressure waves
  std::string body;   ///< "original", "modified"
  int n = 1;          ///< N
  std::vector<double> alpha;
  int cells = 512;  ///< along every axis
  int instants = 4096;
  std::string shear_panel = {};
  std::string row_panel = {};  ///< plates: what one row of nodes would show; empty: left out
};

/// ridge_error: largest |omega - eq. (10)| from the seventh k on; ridge_bins: the largest difference from
/// what the integrator makes of it, (2/dt) asin(omega dt/2), in bins 2 pi/(instants dt). time_step_shift: the
/// largest difference of that from omega. With a figure, the map, the ridge and the curves.
void run_bar_ridge(const RidgeRun& run, Results& results, Figure* figure);

/// The same along O-M-Y-O for both branches against eq. (15), from waves sorted out over the whole grid.
/// row_panel: the spectrum of u_x along one row of nodes, in which waves of all k_y lie on top of each
/// other, with the frequencies at which they gather, d omega/d k_y = 0: the paper's higher-order ghosts.
/// row_ghost, row_peaks: share of the row's peaks (a tenth of the largest at their k, or more) within a bin
/// of such a frequency, and their number.
void run_plate_ridge(const RidgeRun& run, Results& results, Figure* figure);

}  // namespace perimode::studies
