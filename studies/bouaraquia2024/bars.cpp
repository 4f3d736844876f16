// SPDX-License-Identifier: BSD-3-Clause
#include "bars.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studies/common/release.hpp"

namespace perimode::studies {
namespace {

constexpr double unit_strain = 1e-3;  // F0/(E A) of the paper
constexpr double middle = 0.5;
constexpr double sampling = bar_sampled_every * bar_step;

const double speed = std::sqrt(200e9 / 7850.0);
const double period = 4.0 / speed;

double exact_strain(double t) { return snapped_bar_strain(1.0, speed, middle, t); }

/// The strain at the middle jumps at odd multiples of L/(2c).
double distance_from_jump(double t) { return std::abs(std::remainder(t - 0.5 / speed, 1.0 / speed)); }

}  // namespace

const std::vector<EndsKind>& ends_kinds() {
  static const std::vector<EndsKind> all = {{"odd/even", {WallType::odd, WallType::even}},
                                            {"odd/free", {WallType::odd, std::nullopt}},
                                            {"zero_layer/free", {WallType::zero_layer, std::nullopt}},
                                            {"surface_nodes/free", {WallType::surface_nodes, std::nullopt}}};
  return all;
}

std::string name_of(const BarRun& run) {
  return fmt::format("{} {} {}", name_of(run.kernel), name_of(run.rule), run.ends.name);
}

void run_bar(const BarRun& run, Results& results, Table* histories) {
  const Model model = steel_bar(run.cells, run.ratio, run.kernel, correction_of(run.rule),
                                calibration_of(run.rule), run.ends.ends);
  Body<1> bar = build_body<1>(model);
  const Eigen::VectorXd u0 = along_x(bar, [](double x) { return unit_strain * x; });
  const double end = std::ceil(run.periods * period / sampling) * sampling;
  const std::vector<double> strain = strain_history(bar, u0, bar_step, end, bar_sampled_every, middle);

  const std::string name = name_of(run);
  const double horizon = static_cast<double>(run.ratio) / run.cells;
  const auto add = [&](const std::string& quantity, double at, double value) {
    results[{quantity, name, horizon, run.ratio, at}] = value;
  };
  double errors = 0.0, squares = 0.0, far = 0.0, overshoot = 0.0;
  int periods = 1;
  for (std::size_t n = 0; n < strain.size(); ++n) {
    const double t = static_cast<double>(n) * sampling, exact = exact_strain(t);
    const double error = strain[n] / unit_strain - exact;
    errors += error * error;
    squares += exact * exact;
    if (t <= period) overshoot = std::max(overshoot, strain[n] / unit_strain);
    if (t <= period && distance_from_jump(t) > 0.1 / speed) far = std::max(far, std::abs(error));
    if (t + sampling <= periods * period) continue;
    add("l2_error", periods++, std::sqrt(errors / squares));
  }
  add("far_error", 1, far);
  add("overshoot", 1, overshoot);
  for (const double t : {1e-4, 2e-4, 3e-4, 6e-4})
    add("strain", t, strain[static_cast<std::size_t>(std::lround(t / sampling))] / unit_strain);

  if (run.ends.name == "odd/even") {
    const auto lattice = released_lattice(Ends::mixed, 1.0, {u0.data(), static_cast<std::size_t>(u0.size())},
                                          stepped_relation(model, bar_step));
    const double half = 0.5 / run.cells;
    double most = 0.0;
    for (std::size_t n = 0; n < strain.size(); n += 97) {  // enough of them, no period of anything
      const double closed =
          perimode::strain(lattice, middle - half, middle + half, static_cast<double>(n) * sampling);
      most = std::max(most, std::abs(strain[n] - closed) / unit_strain);
    }
    add("discrete_error", run.periods, most);
  }
  if (histories == nullptr) return;
  const auto drawn = std::min(strain.size(), static_cast<std::size_t>(period / sampling));
  for (std::size_t n = 0; n < drawn; n += 5)
    histories->rows.push_back({fmt::format("{} m={} N={}", name, run.ratio, run.cells),
                               static_cast<double>(n) * sampling, strain[n] / unit_strain});
}

void add_exact(Table& histories) {
  histories.columns = {"curve", "time", "strain"};
  for (int n = 0; n * sampling < period; n += 5)
    histories.rows.push_back({std::string("exact"), n * sampling, exact_strain(n * sampling)});
}

}  // namespace perimode::studies
