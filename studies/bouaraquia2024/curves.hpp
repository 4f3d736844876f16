// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "perimode/io/table.hpp"
#include "rules.hpp"
#include "studies/common/results.hpp"

namespace perimode::studies {

// Figs. 2 and 4 to 10 of [bouaraquia2024]: waves of an endless bar of the steel of its fig. 12. Frequencies
// are over v = sqrt(E/rho), as the paper draws them, rad/m. Key::horizon is the horizon in m, Key::ratio
// horizon/spacing (0: the continuum), Key::body a kernel and a rule ("gaussian2 corrected").

/// Figs. 4 to 6, m = 3: spacings of 2, 1, 1/2 and 1/4 mm. Of these the paper's text names 2 mm.
inline constexpr std::array three_spacings = {0.006, 0.003, 0.0015, 0.00075};
/// Figs. 7 to 10. Of the ratios the text names 2, 3 and, for fig. 10, 10.
inline constexpr double fixed_horizon = 0.004;
inline constexpr std::array ratios = {2, 3, 5, 10};

/// One lattice of the study.
struct EndlessBar {
  Micromodulus kernel;
  Rule rule = Rule::corrected;
  double horizon = 0.0;  ///< m
  int ratio = 3;
};

/// Adds, from the lattice's symbol: omega at k = 500, 1000 and 1500 rad/m; long_wave, the speed of long waves
/// over v; band, k delta up to which the phase speed is within 5 % of v; cut_off, the largest
/// omega spacing, and cut_off_k, where, over the zone's end pi/spacing; steps v dt/spacing: step, the
/// largest stable one 2/omega_max, sufficient_step sqrt(2 rho/sum V C), printed_step of eq. (42).
void add_waves(const EndlessBar& bar, Results& results);

/// Adds omega of the continuum at k = 500, 1000 and 1500 rad/m.
void add_continuum(const Micromodulus& kernel, double horizon, Results& results);

/// Adds order, log2 of how much nearer to the continuum omega comes at k = 1000 rad/m (Key::at) when the
/// ratio is doubled.
void add_order(const EndlessBar& bar, Results& results);

/// Adds omega and band (k spacing) of finite differences, eq. (51); Key::horizon is the spacing.
void add_differences(double spacing, double courant, Results& results);

/// Adds shape, g at r/delta = 1/2 and 1 (Key::at), and c0 over that of the constant kernel, eq. (33) over
/// (26).
void add_shape(const Micromodulus& kernel, Results& results);

/// Fig. 2: rows (kernel, r/delta, g).
[[nodiscard]] Table shape_curves(const std::vector<Micromodulus>& kernels);

/// One of figs. 4 to 10.
struct Figure {
  int number = 0;
  std::vector<EndlessBar> bars = {};        ///< drawn with every rule
  std::vector<Micromodulus> continua = {};  ///< drawn for the horizon of the bars
  std::vector<double> differences = {};     ///< spacings for which eq. (51) is drawn, courant 0.5
};
[[nodiscard]] std::vector<Figure> paper_figures();

/// Rows (figure, kernel, sum, spacing, ratio, k, omega), 0 < k <= 2500 rad/m; sums are the rules, "continuum"
/// and "C=0.5" for eq. (51).
[[nodiscard]] Table dispersion_curves(const std::vector<Figure>& figures);

}  // namespace perimode::studies
