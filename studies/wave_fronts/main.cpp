// SPDX-License-Identifier: BSD-3-Clause
//
// wave_fronts [--coarse] [--out OUT]: the 3D micromodulus of horizon m = 2 and 3 optimised against dispersion
// on the contour and over the zone, certificates beside the original's, and the waves of a point force before
// and after, against Stokes' solution. Writes OUT/kernel_m.csv (the zone's optimum), OUT/dispersion.csv and
// OUT/front_m_name.csv. Exit code 1: a check failed.
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

void print_kernels(const Kernels& kernels) {
  const auto& shells = kernels.original.lattice.family.shell;
  fmt::print("m = {}: {} orbits, {} bonds\n", kernels.original.ratio, shells.size(),
             kernels.original.lattice.family.size());
  fmt::print("  {:<10}{:>16}{:>16}\n", "alpha", "contour", "zone");
  for (std::size_t s = 0; s < shells.size(); ++s)
    fmt::print("  ({} {} {})   {:>16.8f}{:>16.8f}\n", shells[s][0], shells[s][1], shells[s][2],
               kernels.on_contour.alpha[s], kernels.on_zone.alpha[s]);
  for (const auto* optimum : {&kernels.on_contour, &kernels.on_zone})
    fmt::print("  constraints {:.1e}, optimality {:.1e}, by {}\n", optimum->constraint_error,
               optimum->optimality, optimum->solver);
  fmt::print("\n  {:<10}{:>12}{:>12}{:>12}{:>12}{:>12}{:>12}{:>12}{:>12}\n", "kernel", "long waves",
             "5 % P to", "5 % S to", "rms P", "rms S", "E l1", "omega_max", "least w2/k2");
  for (const KernelWaves* w : {&kernels.original, &kernels.contour, &kernels.zone})
    fmt::print("  {:<10}{:>12.1e}{:>12.4f}{:>12.4f}{:>12.4f}{:>12.4f}{:>12.4f}{:>12.4f}{:>12.4f}\n", w->name,
               w->long_wave_error, w->band[0], w->band[1], w->zone.phase_error[0], w->zone.phase_error[1],
               w->error.l1 / kernels.original.error.l1, w->zone.omega_max, w->zone.least_speed_squared);
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

void write_kernel(const std::filesystem::path& file, const Kernels& kernels) {
  Table table;
  table.columns = {"dx", "dy", "dz", "distance", "alpha"};
  const auto& shells = kernels.original.lattice.family.shell;
  for (std::size_t s = 0; s < shells.size(); ++s) {
    const auto& o = shells[s];
    const double r = std::sqrt(o[0] * o[0] + o[1] * o[1] + o[2] * o[2]);
    table.rows.push_back({Offset{o[0]}, Offset{o[1]}, Offset{o[2]}, r, kernels.on_zone.alpha[s]});
  }
  write_csv(file, table);
}

/// What has to hold of kernels and fronts.
void check(const Kernels& kernels, std::vector<std::string>& wrong) {
  const auto require = [&](bool holds, const std::string& what) {
    if (!holds) wrong.push_back(fmt::format("m = {}: {}", kernels.original.ratio, what));
  };
  const KernelWaves& zone = kernels.zone;
  require(kernels.on_zone.status == OptimiseStatus::optimal, "no optimum");
  require(zone.long_wave_error < 1e-10 && kernels.contour.long_wave_error < 1e-10,
          "long waves are not exact");
  require(zone.zone.least_squared > 0.0, "the optimum of the zone is unstable");
  require(kernels.contour.error.l2 < zone.error.l2 && zone.error.l2 < kernels.original.error.l2,
          "the contour's errors are not in order");
  require(zone.zone.phase_error[0] < 0.5 * kernels.original.zone.phase_error[0],
          "the zone's error did not halve");
}

void check_fronts(int ratio, const Front& before, const Front& after, std::vector<std::string>& wrong) {
  if (after.error < (ratio == 2 ? 0.9 : 0.5) * before.error) return;  // two layers of neighbours win less
  wrong.push_back(fmt::format("m = {}: front {:.3f} before, {:.3f} after", ratio, before.error, after.error));
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
    const PointSource source = coarse ? PointSource{41, 6.0, 10.0} : PointSource{};
    Table curves;
    curves.columns = {"m", "kernel", "path", "k", "P", "S1", "S2"};
    std::vector<std::string> wrong;
    for (const int ratio : {2, 3}) {
      const Kernels kernels = kernels_of(ratio);
      print_kernels(kernels);
      check(kernels, wrong);
      if (!out.empty()) {
        for (const KernelWaves* kernel : {&kernels.original, &kernels.contour, &kernels.zone})
          add_curves(*kernel, curves);
        write_kernel(out / fmt::format("kernel_{}.csv", ratio), kernels);
      }
      if (coarse && ratio > 2) continue;
      const double dt = 0.5 * kernels.zone.zone.stable_step;
      const Front before = front_of(kernels.original, source, dt), after = front_of(kernels.zone, source, dt);
      for (const auto& [kernel, front] :
           {std::pair(&kernels.original, &before), std::pair(&kernels.zone, &after)})
        fmt::print("  front, {:<10}{} steps of {:.4f} s in {:.1f} s: error {:.4f} of Stokes' solution\n",
                   kernel->name, front->steps, front->dt, front->seconds, front->error);
      fmt::print("\n");
      check_fronts(ratio, before, after, wrong);
      if (out.empty()) continue;
      write_front(out / fmt::format("front_{}_original.csv", ratio), before);
      write_front(out / fmt::format("front_{}_zone.csv", ratio), after);
    }
    if (!out.empty()) write_csv(out / "dispersion.csv", curves);
    for (const std::string& line : wrong) fmt::print("  {}\n", line);
    fmt::print("{} of {} checks failed\n", wrong.size(), coarse ? 11 : 12);
    return wrong.empty() ? 0 : 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "wave_fronts: {}\n", error.what());
    return 1;
  }
}
