// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "perimode/assembly/breakable_stiffness.hpp"
#include "support/models.hpp"
#include "support/negative_shells.hpp"

namespace perimode::test {

/// Any mixture of what a body with a symmetric K can have, a few hundred particles.
inline Model random_symmetric_model(unsigned seed, int dim) {
  std::mt19937 generator(seed);
  const auto upto = [&](int n) { return static_cast<int>(generator() % static_cast<unsigned>(n)); };
  std::vector<int> cells;
  for (int a = 0; a < dim; ++a) cells.push_back(2 + upto(dim == 3 ? 6 : dim == 2 ? 14 : 70));
  Model m = box_model(cells, 0.25, 1.5 + 0.3 * upto(dim == 3 ? 4 : 8));
  m.material.micromodulus.kernel = upto(2) ? Kernel::constant : Kernel::gaussian;
  m.volume_correction = upto(2) ? VolumeCorrection::none : VolumeCorrection::linear;
  constexpr std::array walls = {WallType::mirror, WallType::antimirror, WallType::zero_layer, WallType::odd,
                                WallType::even};
  for (int a = 0; a < dim; ++a) {
    m.periodic[a] = upto(4) == 0;
    for (bool upper : {false, true})
      if (!m.periodic[a] && upto(2) == 0) add_wall(m, a, upper, walls[upto(dim == 1 ? 5 : 3)]);
  }
  for (int k = upto(3); k > 0; --k) fix_face(m, upto(dim), upto(2) == 0, 1, {upto(dim)});
  if (upto(2)) {
    Coordinates corner;
    for (int c : cells) corner.push_back(0.25 * (c / 2));
    m.blocks.push_back({"corner", Region{BoxRegion{Coordinates(corner.size(), 0.0), corner}, {}}});
    m.block_materials["corner"] = m.material;
    m.block_materials["corner"].youngs_modulus = 3.0;
  }
  m.calibration = upto(2) ? Calibration::discrete : Calibration::continuum;
  return m;
}

/// The same with shells of which some are negative, in both blocks.
inline Model random_negative_model(unsigned seed, int dim) {
  Model m = random_symmetric_model(seed, dim);
  const double spacing = std::get<GridSpec>(m.particles).spacing;
  m.volume_correction = VolumeCorrection::none;
  m.calibration = Calibration::continuum;
  m.material.micromodulus = random_shells(dim, spacing, m.horizon.value * spacing, seed);
  for (auto& [name, material] : m.block_materials) material.micromodulus = m.material.micromodulus;
  return m;
}

/// A cloud of 250 particles in two blocks, in a file for the life of the object.
class BreakingCloud {
 public:
  explicit BreakingCloud(int dim)
      : path_(std::filesystem::temp_directory_path() /
              ("breaking_cloud_" + std::to_string(dim) + "_" + std::to_string(getpid()) + ".csv")) {
    std::ofstream out(path_);
    out << (dim == 1 ? "x" : dim == 2 ? "x,y" : "x,y,z") << ",volume,block\n";
    std::mt19937 generator(7);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (int i = 0; i < 250; ++i) {
      for (int a = 0; a < dim; ++a) out << 5.0 * uniform(generator) << ',';
      out << 0.5 + uniform(generator) << ',' << (i % 3 == 0 ? "one" : "two") << '\n';
    }
    model.dimension = dim;
    model.particles = CloudSpec{path_, {}};
    model.horizon = {HorizonSpec::Rule::neighbours, 12.0, {}};
    model.material.youngs_modulus = model.material.density = 1.0;
    model.block_materials["one"] = model.material;
    model.block_materials["one"].youngs_modulus = 3.0;
  }
  BreakingCloud(const BreakingCloud&) = delete;
  BreakingCloud& operator=(const BreakingCloud&) = delete;
  ~BreakingCloud() { std::filesystem::remove(path_); }

  Model model;

 private:
  std::filesystem::path path_;
};

/// Calls check(body) for random bodies of the dimension, grids and a cloud.
template <int Dim, class Check>
void for_random_bodies(int grids, const Check& check) {
  for (int seed = 1; seed <= grids; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed) + " in " + std::to_string(Dim) + "D");
    check(build_body<Dim>(random_symmetric_model(static_cast<unsigned>(seed), Dim)));
  }
  SCOPED_TRACE("cloud in " + std::to_string(Dim) + "D");
  BreakingCloud cloud(Dim);
  check(build_body<Dim>(cloud.model));
  cloud.model.boundary.push_back({Fix{{0}, Region{FaceRegion{{0, false}, 0, 0.6}, {}}}, {}});
  cloud.model.calibration = Calibration::discrete;
  check(build_body<Dim>(cloud.model));
  std::get<CloudSpec>(cloud.model.particles).period.assign(Dim, 5.0);
  for (int a = 0; a < Dim; ++a) cloud.model.periodic[static_cast<std::size_t>(a)] = true;
  check(build_body<Dim>(cloud.model));
}

/// Calls check(body) for random grids some of whose bonds are negative.
template <int Dim, class Check>
void for_negative_bodies(int grids, const Check& check) {
  for (int seed = 1; seed <= grids; ++seed) {
    SCOPED_TRACE("negative, seed " + std::to_string(seed) + " in " + std::to_string(Dim) + "D");
    const auto body = build_body<Dim>(random_negative_model(static_cast<unsigned>(seed), Dim));
    ASSERT_TRUE(softening(body));
    check(body);
  }
}

/// All alive bonds from all ends.
template <int Dim>
std::vector<BondRef> all_ends(const Body<Dim>& body) {
  std::vector<BondRef> bonds;
  for (Index i = 0; i < body.count(); ++i)
    for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
      bonds.push_back({i, end.slot});
    });
  return bonds;
}

/// About `count` alive bonds, some near each other, from any end, with their images.
template <int Dim>
std::vector<BondRef> some_bonds(const Body<Dim>& body, std::size_t count, unsigned seed) {
  std::vector<BondRef> all = all_ends(body);
  std::mt19937 generator(seed);
  std::vector<BondRef> chosen;
  for (std::size_t k = 0; k < count && !all.empty(); ++k) {
    const std::size_t at = generator() % all.size();
    chosen.push_back(all[at]);
    chosen.push_back(all[(at + 1) % all.size()]);
  }
  return with_images(body, chosen);
}

}  // namespace perimode::test
