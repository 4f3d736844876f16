// SPDX-License-Identifier: BSD-3-Clause
#include "bars.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "perimode/reference/separation.hpp"
#include "studies/common/models.hpp"
#include "studies/common/release.hpp"

namespace perimode::studies {
namespace {

constexpr double speed = 5000.0;
constexpr Index few_cells = 2000;

BarEnds ends_of(const std::string& name) {
  if (name.starts_with("surface_nodes")) return {WallType::surface_nodes, WallType::surface_nodes};
  if (name.starts_with("odd")) return {WallType::odd, WallType::odd};
  if (name.starts_with("zero_layer")) return {WallType::zero_layer, WallType::zero_layer};
  return {};
}

double separated(double k) { return speed * std::sqrt(scabbia_lambda(pulse_horizon, k)); }
double classical(double k) { return speed * k; }

void add_curve(Table& profiles, const std::string& curve, double time, const std::vector<double>& x,
               const std::function<double(std::size_t)>& u) {
  for (std::size_t i = 0; i < x.size(); ++i) profiles.rows.push_back({curve, time, x[i], u(i)});
}

}  // namespace

const std::vector<double>& pulse_times() {
  static const std::vector<double> times = {0.05e-3, 0.10e-3, 0.15e-3, 0.20e-3};
  return times;
}

void run_bar(const BarRun& run, Results& results, Table* profiles) {
  const Model model = separable_bar(pulse_horizon, run.ratio, ends_of(run.name),
                                    run.name.find("self_cell") != std::string::npos);
  Body<1> body = build_body<1>(model);
  const Eigen::VectorXd u0 = along_x(body, scabbia_pulse);
  const auto fields = release(body, u0, run.dt, run.times);

  std::vector<double> x;
  x.reserve(body.particles.position.size());
  for (const Point<1>& p : body.particles.position) x.push_back(p[0]);
  const double dx = body.particles.grid->spacing;
  const std::vector<StandingWave> series = scabbia_series(separated);
  std::vector<StandingWave> lattice;
  if (body.count() <= few_cells)
    lattice = released_lattice(Ends::mirror, 1.0, {u0.data(), x.size()}, stepped_relation(model, run.dt));

  for (std::size_t n = 0; n < run.times.size(); ++n) {
    const double t = run.times[n];
    const Eigen::VectorXd& u = fields[n];
    double most = 0.0, squares = 0.0, discrete = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double ui = u[static_cast<Eigen::Index>(i)];
      const double error = ui - displacement(series, x[i], t);
      most = std::max(most, std::abs(error));
      squares += error * error * dx;
      if (!lattice.empty()) discrete = std::max(discrete, std::abs(ui - displacement(lattice, x[i], t)));
    }
    const auto add = [&](const char* quantity, double value) {
      results[{quantity, run.name, pulse_horizon, run.ratio, t}] = value;
    };
    add("max_error", most);
    add("l2_error", std::sqrt(squares));
    if (!lattice.empty()) add("discrete_error", discrete);
    add("largest", u.cwiseAbs().maxCoeff());
    add("u(N/2)", u[u.size() / 2]);
    add("u(N/4)", u[u.size() / 4]);
    add("u(0)", u[0]);
    if (profiles != nullptr)
      add_curve(*profiles, fmt::format("{} m={}", run.name, run.ratio), t, x,
                [&](std::size_t i) { return u[static_cast<Eigen::Index>(i)]; });
  }
}

void add_series(Results& results, Table& profiles) {
  profiles.columns = {"curve", "time", "x", "u"};
  std::vector<double> x;
  for (int i = 0; i <= 500; ++i) x.push_back(i / 500.0);
  const std::vector<StandingWave> nonlocal = scabbia_series(separated), local = scabbia_series(classical);
  for (const double t : pulse_times()) {
    results[{"u(1/2)", "series", pulse_horizon, 0, t}] = displacement(nonlocal, 0.5, t);
    add_curve(profiles, "series", t, x, [&](std::size_t i) { return displacement(nonlocal, x[i], t); });
    add_curve(profiles, "classical", t, x, [&](std::size_t i) { return displacement(local, x[i], t); });
  }
}

void add_rate(const std::string& name, int from, int to, Results& results) {
  const double end = pulse_times().back();
  for (const auto& [quantity, rate] : {std::pair{"max_error", "rate"}, std::pair{"l2_error", "l2_rate"}}) {
    const auto coarse = results.find({quantity, name, pulse_horizon, from, end});
    const auto fine = results.find({quantity, name, pulse_horizon, to, end});
    if (coarse == results.end() || fine == results.end()) continue;
    results[{fmt::format("{} from m={}", rate, from), name, pulse_horizon, to, end}] =
        std::log(coarse->second / fine->second) / std::log(static_cast<double>(to) / from);
  }
}

}  // namespace perimode::studies
