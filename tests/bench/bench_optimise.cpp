// SPDX-License-Identifier: BSD-3-Clause
// Optimised micromoduli from lattice to certificate's numbers: the bar, the plane, space; l2, l1, bounds and
// the whole zone. "orbits" is the number of unknowns, "l1" and "l2" the errors on the contour over those of
// the original.
#include <benchmark/benchmark.h>

#include "perimode/core/error.hpp"
#include "perimode/dispersion/optimise.hpp"
#include "perimode/dispersion/symbol.hpp"

namespace {

using namespace perimode;

template <int Dim>
void optimise(benchmark::State& state, const OptimiseOptions& options) {
  Lattice<Dim> lattice;
  lattice.medium.material.youngs_modulus = 1.0;
  lattice.medium.material.density = 1.0;
  lattice.medium.continuum = {Dim, Plane::strain, 1.0};
  lattice.medium.horizon = static_cast<double>(state.range(0));
  lattice.family = make_family<Dim>(1.0, lattice.medium.horizon, VolumeCorrection::none);
  lattice.rates = bond_rates<Dim>(lattice.medium, lattice.family);
  OptimisedMicromodulus result;
  ContourError error;
  try {
    for (auto _ : state) {
      result = optimise_micromodulus(lattice, options);
      error = contour_error(with_shells(lattice, result.alpha));
    }
  } catch (const Error& absent) {
    state.SkipWithError(absent.what());
    return;
  }
  const ContourError original = contour_error(lattice);
  state.SetLabel(result.solver);
  state.counters["orbits"] = static_cast<double>(result.alpha.size());
  state.counters["optimality"] = result.optimality;
  state.counters["l1"] = error.l1 / original.l1;
  state.counters["l2"] = error.l2 / original.l2;
}

void bar(benchmark::State& state, const OptimiseOptions& options) { optimise<1>(state, options); }
void plane(benchmark::State& state, const OptimiseOptions& options) { optimise<2>(state, options); }
void space(benchmark::State& state, const OptimiseOptions& options) { optimise<3>(state, options); }

OptimiseOptions with(ErrorNorm norm, ErrorDomain domain, std::optional<double> bound) {
  OptimiseOptions options;
  options.norm = norm;
  options.domain = domain;
  options.lower_bound = bound;
  return options;
}

const OptimiseOptions square = with(ErrorNorm::l2, ErrorDomain::contour, {});
const OptimiseOptions bounded = with(ErrorNorm::l2, ErrorDomain::contour, 0.0);
const OptimiseOptions absolute = with(ErrorNorm::l1, ErrorDomain::contour, {});
const OptimiseOptions zone = with(ErrorNorm::l2, ErrorDomain::zone, {});

BENCHMARK_CAPTURE(bar, square, square)->Arg(10)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(bar, absolute, absolute)->Arg(10)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plane, square, square)->Arg(2)->Arg(3)->Arg(5)->Arg(8)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plane, bounded, bounded)->Arg(3)->Arg(5)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plane, absolute, absolute)->Arg(2)->Arg(3)->Arg(5)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plane, zone, zone)->Arg(3)->Arg(5)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(space, square, square)->Arg(2)->Arg(3)->Arg(5)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(space, bounded, bounded)->Arg(3)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(space, absolute, absolute)->Arg(2)->Arg(3)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(space, zone, zone)->Arg(2)->Arg(3)->Unit(benchmark::kMillisecond);

}  // namespace
