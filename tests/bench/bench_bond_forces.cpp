// SPDX-License-Identifier: BSD-3-Clause
// Whole steps of central differences with bonds that turn and break, m = 3.01, the breaking of every bond
// checked at every step, free faces, one smooth wave. Counters: ns per particle and step, the best of many
// batches; million particle-steps per second; bonds broken in the run. Name: case/dimension/cells per
// axis/threads. elastic: nothing breaks; cracking: a wave strong enough to break bonds all over; history:
// energies at every step; linear: kinematics without turning. One thread: processor time, several: elapsed
// time.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

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

struct Case {
  Kinematics kinematics = Kinematics::large_rotation;
  double critical_stretch = 1e3;
  double speed = 0.1;  ///< of the wave, over that of sound, about
  bool history = false;
};

template <int Dim>
void steps(benchmark::State& state, const Case& what) {
  const int n = static_cast<int>(state.range(0));
  const int before = threads();
  set_threads(static_cast<int>(state.range(1)));
  auto body = build_body<Dim>(test::box_model(std::vector<int>(Dim, n), 1.0 / n, 3.01));
  Motion motion;
  motion.mass = lumped_mass(body);
  const double dt = 1.0 / std::sqrt(stiffness_bound(body) / motion.mass.minCoeff());
  BondForces<Dim> forces(body, what.kinematics, {what.critical_stretch});
  const auto run = central_difference(motion, forces, dt);
  Eigen::VectorXd v = Eigen::VectorXd::Zero(body.count() * Dim);
  for (Index i = 0; i < body.count(); ++i)
    v[static_cast<Eigen::Index>(i) * Dim] =
        what.speed * std::sin(6.283185307179586 * body.particles.position[i][0]);
  run->start(Eigen::VectorXd::Zero(v.size()), v);
  const int batch = std::max(1, 200000 / body.count());  // some ten milliseconds
  double best = 1e30;
  for (auto _ : state) {
    const double start = seconds();
    for (int k = 0; k < batch; ++k) run->advance(what.history);
    best = std::min(best, (seconds() - start) / batch);
  }
  set_threads(before);
  state.counters["ns/particle"] = best / body.count() * 1e9;
  state.counters["Mparticles/s"] = body.count() / best * 1e-6;
  state.counters["broken"] = static_cast<double>(run->broken_bonds());
}

void add(const char* name, const Case& what) {
  const std::string start = name;
  benchmark::RegisterBenchmark((start + "/2D").c_str(), steps<2>, what)
      ->Args({300, 1})
      ->Args({300, 2})
      ->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark((start + "/3D").c_str(), steps<3>, what)
      ->Args({47, 1})
      ->Args({47, 2})
      ->Unit(benchmark::kMillisecond);
}

const bool registered = [] {
  add("elastic", {});
  add("cracking", {Kinematics::large_rotation, 0.01, 0.3, false});
  add("history", {Kinematics::large_rotation, 1e3, 0.1, true});
  add("linear", {Kinematics::linear, 1e3, 0.1, false});
  return true;
}();

}  // namespace
}  // namespace perimode
