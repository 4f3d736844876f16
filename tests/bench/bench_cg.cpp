// SPDX-License-Identifier: BSD-3-Clause
// Conjugate gradients on bodies of n^d particles, horizon of three spacings, three layers on the left held,
// the last layer on the right loaded, to a true residual of 1e-8, with block Jacobi and with multigrid.
// Counters: process CPU seconds of the set-up of the preconditioner and of the iteration, iterations, true
// residual, megabytes of the preconditioner. One thread unless PERIMODE_BENCH_THREADS says otherwise.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <ctime>
#include <numeric>
#include <string>

#include "perimode/assembly/multigrid.hpp"
#include "perimode/assembly/operators.hpp"
#include "perimode/linalg/conjugate_gradients.hpp"
#include "perimode/linalg/threads.hpp"
#include "support/models.hpp"

namespace {

using perimode::Index;

enum class Preconditioner { jacobi, multigrid };

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

template <int Dim>
perimode::Body<Dim> cantilever(int n) {
  perimode::Model m = perimode::test::box_model(std::vector<int>(Dim, n), 1.0 / n, 3.0);
  std::vector<int> all(Dim);
  std::iota(all.begin(), all.end(), 0);
  perimode::test::fix_face(m, 0, false, 3, all);
  return perimode::build_body<Dim>(m);
}

/// A shear force on the last layer of the right face.
template <int Dim>
Eigen::VectorXd shear(const perimode::Body<Dim>& body) {
  Eigen::VectorXd b = Eigen::VectorXd::Zero(body.boundary.free);
  const auto& grid = *body.particles.grid;
  for (Index i = 0; i < body.count(); ++i) {
    if (body.particles.position[i][0] > grid.upper()[0] - grid.spacing)
      b[body.boundary.free_number[static_cast<std::size_t>(i) * Dim + Dim - 1]] = 1.0;
  }
  return b;
}

template <int Dim, Preconditioner Kind>
void solve(benchmark::State& state) {
  const auto body = cantilever<Dim>(static_cast<int>(state.range(0)));
  const perimode::LinearOperator k = stiffness_operator(body);
  const Eigen::VectorXd b = shear(body);
  perimode::CgResult result;
  double set_up = 0.0, iteration = 0.0, bytes = 0.0;
  for (auto _ : state) {
    const double begin = cpu_seconds();
    perimode::LinearOperator preconditioner;
    if constexpr (Kind == Preconditioner::multigrid) {
      perimode::Multigrid mg = multigrid(body, k);
      preconditioner = mg.preconditioner;
      bytes = mg.bytes;
    } else {
      preconditioner = perimode::block_jacobi(diagonal_blocks(body), Dim, body.boundary.free_number);
    }
    const double ready = cpu_seconds();
    result = conjugate_gradients(k, b, preconditioner, {.tolerance = 1e-8});
    set_up = ready - begin;
    iteration = cpu_seconds() - ready;
  }
  state.counters["set_up_s"] = set_up;
  state.counters["iterate_s"] = iteration;
  state.counters["total_s"] = set_up + iteration;
  state.counters["iterations"] = result.iterations;
  state.counters["residual"] = result.residual;
  if (Kind == Preconditioner::multigrid) state.counters["MB"] = bytes / 1e6;
  if (!result.converged) state.SkipWithError(result.message.c_str());
}

}  // namespace

BENCHMARK(solve<2, Preconditioner::jacobi>)->Name("jacobi/2D")->Arg(200)->Arg(400)->Unit(benchmark::kSecond);
BENCHMARK(solve<2, Preconditioner::jacobi>)
    ->Name("jacobi/2D")
    ->Arg(1000)
    ->Iterations(1)
    ->Unit(benchmark::kSecond);
BENCHMARK(solve<2, Preconditioner::multigrid>)
    ->Name("multigrid/2D")
    ->Arg(200)
    ->Arg(400)
    ->Unit(benchmark::kSecond);
BENCHMARK(solve<2, Preconditioner::multigrid>)
    ->Name("multigrid/2D")
    ->Arg(1000)
    ->Iterations(1)
    ->Unit(benchmark::kSecond);
BENCHMARK(solve<3, Preconditioner::jacobi>)->Name("jacobi/3D")->Arg(30)->Unit(benchmark::kSecond);
BENCHMARK(solve<3, Preconditioner::jacobi>)
    ->Name("jacobi/3D")
    ->Arg(50)
    ->Arg(70)
    ->Iterations(1)
    ->Unit(benchmark::kSecond);
BENCHMARK(solve<3, Preconditioner::multigrid>)->Name("multigrid/3D")->Arg(30)->Unit(benchmark::kSecond);
BENCHMARK(solve<3, Preconditioner::multigrid>)
    ->Name("multigrid/3D")
    ->Arg(50)
    ->Arg(70)
    ->Iterations(1)
    ->Unit(benchmark::kSecond);

int main(int argc, char** argv) {
  const char* threads = std::getenv("PERIMODE_BENCH_THREADS");
  perimode::set_threads(threads != nullptr ? std::stoi(threads) : 1);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
