// SPDX-License-Identifier: BSD-3-Clause
// Full separation of a plate of width 1 and height 2 with an edge crack of 0.25, n particles along its width,
// pulled open by tractions, event by event (E = 1e5 Pa, plane strain, inverse-distance kernel, horizon of
// three spacings).
//   total_s     all of the run, wall time; shares of it: solutions (updates and substitutions), search
//   event_s     CPU time of an event, the mean of the run; event: the same in factorisations (factor_s, CPU
//   time of
//               the numbers alone, the least of three)
//   fresh_s     CPU time of an event whose factor is made anew, the mean of 4 from the beginning, from half
//   way
//               and from near the end of the same run
//   ratio       fresh_s/event_s: what the run would take with a factor for every event, extrapolated from
//   these
//               samples, over what it takes
// One thread unless PERIMODE_BENCH_THREADS says otherwise.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "perimode/assembly/assemble.hpp"
#include "perimode/assembly/critical_stretches.hpp"
#include "perimode/fracture/quasistatic.hpp"
#include "perimode/linalg/factor.hpp"
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

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Instants of the rows of a run, CPU time.
struct Rows {
  double first = 0.0, last = 0.0;
  Index count = 0;
  void see() {
    last = cpu_seconds();
    if (count++ == 0) first = last;
  }
  [[nodiscard]] double per_event() const { return (last - first) / (count - 1); }
};

double factorisation(const Body<2>& body) {
  const Csr k = scalar_csr(assemble_stiffness(body), body.boundary.free_number, Zeros::keep);
  CholeskyFactor factor = CholeskyFactor::with_order(
      k, dissection_order(k, particle_of_free_dof(body), particle_positions(body)));
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(k.rows);
  double least = 1e300;
  for (int repeat = 0; repeat < 3; ++repeat) {
    const double start = cpu_seconds();
    benchmark::DoNotOptimize(factor.factorize(k, 0.0, none));
    least = std::min(least, cpu_seconds() - start);
  }
  return least;
}

/// CPU time of events with fresh factors, from a state of the run on.
double fresh_event(const Model& model, int n, const IntegratorState* start) {
  constexpr std::int64_t sample = 4;
  Body<2> body = build_body<2>(model);
  QuasistaticOptions options = pull(model, body, n);
  options.solver.only = SolveWay::refactor;
  options.stop.events = (start == nullptr ? 0 : start->step) + sample + 1;
  Rows rows;
  QuasistaticObserver<2> observer;
  observer.row = [&](const QuasistaticRow&) { rows.see(); };
  (void)run_quasistatic<2>(body, options, observer, start);
  return rows.per_event();
}

void separation(benchmark::State& state) {
  const char* threads = std::getenv("PERIMODE_BENCH_THREADS");
  set_threads(threads == nullptr ? 1 : std::atoi(threads));
  const int n = static_cast<int>(state.range(0));
  const Model model = edge_crack(n);
  const double factor = factorisation(build_body<2>(model));
  QuasistaticResult run;
  Rows rows;
  std::vector<IntegratorState> states;
  for (auto _ : state) {
    Body<2> body = build_body<2>(model);
    QuasistaticOptions options = pull(model, body, n);
    options.checkpoint_every = n;
    QuasistaticObserver<2> observer;
    observer.row = [&](const QuasistaticRow&) { rows.see(); };
    observer.checkpoint = [&](const IntegratorState& s) { states.push_back(s); };
    run = run_quasistatic<2>(body, options, observer);
  }
  if (run.status != QuasistaticStatus::separated || states.empty())
    return state.SkipWithError(run.message.c_str());
  double fresh = 0.0;
  for (const IntegratorState* start : {static_cast<const IntegratorState*>(nullptr),
                                       static_cast<const IntegratorState*>(&states[states.size() / 2]),
                                       static_cast<const IntegratorState*>(&states.back())})
    fresh += fresh_event(model, n, start) / 3.0;
  double solutions = 0.0;
  for (const WayTotals& way : run.ways) solutions += way.seconds;
  state.SetLabel(run.plan.solver);
  state.counters["total_s"] = run.seconds_total;
  state.counters["solutions"] = solutions / run.seconds_total;
  state.counters["search"] = run.seconds_search / run.seconds_total;
  state.counters["events"] = static_cast<double>(run.events);
  state.counters["bonds"] = static_cast<double>(run.broken_bonds);
  state.counters["factor_s"] = factor;
  state.counters["event_s"] = rows.per_event();
  state.counters["event"] = rows.per_event() / factor;
  state.counters["fresh_s"] = fresh;
  state.counters["ratio"] = fresh / rows.per_event();
  state.counters["balance"] = run.worst_balance;
  for (int way = 0; way < solve_ways; ++way)
    state.counters[name(static_cast<SolveWay>(way))] =
        static_cast<double>(run.ways[static_cast<std::size_t>(way)].solves);
}

BENCHMARK(separation)->Arg(24)->Arg(100)->Arg(200)->Iterations(1)->Unit(benchmark::kSecond);

}  // namespace
