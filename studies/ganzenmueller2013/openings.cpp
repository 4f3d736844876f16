// SPDX-License-Identifier: BSD-3-Clause
#include "openings.hpp"

#include <cmath>

#include "perimode/dynamics/transient.hpp"
#include "studies/common/crack_opening.hpp"

namespace perimode::studies {

const char* name_of_constants(Calibration calibration) {
  if (calibration == Calibration::continuum) return "bulk";
  return calibration == Calibration::discrete ? "full" : "cut";
}

void add_opening(int cells, int ratio, Calibration calibration, Results& results) {
  const Model model = crack_opening_patch(cells, ratio, calibration);
  Body<2> body = build_body<2>(model);
  QuasistaticOptions options = crack_opening_run(model, body);
  options.stop.load_drop = 0.3;
  const QuasistaticResult run = run_quasistatic<2>(body, options);
  if (run.status != QuasistaticStatus::load_drop) throw Error(ErrorKind::solver_failure, run.message);
  const double lefm = crack_opening_stress(opening_crack);
  const auto add = [&](const char* quantity, double value) {
    results[{quantity, name_of_constants(calibration), 0.0, ratio, static_cast<double>(cells)}] = value;
  };
  const auto solves = [&](SolveWay way) {
    return static_cast<double>(run.ways[static_cast<std::size_t>(way)].solves);
  };
  add("first", run.first_load / lefm);
  add("peak", run.peak_load / lefm);
  add("events", static_cast<double>(run.events));
  add("bonds", static_cast<double>(run.broken_bonds));
  add("seconds", run.seconds_total);
  add("factor_seconds", run.factor_seconds);
  add("updated", solves(SolveWay::update) + solves(SolveWay::stale));
  add("fresh", solves(SolveWay::refactor));
  add("balance", run.worst_balance);
  add_opening_griffith(cells, ratio, calibration, results);
}

void add_opening_griffith(int cells, int ratio, Calibration calibration, Results& results) {
  const GriffithLoad load = crack_opening_griffith(crack_opening_patch(cells, ratio, calibration));
  results[{"griffith", name_of_constants(calibration), 0.0, ratio, static_cast<double>(cells)}] =
      griffith_ratio(load, cells);
}

void add_ramped_opening(int cells, double seconds, Results& results) {
  constexpr int ratio = 3;
  constexpr double most = 1.5;
  const Model model = crack_opening_patch(cells, ratio, Calibration::discrete);
  Body<2> body = build_body<2>(model);
  const QuasistaticOptions quasistatic = crack_opening_run(model, body);
  const double lefm = crack_opening_stress(opening_crack);
  TransientOptions options;
  options.end = seconds;
  options.critical_stretch = quasistatic.critical_stretch;
  options.no_fail = quasistatic.no_fail;
  options.loads = quasistatic.loads;
  for (Load& load : options.loads) {
    std::get<Traction>(load.what).value[1] *= most * lefm;
    load.time = {TimeFunction::Kind::ramp, seconds};
  }
  for (const double y : {-1.0, 1.0}) {
    TransientProbe probe;
    probe.name = y > 0.0 ? "upper" : "lower";
    probe.at = {0.5, y};
    options.probes.push_back(probe);
  }
  options.history_every = 5;
  const double bonds_of_a_spacing = 18.0;  // sum of the rows that bonds within 3 spacings span
  double first = 0.0, collapse = 0.0, opening = 0.0;
  TransientObserver<2> observer;
  observer.history = [&](const HistoryRow& row) {
    if (row.broken_bonds > 0 && first == 0.0) {
      first = row.time;
      opening = row.probes[3] - row.probes[1];
    }
    if (static_cast<double>(row.broken_bonds) >= 10.0 * bonds_of_a_spacing && collapse == 0.0)
      collapse = row.time;
  };
  observer.stop = [&] { return collapse > 0.0; };
  (void)run_transient<2>(body, options, {}, observer);
  const double bulk_modulus = model.material.youngs_modulus / 1.5;  // nu = 1/4
  const double sound = std::sqrt(1.8 * bulk_modulus / model.material.density);
  const auto add = [&](const char* quantity, double value) {
    results[{quantity, "full", seconds, ratio, static_cast<double>(cells)}] = value;
  };
  add("ramp_first", most * first / seconds);
  add("ramp_collapse", most * collapse / seconds);
  add("ramp_transits", seconds * sound / 2.0);
  add("ramp_velocity", 0.5 * opening / first / sound);
}

}  // namespace perimode::studies
