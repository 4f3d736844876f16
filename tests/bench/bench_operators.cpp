// SPDX-License-Identifier: BSD-3-Clause
// Products with K in its three forms, m = 3, elastic bodies. Counters: ns per bond (each bond once), from and
// to the free dofs; GB/s of the bytes the form has to move (its own arrays, and 16 bytes per dof for x and y)
// and their share of a triad a = b + s c measured before and after in the same program; `x blocks`, the speed
// against the blocks form of the same body. Memory: MiB of a body and its stencil, counted and by resident
// set. One thread unless OMP_NUM_THREADS says more.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <fstream>
#include <string>

#include "perimode/assembly/assemble.hpp"
#include "perimode/assembly/operators.hpp"
#include "perimode/linalg/threads.hpp"
#include "support/models.hpp"

namespace perimode {
namespace {

template <int Dim>
Model cube(int cells) {
  return test::box_model(std::vector<int>(Dim, cells), 1.0 / cells, 3.0);
}

/// Processor time of one thread, which other programs leave alone; elapsed time of several.
double seconds() {
  if (threads() == 1) return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Best of `repeats` calls, s.
template <class Call>
double best_time(int repeats, const Call& call) {
  double best = 1e30;
  for (int k = 0; k < repeats; ++k) {
    const double start = seconds();
    call();
    best = std::min(best, seconds() - start);
  }
  return best;
}

/// Bytes per second of a = b + s c over arrays far larger than the caches; the write counts once.
double triad() {
  constexpr Offset n = 1 << 24;
  static Eigen::VectorXd a = Eigen::VectorXd::Zero(n), b = Eigen::VectorXd::Ones(n), c = b;
  const double time = best_time(4, [&] {
#pragma omp parallel for schedule(static)
    for (Offset i = 0; i < n; ++i) a[i] = b[i] + 3.0 * c[i];
    benchmark::DoNotOptimize(a.data());
  });
  return 3.0 * sizeof(double) * static_cast<double>(n) / time;
}

template <int Dim>
double time_of(const LinearOperator& k, int repeats) {
  const Eigen::VectorXd x = Eigen::VectorXd::Random(k.size);
  Eigen::VectorXd y(k.size);
  k.apply(x.data(), y.data());
  return best_time(repeats, [&] {
    k.apply(x.data(), y.data());
    benchmark::DoNotOptimize(y.data());
  });
}

template <int Dim>
void product(benchmark::State& state, StiffnessForm form, const Model& model, bool compare) {
  const auto body = build_body<Dim>(model);
  const double bonds = static_cast<double>(count_bonds(body.bonds, body.count()));
  const auto k = stiffness_operator(body, form);
  const Eigen::VectorXd x = Eigen::VectorXd::Random(k.size);
  Eigen::VectorXd y(k.size);
  const double before = form == StiffnessForm::stencil ? 0.0 : triad();
  double best = 1e30;
  for (auto _ : state) {
    best = std::min(best, best_time(1, [&] {
                      k.apply(x.data(), y.data());
                      benchmark::DoNotOptimize(y.data());
                    }));
  }
  state.counters["ns/bond"] = 1e9 * best / bonds;
  state.counters["ns/dof"] = 1e9 * best / k.size;
  if (form != StiffnessForm::stencil) {
    const double rate = (operator_bytes(body, form) + 16.0 * k.size) / best;
    state.counters["GB/s"] = 1e-9 * rate;
    state.counters["of triad"] = rate / std::max(before, triad());
  }
  if (compare)
    state.counters["x blocks"] = time_of<Dim>(stiffness_operator(body, StiffnessForm::blocks), 10) / best;
}

template <int Dim>
void stencil(benchmark::State& state) {
  product<Dim>(state, StiffnessForm::stencil, cube<Dim>(static_cast<int>(state.range(0))), false);
}
template <int Dim>
void bonds(benchmark::State& state) {
  product<Dim>(state, StiffnessForm::bonds, cube<Dim>(static_cast<int>(state.range(0))), true);
}
template <int Dim>
void blocks(benchmark::State& state) {
  product<Dim>(state, StiffnessForm::blocks, cube<Dim>(static_cast<int>(state.range(0))), false);
}

/// The same bodies with every other bond negative, against those without, by turns: `x positive` is the speed
/// of the signed kernels over that of the others.
template <int Dim, StiffnessForm form>
void negative(benchmark::State& state) {
  const auto body = build_body<Dim>(cube<Dim>(static_cast<int>(state.range(0))));
  auto mixed = body;
  const int size = body.constants.family_size;
  for (int k = 0; k < size; k += 2) {
    const auto at = static_cast<std::size_t>(std::min(k, size - 1 - k));
    mixed.constants.kernel[at] = mixed.constants.kernel[static_cast<std::size_t>(size) - 1 - at] =
        -body.constants.kernel[at];
  }
  const auto positive = stiffness_operator(body, form), signs = stiffness_operator(mixed, form);
  double best = 1e30, plain = 1e30;
  for (auto _ : state) {
    best = std::min(best, time_of<Dim>(signs, 1));
    plain = std::min(plain, time_of<Dim>(positive, 1));
  }
  state.counters["ns/bond"] = 1e9 * best / static_cast<double>(count_bonds(body.bonds, body.count()));
  state.counters["x positive"] = plain / best;
}

/// Every particle's bonds tested one by one: calibration factors all over.
template <int Dim>
void partial(benchmark::State& state) {
  Model m = cube<Dim>(static_cast<int>(state.range(0)));
  m.calibration = Calibration::discrete;
  auto body = build_body<Dim>(m);
  for (Index i = 0; i < body.count(); ++i) body.constants.factor[i] = 1.0 + 1e-3 * (i % 7);
  const double count = static_cast<double>(count_bonds(body.bonds, body.count()));
  const auto k = stiffness_operator(body, StiffnessForm::stencil);
  double best = 1e30;
  for (auto _ : state) best = std::min(best, time_of<Dim>(k, 1));
  state.counters["ns/bond"] = 1e9 * best / count;
}

/// Discrete calibration: factors vary near the faces.
template <int Dim>
void calibrated(benchmark::State& state) {
  Model m = cube<Dim>(static_cast<int>(state.range(0)));
  m.calibration = Calibration::discrete;
  product<Dim>(state, StiffnessForm::stencil, m, false);
}

/// MiB of this process that are in memory.
double resident() {
  std::ifstream status("/proc/self/statm");
  double all = 0.0, pages = 0.0;
  status >> all >> pages;
  return pages * 4096.0 / 1048576.0;
}

template <class T>
double mib(const std::vector<T>& v) {
  return static_cast<double>(v.size() * sizeof(T)) / 1048576.0;
}

/// A cube and its stencil: arrays counted, and the growth of the resident set.
void memory(benchmark::State& state) {
  const Model model = cube<3>(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    const double before = resident();
    const auto body = build_body<3>(model);
    const auto k = stiffness_operator(body);
    const double after = resident();
    benchmark::DoNotOptimize(k.size);
    const auto& bonds_of = std::get<GridBonds<3>>(body.bonds);
    state.counters["particles"] = mib(body.particles.position) + mib(body.particles.volume) +
                                  mib(body.particles.block) + mib(body.particles.cell);
    state.counters["bonds"] = mib(bonds_of.occupant) + mib(bonds_of.home) + mib(bonds_of.alive);
    state.counters["boundary"] = mib(body.boundary.free_number) + mib(body.boundary.given);
    state.counters["operator"] = operator_bytes(body) / 1048576.0;
    state.counters["resident"] = after - before;
  }
}

BENCHMARK(memory)->Name("memory/3D")->Arg(47)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(stencil<2>)->Name("stencil/2D")->Arg(200)->Arg(500)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK(stencil<3>)->Name("stencil/3D")->Arg(30)->Arg(47)->Arg(64)->Unit(benchmark::kMillisecond);
BENCHMARK(calibrated<2>)->Name("stencil_discrete/2D")->Arg(200)->Unit(benchmark::kMillisecond);
BENCHMARK(calibrated<3>)->Name("stencil_discrete/3D")->Arg(47)->Unit(benchmark::kMillisecond);
BENCHMARK(partial<2>)->Name("stencil_partial/2D")->Arg(200)->Unit(benchmark::kMillisecond);
BENCHMARK(partial<3>)->Name("stencil_partial/3D")->Arg(47)->Unit(benchmark::kMillisecond);
BENCHMARK(negative<2, StiffnessForm::stencil>)->Name("stencil_negative/2D")->Arg(200)->Arg(1000);
BENCHMARK(negative<3, StiffnessForm::stencil>)->Name("stencil_negative/3D")->Arg(47)->Arg(100);
BENCHMARK(negative<2, StiffnessForm::bonds>)->Name("bonds_negative/2D")->Arg(200);
BENCHMARK(negative<3, StiffnessForm::bonds>)->Name("bonds_negative/3D")->Arg(47);
BENCHMARK(bonds<2>)->Name("bonds/2D")->Arg(200)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK(bonds<3>)->Name("bonds/3D")->Arg(30)->Arg(47)->Unit(benchmark::kMillisecond);
BENCHMARK(blocks<2>)->Name("blocks/2D")->Arg(200)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK(blocks<3>)->Name("blocks/3D")->Arg(30)->Arg(47)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace perimode
