// SPDX-License-Identifier: BSD-3-Clause
// One load step of a block of n^3 particles (horizon of 3.01 spacings, one face held, the other pulled): from
// the model to displacements, reactions and energies. CPU time of all threads; "body" and "solve" are its
// parts. The solvers one by one, and the choice. One thread unless PERIMODE_BENCH_THREADS says otherwise.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "perimode/linalg/threads.hpp"
#include "perimode/statics/static.hpp"
#include "support/models.hpp"

namespace {

using namespace perimode;

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

Model pulled_block(int n) {
  Model m = test::box_model({n, n, n}, 1.0 / n, 3.01);
  test::fix_face(m, 0, false, 1, {0, 1, 2});
  const Region end{FaceRegion{{0, true}, 1, 0.0}, {}};
  m.boundary.push_back({Prescribe{{{0, 1e-3}}, end}, {}});
  return m;
}

void load_step(benchmark::State& state, StaticSolver solver) {
  const char* threads = std::getenv("PERIMODE_BENCH_THREADS");
  set_threads(threads == nullptr ? 1 : std::atoi(threads));
  const Model model = pulled_block(static_cast<int>(state.range(0)));
  StaticOptions options;
  options.solver = solver;
  StaticResult result;
  double body_seconds = 0.0, solve_seconds = 0.0;
  for (auto _ : state) {
    const double start = cpu_seconds();
    const Body<3> body = build_body<3>(model);
    const double made = cpu_seconds();
    result = solve_static(body, model.boundary, options);
    body_seconds += made - start;
    solve_seconds += cpu_seconds() - made;
  }
  if (result.status != StaticStatus::converged) state.SkipWithError(result.message.c_str());
  const auto rounds = static_cast<double>(state.iterations());
  state.SetLabel(result.solver);
  state.counters["body"] = body_seconds / rounds;
  state.counters["solve"] = solve_seconds / rounds;
  state.counters["iterations"] = result.iterations;
  state.counters["residual"] = result.residual;
}

BENCHMARK_CAPTURE(load_step, automatic, StaticSolver::automatic)
    ->Arg(12)
    ->Arg(16)
    ->Arg(47)
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(load_step, cholesky, StaticSolver::cholesky)
    ->Arg(12)
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(load_step, multigrid, StaticSolver::multigrid)
    ->Arg(12)
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(load_step, jacobi, StaticSolver::jacobi)
    ->Arg(12)
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
