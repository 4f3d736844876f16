// SPDX-License-Identifier: BSD-3-Clause
#include "curves.hpp"

#include <cmath>
#include <numbers>
#include <numeric>

#include "perimode/dispersion/zone.hpp"
#include "perimode/material/micromodulus.hpp"

namespace perimode::studies {
namespace {

constexpr double probes[] = {500.0, 1000.0, 1500.0};  // rad/m
constexpr double drawn_every = 12.5;                  // rad/m
constexpr double longest_k = 2500.0;
constexpr double band_error = 0.05;
constexpr double courant_drawn = 0.5;

Medium steel(const Micromodulus& kernel, double horizon) {
  Medium medium;
  medium.material.youngs_modulus = 200e9;
  medium.material.density = 7850.0;
  medium.material.micromodulus = kernel;
  medium.continuum = {1, Plane::stress, 1e-6};
  medium.horizon = horizon;
  return medium;
}

Lattice<1> lattice_of(const EndlessBar& bar) {
  Lattice<1> lattice;
  lattice.medium = steel(bar.kernel, bar.horizon);
  lattice.family = make_family<1>(bar.horizon / bar.ratio, bar.horizon, correction_of(bar.rule));
  lattice.rates = bond_rates<1>(lattice.medium, lattice.family, calibration_of(bar.rule));
  return lattice;
}

double speed(const Medium& medium) { return classical_speed(medium, Branch::pressure); }

double omega(const Lattice<1>& lattice, double k) {
  return std::sqrt(lattice_symbol<1>(lattice.family, lattice.rates, Point<1>(k))(0, 0)) /
         speed(lattice.medium);
}

double omega(const Medium& medium, double k) {
  return continuum_frequency(medium, Branch::pressure, k) / speed(medium);
}

std::string body_of(const EndlessBar& bar) { return name_of(bar.kernel) + " " + name_of(bar.rule); }

}  // namespace

void add_waves(const EndlessBar& bar, Results& results) {
  const Lattice<1> lattice = lattice_of(bar);
  const auto add = [&](const char* quantity, double at, double value) {
    results[{quantity, body_of(bar), bar.horizon, bar.ratio, at}] = value;
  };
  for (const double k : probes) add("omega", k, omega(lattice, k));

  const double spacing = lattice.family.spacing, end = std::numbers::pi / spacing;
  const double v = speed(lattice.medium);
  const BranchBand band = branch_band<1>(lattice, Branch::pressure, Point<1>(1.0), end, band_error);
  add("long_wave", 0.0, band.long_wave_ratio);
  add("band", 0.0, band.band_k * bar.horizon);
  add("cut_off", 0.0, band.cut_off / v * spacing);
  add("cut_off_k", 0.0, band.cut_off_k / end);
  const double sum = std::accumulate(lattice.rates.begin(), lattice.rates.end(), 0.0);  // sum V C/rho
  add("step", 0.0, v / spacing * 2.0 / band.cut_off);
  add("sufficient_step", 0.0, v / spacing * std::sqrt(2.0 / sum));
  add("printed_step", 0.0, v / spacing * std::sqrt(1.0 / sum));
}

void add_continuum(const Micromodulus& kernel, double horizon, Results& results) {
  for (const double k : probes)
    results[{"omega", name_of(kernel) + " continuum", horizon, 0, k}] = omega(steel(kernel, horizon), k);
}

void add_order(const EndlessBar& bar, Results& results) {
  constexpr double k = 1000.0;
  const double limit = omega(steel(bar.kernel, bar.horizon), k);
  EndlessBar finer = bar;
  finer.ratio *= 2;
  results[{"order", body_of(bar), bar.horizon, bar.ratio, k}] =
      std::log2(std::abs(omega(lattice_of(bar), k) - limit) / std::abs(omega(lattice_of(finer), k) - limit));
}

void add_differences(double spacing, double courant, Results& results) {
  const auto of = [&](double k) { return finite_difference_frequency(k, 1.0, spacing, courant); };
  const auto add = [&](const char* quantity, double at, double value) {
    results[{quantity, fmt::format("differences C={:g}", courant), spacing, 1, at}] = value;
  };
  for (const double k : probes) add("omega", k, of(k));
  double inside = 0.0, outside = std::numbers::pi / spacing;  // omega/k falls all the way
  for (int halving = 0; halving < 60; ++halving) {
    const double k = 0.5 * (inside + outside);
    (of(k) < (1.0 - band_error) * k ? outside : inside) = k;
  }
  add("band", 0.0, inside * spacing);
}

void add_shape(const Micromodulus& kernel, Results& results) {
  const Medium medium = steel(kernel, 1.0);
  for (const double r : {0.5, 1.0})
    results[{"shape", name_of(kernel), 1.0, 0, r}] = kernel_shape(kernel, r, 1.0);
  results[{"c0", name_of(kernel), 1.0, 0, 0.0}] =
      micromodulus_constant(medium) / micromodulus_constant(steel(constant, 1.0));
}

Table shape_curves(const std::vector<Micromodulus>& kernels) {
  Table table;
  table.columns = {"kernel", "r", "shape"};
  constexpr int points = 200;
  table.rows.reserve(kernels.size() * points);
  for (const Micromodulus& kernel : kernels)
    for (int i = 1; i <= points; ++i) {
      const double r = static_cast<double>(i) / points;
      table.rows.push_back({name_of(kernel), r, kernel_shape(kernel, r, 1.0)});
    }
  return table;
}

std::vector<Figure> paper_figures() {
  std::vector<Figure> figures = {{4}, {5}, {6}, {7}, {8}, {9}, {10}};
  const Micromodulus drawn[] = {gaussian(1.0), gaussian(2.0), constant};
  for (std::size_t i = 0; i < 3; ++i) {
    for (const double horizon : three_spacings)
      figures[i].bars.push_back({drawn[i], Rule::corrected, horizon, 3});
    for (const int m : ratios) figures[i + 3].bars.push_back({drawn[i], Rule::corrected, fixed_horizon, m});
    figures[i + 3].continua = {drawn[i]};
    figures[6].bars.push_back({drawn[i], Rule::corrected, fixed_horizon, 10});
  }
  figures[2].differences = {0.002};
  return figures;
}

Table dispersion_curves(const std::vector<Figure>& figures) {
  Table table;
  table.columns = {"figure", "kernel", "sum", "spacing", "ratio", "k", "omega"};
  const auto draw = [&](int figure, const std::string& kernel, const std::string& sum, double spacing,
                        int ratio, const auto& frequency) {
    for (int i = 1; i * drawn_every <= longest_k; ++i)
      table.rows.push_back(
          {Offset{figure}, kernel, sum, spacing, Offset{ratio}, i * drawn_every, frequency(i * drawn_every)});
  };
  for (const Figure& figure : figures) {
    for (EndlessBar bar : figure.bars)
      for (const Rule rule : rules) {
        bar.rule = rule;
        const Lattice<1> lattice = lattice_of(bar);
        draw(figure.number, name_of(bar.kernel), name_of(rule), lattice.family.spacing, bar.ratio,
             [&](double k) { return omega(lattice, k); });
      }
    for (const Micromodulus& kernel : figure.continua) {
      const Medium medium = steel(kernel, figure.bars.front().horizon);
      draw(figure.number, name_of(kernel), "continuum", 0.0, 0, [&](double k) { return omega(medium, k); });
    }
    for (const double spacing : figure.differences)
      draw(figure.number, "differences", fmt::format("C={:g}", courant_drawn), spacing, 1,
           [&](double k) { return finite_difference_frequency(k, 1.0, spacing, courant_drawn); });
  }
  return table;
}

}  // namespace perimode::studies
