// SPDX-License-Identifier: BSD-3-Clause
// Dispersion of a lattice: the contour of the irreducible zone and the whole zone.
#include <benchmark/benchmark.h>

#include "perimode/dispersion/zone.hpp"
#include "perimode/linalg/threads.hpp"
#include "support/models.hpp"

namespace perimode {
namespace {

template <int Dim>
Lattice<Dim> lattice(double ratio) {
  return make_lattice<Dim>(test::box_model(std::vector<int>(Dim, 8), 1.0, ratio));
}

template <int Dim>
void contour(benchmark::State& state) {
  set_threads(1);
  const auto bulk = lattice<Dim>(3.0);
  for (auto _ : state) {
    const auto path = zone_path<Dim>(irreducible_contour<Dim>(), 1.0, static_cast<int>(state.range(0)));
    benchmark::DoNotOptimize(waves_along<Dim>(bulk, path));
  }
}
BENCHMARK(contour<1>)->Name("contour/1D")->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK(contour<2>)->Name("contour/2D")->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK(contour<3>)->Name("contour/3D")->Arg(1000)->Unit(benchmark::kMillisecond);

template <int Dim>
void zone(benchmark::State& state) {
  set_threads(1);
  const auto bulk = lattice<Dim>(3.0);
  for (auto _ : state) benchmark::DoNotOptimize(survey_zone<Dim>(bulk, static_cast<int>(state.range(0))));
}
BENCHMARK(zone<2>)->Name("zone/2D")->Arg(512)->Unit(benchmark::kMillisecond);
BENCHMARK(zone<3>)->Name("zone/3D")->Arg(128)->Unit(benchmark::kMillisecond);

void bands(benchmark::State& state) {
  set_threads(1);
  const auto bulk = lattice<2>(3.0);
  for (auto _ : state)
    benchmark::DoNotOptimize(branch_band<2>(bulk, Branch::pressure, Point<2>(1.0, 0.0), 3.14, 0.05));
}
BENCHMARK(bands)->Name("band/2D")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace perimode
