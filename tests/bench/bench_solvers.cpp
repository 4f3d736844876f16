// SPDX-License-Identifier: BSD-3-Clause
// Factorisation, solves and the 20 lowest modes of a plane lattice clamped all round: unit square,
// 200 x 200 particles, horizon of three spacings, constant micromodulus 9 E / (pi delta^3), no volume
// correction, E = rho = thickness = 1, K divided by rho V. The orders are compared on cubes too. Times are
// process CPU seconds; the program takes one thread unless PERIMODE_BENCH_THREADS says otherwise.
#include <benchmark/benchmark.h>
#include <cblas.h>

#include <cmath>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "perimode/linalg/eigen.hpp"
#include "perimode/linalg/factor.hpp"
#include "perimode/linalg/threads.hpp"

namespace {

using perimode::Index;

constexpr int horizon = 3;

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Problem {
  perimode::Csr k;
  Eigen::VectorXd mass;
  std::vector<Index> node_of_dof;
  Eigen::MatrixXd position;
};

/// The square or cubic lattice with n particles along an edge whose outer three layers are fixed.
Problem clamped_lattice(int dimension, int n) {
  const double dx = 1.0 / n, delta = horizon * dx;
  const double c = 9.0 / (M_PI * delta * delta * delta);
  const int free = n - 2 * horizon, depth = dimension == 3 ? free : 1, reach = dimension == 3 ? horizon : 0;
  perimode::BlockCsr k;
  k.block = dimension;
  k.rows = free * free * depth;
  k.row_start = {0};
  Eigen::MatrixXd position(dimension, k.rows);
  for (int z = 0; z < depth; ++z)
    for (int y = 0; y < free; ++y)
      for (int x = 0; x < free; ++x) {
        const Eigen::Vector3d here(x, y, z);
        position.col((z * free + y) * free + x) = dx * here.head(dimension);
        Eigen::MatrixXd diagonal = Eigen::MatrixXd::Zero(dimension, dimension);
        std::size_t diagonal_at = 0;
        for (int e = -reach; e <= reach; ++e)
          for (int b = -horizon; b <= horizon; ++b)
            for (int a = -horizon; a <= horizon; ++a) {
              const int square = a * a + b * b + e * e;
              if (square > horizon * horizon) continue;
              Eigen::MatrixXd block = Eigen::MatrixXd::Zero(dimension, dimension);
              if (square == 0) {
                diagonal_at = k.value.size();
              } else {
                const Eigen::VectorXd offset = Eigen::Vector3d(a, b, e).head(dimension);
                block = c * dx / (std::sqrt(square) * square) * offset * offset.transpose();
                diagonal += block;
                if (x + a < 0 || x + a >= free || y + b < 0 || y + b >= free || z + e < 0 || z + e >= depth)
                  continue;
              }
              k.column.push_back(((z + e) * free + y + b) * free + x + a);
              for (int r = 0; r < dimension; ++r)
                for (int s = 0; s < dimension; ++s) k.value.push_back(-block(r, s));
            }
        for (int r = 0; r < dimension; ++r)
          for (int s = 0; s < dimension; ++s) k.value[diagonal_at + dimension * r + s] = diagonal(r, s);
        k.row_start.push_back(static_cast<perimode::Offset>(k.column.size()));
      }
  std::vector<Index> number(dimension * k.rows);
  std::iota(number.begin(), number.end(), 0);
  Problem out{perimode::scalar_csr(k, number), Eigen::VectorXd::Ones(dimension * k.rows), number, position};
  for (Index& node : out.node_of_dof) node /= dimension;
  return out;
}

const Problem& problem(int n) {
  static const Problem small = clamped_lattice(2, 100), large = clamped_lattice(2, 200);
  return n == 100 ? small : large;
}

const perimode::CholeskyFactor& factor_of(int n) {
  static std::unique_ptr<perimode::CholeskyFactor> kept;
  static int kept_n = 0;
  if (kept_n != n) {
    const Problem& p = problem(n);
    kept = std::make_unique<perimode::CholeskyFactor>(p.k, p.node_of_dof);
    if (kept->factorize(p.k, 0.0, p.mass) != perimode::FactorStatus::done) std::abort();
    kept_n = n;
  }
  return *kept;
}

/// Flops per second of a 1000 x 1000 product: what a factorisation could reach at best.
double dgemm_rate() {
  static const double rate = [] {
    constexpr int n = 1000, repeats = 5;
    const Eigen::MatrixXd a = Eigen::MatrixXd::Ones(n, n), b = a;
    Eigen::MatrixXd c = a;
    const double begin = cpu_seconds();
    for (int k = 0; k < repeats; ++k)
      cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, n, n, n, 1e-3, a.data(), n, b.data(), n, 0.0,
                  c.data(), n);
    benchmark::DoNotOptimize(c.data());
    return 2.0 * n * n * n * repeats / (cpu_seconds() - begin);
  }();
  return rate;
}

/// One order and what it makes of the factorisation: order 0 is METIS, 1 the dissection by planes. In 3D
/// `n` counts the free particles along an edge.
void order(benchmark::State& state) {
  const bool planes = state.range(2) == 1;
  const auto dimension = static_cast<int>(state.range(0)), n = static_cast<int>(state.range(1));
  static int kept[2] = {0, 0};
  static Problem p;
  if (kept[0] != dimension || kept[1] != n) {
    p = clamped_lattice(dimension, dimension == 3 ? n + 2 * horizon : n);
    kept[0] = dimension;
    kept[1] = n;
  }
  std::vector<Index> order;
  for (auto _ : state)
    order = planes ? perimode::dissection_order(p.k, p.node_of_dof, p.position)
                   : perimode::fill_reducing_order(p.k, p.node_of_dof);
  double begin = cpu_seconds();
  perimode::CholeskyFactor factor = perimode::CholeskyFactor::with_order(p.k, std::move(order));
  state.counters["analyse_s"] = cpu_seconds() - begin;
  begin = cpu_seconds();
  if (factor.factorize(p.k, 0.0, p.mass) != perimode::FactorStatus::done) state.SkipWithError("not definite");
  state.counters["factor_s"] = cpu_seconds() - begin;
  state.counters["nonzeros"] = static_cast<double>(factor.fill().nonzeros);
  state.counters["flops"] = factor.fill().flops;
}

void factorise(benchmark::State& state) {
  const Problem& p = problem(static_cast<int>(state.range(0)));
  perimode::CholeskyFactor factor(p.k, p.node_of_dof);
  const double begin = cpu_seconds();
  for (auto _ : state)
    if (factor.factorize(p.k, 0.0, p.mass) != perimode::FactorStatus::done)
      state.SkipWithError("not definite");
  const double rate = factor.fill().flops * static_cast<double>(state.iterations()) / (cpu_seconds() - begin);
  state.counters["GF/s"] = rate * 1e-9;
  state.counters["of_dgemm"] = rate / dgemm_rate();
  state.counters["nonzeros"] = static_cast<double>(factor.fill().nonzeros);
}

void solve(benchmark::State& state) {
  const Problem& p = problem(static_cast<int>(state.range(0)));
  const perimode::CholeskyFactor& factor = factor_of(static_cast<int>(state.range(0)));
  const Eigen::MatrixXd b = Eigen::MatrixXd::Ones(p.k.rows, state.range(1));
  const double begin = cpu_seconds();
  for (auto _ : state) benchmark::DoNotOptimize(factor.solve(b));
  const double seconds = (cpu_seconds() - begin) / static_cast<double>(state.iterations());
  state.counters["s/rhs"] = seconds / static_cast<double>(state.range(1));
  state.counters["GB/s"] = 2e-9 * factor.fill().factor_bytes / seconds;
}

void twenty_modes(benchmark::State& state) {
  const int n = static_cast<int>(state.range(0));
  const Problem& p = problem(n);
  double begin = cpu_seconds();
  perimode::CholeskyFactor factor(p.k, p.node_of_dof);
  const double analysis = cpu_seconds() - begin;
  begin = cpu_seconds();
  if (factor.factorize(p.k, 0.0, p.mass) != perimode::FactorStatus::done) state.SkipWithError("not definite");
  const double one_factorisation = cpu_seconds() - begin;
  perimode::EigenOptions options;
  options.count = 20;
  options.check = state.range(1) == 0   ? perimode::CompletenessCheck::none
                  : state.range(1) == 1 ? perimode::CompletenessCheck::restart
                                        : perimode::CompletenessCheck::inertia;
  perimode::EigenResult result;
  begin = cpu_seconds();
  for (auto _ : state)
    result =
        perimode::solve_eigen({.stiffness = &p.k, .mass = &p.mass, .node_of_dof = p.node_of_dof}, options);
  const double seconds = (cpu_seconds() - begin) / static_cast<double>(state.iterations());
  if (result.status != perimode::EigenStatus::converged) state.SkipWithError(result.message.c_str());
  state.counters["cpu_s"] = seconds;
  state.counters["factorisations"] = (seconds - analysis) / one_factorisation;
  state.counters["solves"] = result.solves;
  state.counters["certificate_s"] = result.certificate.seconds;
  if (n != 200) return;
  // Made independently of this library, in extended precision from bond energies.
  constexpr double reference[20] = {
      1.52616831627394554e+01, 1.52616831627394554e+01, 2.08643173374175497e+01, 3.16311865836794013e+01,
      4.03397011986081182e+01, 4.03397011986081182e+01, 4.17823477757416057e+01, 5.50591249383766126e+01,
      6.03836689781610403e+01, 6.03836689781610403e+01, 6.32200093298793320e+01, 6.64419827681939665e+01,
      6.97567073753737219e+01, 8.70213815724838895e+01, 8.70213815724838895e+01, 9.01853286667304843e+01,
      9.09916139702785216e+01, 1.03802376216332220e+02, 1.03802376216332220e+02, 1.10750206326218276e+02,
  };
  double worst = 0.0;
  for (int i = 0; i < 20; ++i) worst = std::max(worst, std::abs(result.value[i] / reference[i] - 1.0));
  state.counters["worst_error"] = worst;
  if (worst > 1e-10) state.SkipWithError("eigenvalues differ from the reference by more than 1e-10");
}

}  // namespace

BENCHMARK(order)
    ->ArgNames({"dimension", "n", "planes"})
    ->ArgsProduct({{2}, {200}, {0, 1}})
    ->ArgsProduct({{3}, {20, 30}, {0, 1}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(factorise)->Arg(100)->Arg(200)->Unit(benchmark::kMillisecond);
BENCHMARK(solve)->ArgsProduct({{200}, {1, 4, 16}})->Unit(benchmark::kMillisecond);
BENCHMARK(twenty_modes)
    ->ArgNames({"n", "certificate"})
    ->ArgsProduct({{200}, {0, 1, 2}})
    ->Unit(benchmark::kMillisecond);

int main(int argc, char** argv) {
  const char* threads = std::getenv("PERIMODE_BENCH_THREADS");
  perimode::set_threads(threads != nullptr ? std::stoi(threads) : 1);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
