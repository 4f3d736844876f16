// SPDX-License-Identifier: BSD-3-Clause
#include "bars.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "perimode/dispersion/optimise.hpp"
#include "perimode/dispersion/zone.hpp"

namespace perimode::studies {
namespace {

using std::numbers::pi;

OptimiseOptions options_of(const std::string& method) {
  OptimiseOptions options;
  if (method == "P.C") options.method = OptimiseMethod::point_collocation;
  if (method == "S.C") options.method = OptimiseMethod::subdomain_collocation;
  if (method == "G") options.method = OptimiseMethod::galerkin;
  if (method == "L1") options.norm = ErrorNorm::l1;
  return options;
}

void add_errors(const std::string& name, int n, const std::vector<double>& alpha, Results& results) {
  static const double scale = contour_error<1>(original_lattice<1>(3)).l1;
  const ContourError error = contour_error<1>(modified_lattice<1>(n, alpha));
  results[key("error49", name, n)] = error.l1 / scale;
  results[key("squared_residual", name, n)] = error.l2;
}

/// sum i alpha_i - N^2/2, eq. (34).
double constraint_residual(int n, const std::vector<double>& alpha) {
  double sum = -0.5 * n * n;
  for (int i = 1; i <= n; ++i) sum += i * alpha[static_cast<std::size_t>(i - 1)];
  return sum;
}

double bisect(double low, double high, const std::function<double(double)>& f) {
  const bool rising = f(high) > f(low);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    ((f(middle) > 0.0) == rising ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

Kernels optimised_bars(const std::vector<int>& horizons, Results& results) {
  Kernels bars;
  results[key("error49_original", "original", 3)] = contour_error<1>(original_lattice<1>(3)).l1;
  for (const int n : horizons) {
    bars[{"original", n}].assign(static_cast<std::size_t>(n), 1.0);
    for (const std::string method : {"P.C", "S.C", "L.S", "G", "L1"}) {
      const OptimisedMicromodulus found =
          optimise_micromodulus<1>(original_lattice<1>(n), options_of(method));
      bars[{method, n}] = found.alpha;
      results[key("constraint", method, n)] = constraint_residual(n, found.alpha);
      results[key("optimality", method, n)] = found.optimality;
      for (int i = 1; i <= n; ++i)
        results[key("alpha", method, n, i)] = found.alpha[static_cast<std::size_t>(i - 1)];
    }
  }
  for (const auto& [name, alpha] : bars) add_errors(name.first, name.second, alpha, results);
  return bars;
}

void add_printed_bars(const ExpectedResults& paper, Results& results, Kernels& bars) {
  for (const std::string& method : method_names)
    for (const int n : {3, 5, 10}) {
      const std::string name = method + " printed";
      bars[{name, n}] = printed_column(paper, "alpha", method, n);
      add_errors(name, n, bars[{name, n}], results);
      results[key("constraint", name, n)] = constraint_residual(n, bars[{name, n}]);
    }
}

void add_bands(const ExpectedResults& paper, Results& results, Kernels& bars) {
  bars[{"modified", 2}] = printed_column(paper, "alpha", "G", 2);
  for (const std::string name : {"original", "modified", "S.C"}) {
    const Lattice<1> bar = modified_lattice<1>(2, bars.at({name, 2}));
    const BranchBand band = branch_band<1>(bar, Branch::pressure, Point<1>(1.0), pi, 0.05);
    results[key("long_wave_excess", name, 2)] = band.long_wave_ratio - 1.0;
    results[key("crossing", name, 2)] = band.crossings.empty() ? 0.0 : band.crossings.back();
    results[key("cut_off", name, 2)] = band.cut_off;
    results[key("overshoot", name, 2)] = band.worst_overshoot;
    results[key("overshoot_k", name, 2)] = band.worst_overshoot_k;
    results[key("band_k", name, 2)] = band.band_k;
  }
  const Lattice<1> bar = modified_lattice<1>(2, bars.at({"modified", 2}));
  const double k = bisect(0.1, 2.5, [&](double x) { return bar_frequency(bar, x) - 2.25; });
  results[key("error_at_2.25", "modified", 2)] = 2.25 / k - 1.0;
  const double unit = bisect(1.0, 2.8, [&](double x) {
    return plane_waves<1>(bar, Point<1>(x), Point<1>(1.0)).group_velocity[0][0] - 1.0;
  });
  results[key("unit_group_velocity", "modified", 2)] = bar_frequency(bar, unit);
}

void add_nearest_neighbours(Results& results) {
  const Point<1> along(1.0);
  results[key("long_wave_speed", "bar", 1)] =
      plane_waves<1>(original_lattice<1>(1), Point<1>(0.0), along).phase_velocity[0];
  const Lattice<1> modified = modified_lattice<1>(1, {0.5});
  double difference = 0.0;
  for (int i = 1; i <= 1000; ++i) {
    const double k = i * pi / 1000.0;
    difference = std::max(
        difference, std::abs(bar_frequency(modified, k) - finite_difference_frequency(k, 1.0, 1.0, 0.0)));
  }
  results[key("finite_difference", "modified", 1)] = difference;
}

}  // namespace perimode::studies
