// SPDX-License-Identifier: BSD-3-Clause
// Building bodies and assembling K. Counters: ns per bond (each bond once), against the time of writing the
// same values with memset (`fill`), and of an Eigen triplet assembly (`triplets`). One thread unless
// OMP_NUM_THREADS says more.
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <Eigen/SparseCore>
#include <algorithm>
#include <cstring>

#include "perimode/assembly/assemble.hpp"
#include "support/models.hpp"

namespace perimode {
namespace {

template <int Dim>
Model cube(int cells, Calibration calibration = Calibration::continuum) {
  Model m = test::box_model(std::vector<int>(Dim, cells), 1.0 / cells, 3.0);
  m.calibration = calibration;
  return m;
}

double cpu_seconds() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

void per_bond(benchmark::State& state, double best_seconds, Offset bonds) {
  state.counters["ns/bond"] = 1e9 * best_seconds / static_cast<double>(bonds);
}

/// Values of K into an existing pattern: the numeric assembly.
template <int Dim>
void numeric(benchmark::State& state, Calibration calibration) {
  const auto body = build_body<Dim>(cube<Dim>(static_cast<int>(state.range(0)), calibration));
  const Offset bonds = count_bonds(body.bonds, body.count());
  BlockCsr k = stiffness_pattern(body);
  double best = 1e30;
  for (auto _ : state) {
    const double start = cpu_seconds();
    fill_stiffness(body, k);
    benchmark::DoNotOptimize(k.value.data());
    best = std::min(best, cpu_seconds() - start);
  }
  per_bond(state, best, bonds);
  double fill = 1e30;
  for (int repeat = 0; repeat < 5; ++repeat) {
    const double start = cpu_seconds();
    std::memset(k.value.data(), repeat, k.value.size() * sizeof(double));
    benchmark::DoNotOptimize(k.value.data());
    fill = std::min(fill, cpu_seconds() - start);
  }
  state.counters["x memset"] = best / fill;
}

template <int Dim>
void symbolic(benchmark::State& state) {
  const auto body = build_body<Dim>(cube<Dim>(static_cast<int>(state.range(0))));
  const Offset bonds = count_bonds(body.bonds, body.count());
  double best = 1e30;
  for (auto _ : state) {
    const double start = cpu_seconds();
    auto k = stiffness_pattern(body);
    benchmark::DoNotOptimize(k.value.data());
    best = std::min(best, cpu_seconds() - start);
  }
  per_bond(state, best, bonds);
}

/// What many codes do: a triplet per scalar entry and setFromTriplets.
template <int Dim>
void triplets(benchmark::State& state) {
  const auto body = build_body<Dim>(cube<Dim>(static_cast<int>(state.range(0))));
  const Offset bonds = count_bonds(body.bonds, body.count());
  double best = 1e30;
  for (auto _ : state) {
    const double start = cpu_seconds();
    std::vector<Eigen::Triplet<double>> entries;
    for (Index i = 0; i < body.count(); ++i) {
      for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<Dim>& e) {
        const double stiffness = bond_stiffness(body, i, e);
        const Point<Dim> n = e.xi / e.length;
        for (int a = 0; a < Dim; ++a) {
          for (int b = 0; b < Dim; ++b) {
            entries.emplace_back(i * Dim + a, i * Dim + b, stiffness * n[a] * n[b]);
            entries.emplace_back(i * Dim + a, e.neighbour * Dim + b, -stiffness * n[a] * n[b]);
          }
        }
      });
    }
    Eigen::SparseMatrix<double> k(body.count() * Dim, body.count() * Dim);
    k.setFromTriplets(entries.begin(), entries.end());
    benchmark::DoNotOptimize(k.valuePtr());
    best = std::min(best, cpu_seconds() - start);
  }
  per_bond(state, best, bonds);
}

/// Particles, family, alive bits, calibration: everything before K.
template <int Dim>
void build(benchmark::State& state) {
  const auto model = cube<Dim>(static_cast<int>(state.range(0)));
  double best = 1e30;
  for (auto _ : state) {
    const double start = cpu_seconds();
    const auto body = build_body<Dim>(model);
    benchmark::DoNotOptimize(body.count());
    best = std::min(best, cpu_seconds() - start);
  }
  state.counters["cpu_s"] = best;
}

void plain_2d(benchmark::State& state) { numeric<2>(state, Calibration::continuum); }
void plain_3d(benchmark::State& state) { numeric<3>(state, Calibration::continuum); }
void calibrated_2d(benchmark::State& state) { numeric<2>(state, Calibration::discrete); }
void calibrated_3d(benchmark::State& state) { numeric<3>(state, Calibration::discrete); }

BENCHMARK(plain_2d)->Name("numeric/2D")->Arg(200)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK(plain_3d)->Name("numeric/3D")->Arg(30)->Arg(50)->Unit(benchmark::kMillisecond);
BENCHMARK(calibrated_2d)->Name("numeric_discrete/2D")->Arg(200)->Unit(benchmark::kMillisecond);
BENCHMARK(calibrated_3d)->Name("numeric_discrete/3D")->Arg(30)->Unit(benchmark::kMillisecond);
BENCHMARK(symbolic<2>)->Name("symbolic/2D")->Arg(200)->Unit(benchmark::kMillisecond);
BENCHMARK(symbolic<3>)->Name("symbolic/3D")->Arg(30)->Unit(benchmark::kMillisecond);
BENCHMARK(triplets<2>)->Name("triplets/2D")->Arg(200)->Unit(benchmark::kMillisecond);
BENCHMARK(triplets<3>)->Name("triplets/3D")->Arg(20)->Unit(benchmark::kMillisecond);
BENCHMARK(build<3>)->Name("build/3D")->Arg(47)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace perimode
