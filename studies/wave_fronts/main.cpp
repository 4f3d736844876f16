// SPDX-License-Identifier: BSD-3-Clause
//
// wave_fronts [--coarse] [--out OUT]: the 3D micromodulus of horizon m = 2 and 3 optimised against
// dispersion, its certificate beside the original's, and the waves of a point force before and after, against
// Stokes' solution. Writes OUT/kernel_m.csv, OUT/dispersion.csv and OUT/front_m_name.csv. Exit code 1: a
// check failed.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "fronts.hpp"
#include "perimode/dispersion/waves.hpp"
#include "perimode/io/table.hpp"

namespace {

using namespace perimode;
using namespace perimode::studies;

void print_pair(const KernelPair& pair) {
  const auto& shells = pair.original.lattice.family.shell;
  fmt::print("m = {}: {} orbits, {} bonds\n", pair.original.ratio, shells.size(),
             pair.original.lattice.family.size());
  for (std::size_t s = 0; s < shells.size(); ++s)
    fmt::print("  ({} {} {})  {:>14.8f}\n", shells[s][0], shells[s][1], shells[s][2], pair.optimum.alpha[s]);
  fmt::print("  constraints {:.1e}, optimality {:.1e}, by {}\n\n", pair.optimum.constraint_error,
             pair.optimum.optimality, pair.optimum.solver);
  fmt::print("  {:<10}{:>12}{:>12}{:>12}{:>12}{:>12}{:>12}{:>12}{:>12}\n", "kernel", "long waves", "5 % P to",
             "5 % S to", "rms P", "rms S", "E l1", "omega_max", "least w2/k2");
  for (const KernelWaves* w : {&pair.original, &pair.optimised})
    fmt::print("  {:<10}{:>12.1e}{:>12.4f}{:>12.4f}{:>12.4f}{:>12.4f}{:>12.4f}{:>12.4f}{:>12.4f}\n", w->name,
               w->long_wave_error, w->band[0], w->band[1], w->zone.phase_error[0], w->zone.phase_error[1],
               w->error.l1 / pair.original.error.l1, w->zone.omega_max, w->zone.least_speed_squared);
  fmt::print("\n");
}

void add_curves(const KernelWaves& kernel, Table& table) {
  const ZonePath<3> path = zone_path<3>(irreducible_contour<3>(), 1.0, 400);
  const auto waves = waves_along<3>(kernel.lattice, path);
  for (std::size_t i = 0; i < waves.size(); ++i)
    table.rows.push_back({Offset{kernel.ratio}, kernel.name, path.length[i], waves[i].k.norm(),
                          waves[i].angular_frequency[0], waves[i].angular_frequency[1],
                          waves[i].angular_frequency[2]});
}

void write_front(const std::filesystem::path& file, const Front& front) {
  Table table;
  table.columns = {"x", "z", "u_x", "u_z", "exact_x", "exact_z"};
  for (std::size_t i = 0; i < front.position.size(); ++i)
    table.rows.push_back({front.position[i][0], front.position[i][2], front.displacement[i][0],
                          front.displacement[i][2], front.exact[i][0], front.exact[i][2]});
  write_csv(file, table);
}

void write_kernel(const std::filesystem::path& file, const KernelPair& pair) {
  Table table;
  table.columns = {"dx", "dy", "dz", "distance", "alpha"};
  const auto& shells = pair.original.lattice.family.shell;
  for (std::size_t s = 0; s < shells.size(); ++s) {
    const double r =
        std::sqrt(shells[s][0] * shells[s][0] + shells[s][1] * shells[s][1] + shells[s][2] * shells[s][2]);
    table.rows.push_back(
        {Offset{shells[s][0]}, Offset{shells[s][1]}, Offset{shells[s][2]}, r, pair.optimum.alpha[s]});
  }
  write_csv(file, table);
}

/// What has to hold of a pair of kernels and their fronts.
void check(const KernelPair& pair, const Front& before, const Front& after, std::vector<std::string>& wrong) {
  const auto require = [&](bool holds, std::string what) {
    if (!holds) wrong.push_back(fmt::format("m = {}: {}", pair.original.ratio, what));
  };
  require(pair.optimum.status == OptimiseStatus::optimal, "no optimum");
  require(pair.optimised.long_wave_error < 1e-10, "long waves are not exact");
  require(pair.optimised.zone.least_squared > 0.0, "the optimised lattice is unstable");
  require(pair.optimised.error.l2 < pair.original.error.l2, "the contour error did not fall");
  require(after.error < 0.5 * before.error,
          fmt::format("front {:.3f} before, {:.3f} after", before.error, after.error));
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  const bool coarse = std::erase(words, "--coarse") > 0;
  if (!(words.empty() || (words.size() == 2 && words[0] == "--out"))) {
    fmt::print(stderr, "usage: wave_fronts [--coarse] [--out OUT]\n");
    return 2;
  }
  try {
    const std::filesystem::path out = words.empty() ? "" : words[1];
    if (!out.empty()) std::filesystem::create_directories(out);
    const PointSource source = coarse ? PointSource{49, 6.0, 11.0} : PointSource{};
    Table curves;
    curves.columns = {"m", "kernel", "path", "k", "P", "S1", "S2"};
    std::vector<std::string> wrong;
    for (const int ratio : {2, 3}) {
      const KernelPair pair = kernel_pair(ratio);
      print_pair(pair);
      const double dt = 0.5 * pair.optimised.zone.stable_step;
      const Front before = front_of(pair.original, source, dt), after = front_of(pair.optimised, source, dt);
      for (const auto& [kernel, front] :
           {std::pair(&pair.original, &before), std::pair(&pair.optimised, &after)})
        fmt::print(
            "  front of the {:<10}{} steps of {:.4f} s in {:.1f} s: error {:.4f} of Stokes' solution\n",
            kernel->name, front->steps, front->dt, front->seconds, front->error);
      fmt::print("\n");
      check(pair, before, after, wrong);
      if (out.empty()) continue;
      add_curves(pair.original, curves);
      add_curves(pair.optimised, curves);
      write_kernel(out / fmt::format("kernel_{}.csv", ratio), pair);
      write_front(out / fmt::format("front_{}_original.csv", ratio), before);
      write_front(out / fmt::format("front_{}_optimised.csv", ratio), after);
    }
    if (!out.empty()) write_csv(out / "dispersion.csv", curves);
    for (const std::string& line : wrong) fmt::print("  {}\n", line);
    fmt::print("{} of 10 checks failed\n", wrong.size());
    return wrong.empty() ? 0 : 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "wave_fronts: {}\n", error.what());
    return 1;
  }
}
