// SPDX-License-Identifier: BSD-3-Clause
// Steps of central differences, m = 3, elastic bodies with free faces. Counters: ns per free dof and step,
// the best of many batches; million particle-steps per second; MiB resident. Name: form/dimension/cells per
// axis/threads; `history`, energies at every step; `large`, ten million particles in 2D, two million in 3D;
// `block`, the problem of lammps.py. One thread: processor time, several: elapsed time.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <fstream>

#include "perimode/assembly/assemble.hpp"
#include "perimode/assembly/operators.hpp"
#include "perimode/dynamics/central_difference.hpp"
#include "perimode/linalg/threads.hpp"
#include "support/models.hpp"

namespace perimode {
namespace {

double seconds() {
  if (threads() == 1) return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// MiB of this process that are in memory.
double resident() {
  std::ifstream status("/proc/self/statm");
  double all = 0.0, pages = 0.0;
  status >> all >> pages;
  return pages * 4096.0 / 1048576.0;
}

/// One smooth wave of velocity along x.
template <int Dim>
Eigen::VectorXd wave(const Body<Dim>& body) {
  Eigen::VectorXd v = Eigen::VectorXd::Zero(body.count() * Dim);
  for (Index i = 0; i < body.count(); ++i)
    v[static_cast<Eigen::Index>(i) * Dim] = 0.1 * std::sin(6.283185307179586 * body.particles.position[i][0]);
  return v;
}

template <int Dim>
void steps(benchmark::State& state, StiffnessForm form, bool history, double ratio = 3.0) {
  const int n = static_cast<int>(state.range(0));
  const int before = threads();
  set_threads(static_cast<int>(state.range(1)));
  const auto body = build_body<Dim>(test::box_model(std::vector<int>(Dim, n), 1.0 / n, ratio));
  Motion motion;
  motion.mass = lumped_mass(body);
  motion.stiffness = stiffness_rows(body, form);
  const double dt = 1.8 / std::sqrt(stiffness_bound(body) / motion.mass.minCoeff());
  const auto run = central_difference(motion, dt);
  run->start(Eigen::VectorXd::Zero(motion.stiffness.size), wave(body));
  // Batches of some ten milliseconds.
  const int batch = std::max(1, static_cast<int>(3e6 / motion.stiffness.size));
  double best = 1e30;
  for (auto _ : state) {
    const double start = seconds();
    for (int k = 0; k < batch; ++k) run->advance(history);
    best = std::min(best, (seconds() - start) / batch);
  }
  state.counters["ns/dof"] = 1e9 * best / motion.stiffness.size;
  state.counters["Mparticles/s"] = 1e-6 * body.count() / best;
  state.counters["resident MiB"] = resident();
  set_threads(before);
}

template <int Dim>
void stencil(benchmark::State& state) {
  steps<Dim>(state, StiffnessForm::stencil, false);
}
template <int Dim>
void history(benchmark::State& state) {
  steps<Dim>(state, StiffnessForm::stencil, true);
}
template <int Dim>
void bonds(benchmark::State& state) {
  steps<Dim>(state, StiffnessForm::bonds, false);
}
template <int Dim>
void blocks(benchmark::State& state) {
  steps<Dim>(state, StiffnessForm::blocks, false);
}
void block(benchmark::State& state) { steps<3>(state, StiffnessForm::stencil, false, 3.01); }

constexpr auto ms = benchmark::kMillisecond;
BENCHMARK(stencil<2>)->Name("stencil/2D")->ArgsProduct({{200, 1000}, {1, 2}})->Unit(ms);
BENCHMARK(stencil<3>)->Name("stencil/3D")->ArgsProduct({{30, 64}, {1, 2}})->Unit(ms);
BENCHMARK(history<2>)->Name("history/2D")->ArgsProduct({{200, 1000}, {1}})->Unit(ms);
BENCHMARK(history<3>)->Name("history/3D")->ArgsProduct({{30, 64}, {1}})->Unit(ms);
BENCHMARK(bonds<2>)->Name("bonds/2D")->ArgsProduct({{200, 1000}, {1, 2}})->Unit(ms);
BENCHMARK(bonds<3>)->Name("bonds/3D")->ArgsProduct({{30, 64}, {1, 2}})->Unit(ms);
BENCHMARK(blocks<2>)->Name("blocks/2D")->ArgsProduct({{200}, {1, 2}})->Unit(ms);
BENCHMARK(blocks<3>)->Name("blocks/3D")->ArgsProduct({{30}, {1, 2}})->Unit(ms);
BENCHMARK(block)->Name("block/3D")->Args({47, 1})->Unit(ms);
BENCHMARK(stencil<2>)->Name("large/2D")->ArgsProduct({{3163}, {1, 2}})->Iterations(3)->Unit(ms);
BENCHMARK(stencil<3>)->Name("large/3D")->ArgsProduct({{126}, {1, 2}})->Iterations(3)->Unit(ms);

}  // namespace
}  // namespace perimode
