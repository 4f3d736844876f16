// SPDX-License-Identifier: BSD-3-Clause
// A step of Newmark's method on a square or cube of n particles along an edge (horizon of three spacings, one
// face held, E = rho = 1) against one solution with its factor, and by conjugate gradients at several steps.
// One thread unless PERIMODE_BENCH_THREADS says otherwise.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "perimode/assembly/assemble.hpp"
#include "perimode/assembly/operators.hpp"
#include "perimode/dynamics/newmark.hpp"
#include "perimode/dynamics/shifted_solver.hpp"
#include "perimode/dynamics/stable_step.hpp"
#include "perimode/linalg/threads.hpp"
#include "support/models.hpp"

namespace {

using namespace perimode;

template <int Dim>
struct Problem {
  explicit Problem(int n) {
    const char* threads = std::getenv("PERIMODE_BENCH_THREADS");
    set_threads(threads == nullptr ? 1 : std::atoi(threads));
    Model model = test::box_model(std::vector<int>(Dim, n), 1.0 / n, 3.0);
    std::vector<int> all = {0, 1, 2};
    all.resize(Dim);
    test::fix_face(model, 0, false, 3, all);
    body = build_body<Dim>(model);
    stiffness = stiffness_operator(body);
    motion.mass = lumped_mass(body);
    motion.stiffness = stiffness_rows(body);
    limit = stable_step(body, stiffness, motion.mass, true).limit;
    // A wave as long as the body.
    q.resize(body.boundary.free);
    for (Index i = 0; i < body.count(); ++i) {
      for (int a = 0; a < Dim; ++a) {
        const Index number = body.boundary.free_number[static_cast<std::size_t>(i) * Dim + a];
        if (number >= 0) q[number] = std::sin(1.5 * body.particles.position[i][0]);
      }
    }
  }

  Body<Dim> body;
  LinearOperator stiffness;
  Motion motion;
  double limit = 0.0;
  Eigen::VectorXd q;
};

void count(benchmark::State& state, double dofs) {
  state.counters["per_dof"] =
      benchmark::Counter(dofs, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["dofs"] = dofs;
}

template <int Dim>
void back_solve(benchmark::State& state) {
  const Problem<Dim> problem(static_cast<int>(state.range(0)));
  std::string description;
  const double dt = 20.0 * problem.limit;
  const ShiftedSolve solve =
      make_shifted_solver(problem.body, problem.stiffness, true, ImplicitSolver::factor, 20.0, 1e-12,
                          description)(4.0 / (dt * dt) * problem.motion.mass);
  Eigen::VectorXd x;
  for (auto _ : state) solve(problem.q, problem.q, x);
  count(state, static_cast<double>(problem.q.size()));
}

template <int Dim>
void step(benchmark::State& state, ImplicitSolver which) {
  const Problem<Dim> problem(static_cast<int>(state.range(0)));
  std::string description;
  const double ratio = which == ImplicitSolver::factor ? 20.0 : static_cast<double>(state.range(1));
  double solves = 0.0, iterations = 0.0;
  const ShiftedSolver solver =
      make_shifted_solver(problem.body, problem.stiffness, true, which, ratio, 1e-12, description);
  const auto counted = [&](const Eigen::VectorXd& d) -> ShiftedSolve {
    return
        [&, solve = solver(d)](const Eigen::VectorXd& b, const Eigen::VectorXd& guess, Eigen::VectorXd& x) {
          const int n = solve(b, guess, x);
          solves += 1.0;
          iterations += n;
          return n;
        };
  };
  const auto scheme = newmark(problem.motion, ratio * problem.limit, {}, counted);
  scheme->start(problem.q, Eigen::VectorXd::Zero(problem.q.size()));
  for (auto _ : state) scheme->advance(false);
  count(state, static_cast<double>(problem.q.size()));
  state.counters["iterations"] = iterations / solves;
}

template <int Dim>
void factor_step(benchmark::State& state) {
  step<Dim>(state, ImplicitSolver::factor);
}

template <int Dim>
void cg_step(benchmark::State& state) {
  step<Dim>(state, ImplicitSolver::cg);
}

// Particles along an edge; for conjugate gradients also the step in stable steps.
BENCHMARK(back_solve<2>)->Name("back_solve/2D")->Arg(200)->Unit(benchmark::kMillisecond);
BENCHMARK(factor_step<2>)->Name("step/factor/2D")->Arg(200)->Unit(benchmark::kMillisecond);
BENCHMARK(back_solve<3>)->Name("back_solve/3D")->Arg(20)->Unit(benchmark::kMillisecond);
BENCHMARK(factor_step<3>)->Name("step/factor/3D")->Arg(20)->Unit(benchmark::kMillisecond);
BENCHMARK(cg_step<2>)
    ->Name("step/cg/2D")
    ->ArgsProduct({{200}, {2, 5, 20, 100}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(cg_step<3>)
    ->Name("step/cg/3D")
    ->ArgsProduct({{20, 40}, {2, 5, 20, 100}})
    ->Unit(benchmark::kMillisecond);

}  // namespace
