// SPDX-License-Identifier: BSD-3-Clause
// Full separation of a plate of width 1 and height 2 with an edge crack of 0.25, n particles along its width,
// pulled open by tractions, event by event (E = 1e5 Pa, plane strain, inverse-distance kernel, horizon of
// three spacings).
//   total_s     all of the run
//   event       of an event: its solution (update and substitution), its search, the rest, each in
//   factorisations
//               of the run (factor_s, the numbers alone), and the whole of it in s
//   ratio       an event with a fresh factor, found in sample_events events from the beginning, where the run
//   is
//               half way and near its end, over an event of the run: what the whole run would take if the
//               factor were made anew at every event, extrapolated, over what it takes; set-up left out of
//               both
// Wall time; one thread unless PERIMODE_BENCH_THREADS says otherwise.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "perimode/assembly/critical_stretches.hpp"
#include "perimode/fracture/quasistatic.hpp"
#include "perimode/linalg/threads.hpp"
#include "support/models.hpp"

namespace {

using namespace perimode;

Region rows(double lower, double upper) { return {BoxRegion{{-1.0, lower}, {2.0, upper}}, {}}; }

Model edge_crack(int n) {
  const double dx = 1.0 / n;
  Model m = test::box_model({n, 2 * n}, dx, 3.0);
  auto& grid = std::get<GridSpec>(m.particles);
  grid.lower[1] = -1.0;
  grid.upper[1] = 1.0;
  m.plane = Plane::strain;
  m.material.youngs_modulus = 1e5;
  m.material.fracture_energy = 0.358;
  m.material.micromodulus.kernel = Kernel::inverse_distance;
  m.calibration = Calibration::discrete;
  test::add_crack(m, {{-dx, 0.0}, {0.25 - 1e-9 * dx, 0.0}});
  const auto hold = [&](double y, std::vector<int> components) {
    m.boundary.push_back({Fix{std::move(components), Region{NearestRegion{{1.0 - 0.5 * dx, y}}, {}}}, {}});
  };
  hold(0.5 * dx, {0, 1});
  hold(-0.5 * dx, {0});
  return m;
}

QuasistaticOptions pull(const Model& model, const Body<2>& body, int n) {
  const double grip = 1.0 - 9.0 / n;
  QuasistaticOptions options;
  options.loads = {{Traction{{0.0, 1.0}}, Region{FaceRegion{{1, true}, 1, 0.0}, {}}, {}, {}},
                   {Traction{{0.0, -1.0}}, Region{FaceRegion{{1, false}, 1, 0.0}, {}}, {}, {}}};
  options.no_fail = {rows(grip, 2.0), rows(-2.0, -grip)};
  options.critical_stretch = critical_stretches(model, body);
  return options;
}

struct PerEvent {
  double solution = 0.0, search = 0.0, rest = 0.0;
  [[nodiscard]] double all() const { return solution + search + rest; }
};

/// The first factor, made in the set-up, is that of the first event.
PerEvent per_event(const QuasistaticResult& result, std::int64_t events) {
  double solutions = 0.0;
  for (const WayTotals& way : result.ways) solutions += way.seconds;
  const double all = result.seconds_total - result.seconds_setup + result.factor_seconds;
  const auto n = static_cast<double>(events);
  return {solutions / n, result.seconds_search / n, (all - solutions - result.seconds_search) / n};
}

void separation(benchmark::State& state) {
  const char* threads = std::getenv("PERIMODE_BENCH_THREADS");
  set_threads(threads == nullptr ? 1 : std::atoi(threads));
  const int n = static_cast<int>(state.range(0));
  const Model model = edge_crack(n);
  QuasistaticResult run;
  std::vector<IntegratorState> states;
  for (auto _ : state) {
    Body<2> body = build_body<2>(model);
    QuasistaticOptions options = pull(model, body, n);
    options.checkpoint_every = n;
    QuasistaticObserver<2> observer;
    observer.checkpoint = [&](const IntegratorState& s) { states.push_back(s); };
    run = run_quasistatic<2>(body, options, observer);
  }
  constexpr std::int64_t sample_events = 4;
  PerEvent fresh;
  std::vector<const IntegratorState*> starts = {nullptr};
  if (!states.empty()) starts = {nullptr, &states[states.size() / 2], &states.back()};
  for (const IntegratorState* start : starts) {
    Body<2> body = build_body<2>(model);
    QuasistaticOptions options = pull(model, body, n);
    options.solver.only = SolveWay::refactor;
    options.stop.events = (start == nullptr ? 0 : start->step) + sample_events;
    const QuasistaticResult sample = run_quasistatic<2>(body, options, {}, start);
    const PerEvent each = per_event(sample, sample_events);
    fresh.solution += each.solution / static_cast<double>(starts.size());
    fresh.search += each.search / static_cast<double>(starts.size());
    fresh.rest += each.rest / static_cast<double>(starts.size());
  }
  const PerEvent event = per_event(run, run.events);
  const double factor = run.factor_seconds;
  if (run.status != QuasistaticStatus::separated) state.SkipWithError(run.message.c_str());
  state.SetLabel(run.plan.solver);
  state.counters["total_s"] = run.seconds_total;
  state.counters["setup_s"] = run.seconds_setup;
  state.counters["events"] = static_cast<double>(run.events);
  state.counters["bonds"] = static_cast<double>(run.broken_bonds);
  state.counters["factor_s"] = factor;
  state.counters["event_s"] = event.all();
  state.counters["solution"] = event.solution / factor;
  state.counters["search"] = event.search / factor;
  state.counters["rest"] = event.rest / factor;
  state.counters["fresh_s"] = fresh.all();
  state.counters["ratio"] = fresh.all() / event.all();
  state.counters["balance"] = run.worst_balance;
  for (int way = 0; way < solve_ways; ++way)
    state.counters[name(static_cast<SolveWay>(way))] =
        static_cast<double>(run.ways[static_cast<std::size_t>(way)].solves);
}

BENCHMARK(separation)->Arg(24)->Arg(100)->Arg(200)->Iterations(1)->Unit(benchmark::kSecond);

}  // namespace
