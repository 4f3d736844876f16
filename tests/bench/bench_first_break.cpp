// SPDX-License-Identifier: BSD-3-Clause
// The search for the first break, per bond, and what a broken bond costs every form of K.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <fstream>

#include "perimode/assembly/bond_limits.hpp"
#include "perimode/assembly/breakable_stiffness.hpp"
#include "perimode/linalg/threads.hpp"
#include "support/models.hpp"

namespace perimode {
namespace {

Model plate(int n, bool blocks) {
  Model m = test::box_model({n, n}, 1.0 / n, 3.0);
  test::fix_face(m, 0, false, 3, {0, 1});
  if (blocks) {
    m.blocks.push_back({"half", Region{BoxRegion{{0.0, 0.0}, {0.5, 1.0}}, {}}});
    m.block_materials["half"] = m.material;
    m.block_materials["half"].youngs_modulus = 3.0;
  }
  return m;
}

template <int Dim>
void search(benchmark::State& state, const Body<Dim>& body, bool both) {
  set_threads(1);
  const auto dofs = static_cast<Eigen::Index>(body.boundary.free_number.size());
  std::srand(1);
  const Eigen::VectorXd u_1 = Eigen::VectorXd::Random(dofs);
  const Eigen::VectorXd u_0 =
      both ? Eigen::VectorXd(1e-5 * Eigen::VectorXd::Random(dofs)) : Eigen::VectorXd();
  const BondLimits limits{std::vector<double>(body.density.size(), 1.0)};
  const auto bonds = static_cast<double>(count_bonds(body.bonds, body.count()));
  for (auto _ : state) benchmark::DoNotOptimize(first_break(body, limits, u_0, u_1, 1e-6));
  state.counters["ns_per_bond"] = benchmark::Counter(
      bonds * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void first_break_plate(benchmark::State& state) {
  search(state, build_body<2>(plate(static_cast<int>(state.range(0)), state.range(2) != 0)),
         state.range(1) != 0);
}
BENCHMARK(first_break_plate)
    ->ArgNames({"n", "both", "blocks"})
    ->Args({200, 0, 0})
    ->Args({200, 1, 0})
    ->Args({200, 1, 1})
    ->Args({400, 0, 0})
    ->Args({400, 1, 0})
    ->Unit(benchmark::kMillisecond);

void first_break_block(benchmark::State& state) {
  search(state, build_body<3>(test::box_model({24, 24, 24}, 1.0, 3.0)), state.range(0) != 0);
}
BENCHMARK(first_break_block)->ArgNames({"both"})->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

void first_break_cloud(benchmark::State& state) {
  const auto path = std::filesystem::temp_directory_path() / "bench_first_break.csv";
  {
    std::ofstream out(path);
    out << "x,y,volume\n";
    for (int i = 0; i < 150; ++i)
      for (int j = 0; j < 150; ++j) out << i + 0.1 * (j % 3) << ',' << j + 0.1 * (i % 3) << ",1\n";
  }
  Model m;
  m.particles = CloudSpec{path, {}};
  m.horizon = {HorizonSpec::Rule::length, 3.2, {}};
  m.material.youngs_modulus = m.material.density = 1.0;
  const auto body = build_body<2>(m);
  std::filesystem::remove(path);
  search(state, body, state.range(0) != 0);
}
BENCHMARK(first_break_cloud)->ArgNames({"both"})->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

/// One bond after the other along a row, in one of the forms of K.
void break_bonds(benchmark::State& state) {
  set_threads(1);
  Body<2> body = build_body<2>(plate(400, false));
  BreakableStiffness<2> k(body, static_cast<StiffnessForm>(state.range(0)));
  Index particle = 200 * 400 + 50;
  for (auto _ : state) {
    for (Offset slot = 0; slot < 4; ++slot) {
      const BondRef bond{particle, slot};
      k.break_bonds(std::span(&bond, 1));
    }
    ++particle;
  }
}
BENCHMARK(break_bonds)
    ->Iterations(60'000)
    ->ArgNames({"form"})
    ->Arg(static_cast<int>(StiffnessForm::stencil))
    ->Arg(static_cast<int>(StiffnessForm::bonds))
    ->Arg(static_cast<int>(StiffnessForm::blocks));

}  // namespace
}  // namespace perimode
