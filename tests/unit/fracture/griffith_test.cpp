// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/fracture/griffith.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "perimode/assembly/precracks.hpp"
#include "perimode/fracture/crack_area.hpp"
#include "perimode/material/critical_stretch.hpp"
#include "support/models.hpp"

namespace perimode {
namespace {

using test::add_crack;
using test::add_wall;
using test::box_model;

template <int Dim>
double area_of(const Model& model, const Crack<Dim>& crack) {
  const auto body = build_body<Dim>(model);
  const auto bonds = crossing_bonds(body, crack);
  EXPECT_FALSE(bonds.empty());
  return crack_area(body, crack_area_scale(model, body), std::span<const BondRef>(bonds));
}

Crack<2> segment(Point<2> from, Point<2> to) { return {{from, to}, {false, false}}; }

/// Every offset crosses a stretch of n spacings exactly n times where no crossing point falls on its ends:
/// for offsets within 4 cells they lie at multiples of spacing/120 from the cells' faces.
TEST(CrackArea, APlaneCutAlongAnAxisCountsAsItsLength) {
  for (const auto correction : {VolumeCorrection::none, VolumeCorrection::linear}) {
    Model m = box_model({40, 30}, 0.25, 3.015);
    m.volume_correction = correction;
    m.thickness = 0.3;
    for (const double height : {3.75, 3.8}) {
      EXPECT_NEAR(area_of<2>(m, segment({2.0001, height}, {6.0001, height})), 4.0, 1e-12);
      EXPECT_NEAR(area_of<2>(m, segment({height, 2.0001}, {height, 5.2501})), 3.25, 1e-12);
    }
    m.periodic[0] = true;
    EXPECT_NEAR(area_of<2>(m, segment({0.0, 3.75}, {10.0, 3.75})), 10.0, 1e-12);
    m.periodic[0] = false;  // a crack between walls that mirror it is as long as the body
    add_wall(m, 0, false, WallType::mirror);
    add_wall(m, 0, true, WallType::mirror);
    EXPECT_NEAR(area_of<2>(m, segment({0.0, 3.75}, {10.0, 3.75})), 10.0, 1e-12);
  }
}

TEST(CrackArea, APlaneCutAlongAnAxisCountsAsItsArea) {
  Model m = box_model({10, 9, 11}, 0.5, 2.0);
  const Crack<3> square{
      {{1.0001, 1.0003, 2.5}, {4.0001, 1.0003, 2.5}, {4.0001, 3.5003, 2.5}, {1.0001, 3.5003, 2.5}},
      {false, false, false, false}};
  EXPECT_NEAR(area_of<3>(m, square), 7.5, 1e-12);
  m.periodic = {true, true, false};
  const Crack<3> whole{{{0.0, 0.0, 2.5}, {5.0, 0.0, 2.5}, {5.0, 4.5, 2.5}, {0.0, 4.5, 2.5}},
                       {false, false, false, false}};
  EXPECT_NEAR(area_of<3>(m, whole), 22.5, 1e-12);
}

TEST(CrackArea, ACutThroughABarIsOne) {
  Model m = box_model({30}, 0.5, 3.0);
  m.area = 0.2;
  EXPECT_NEAR(area_of<1>(m, Crack<1>{{Point<1>(7.0)}, {false}}), 1.0, 1e-12);
  add_wall(m, 0, true, WallType::mirror);
  EXPECT_NEAR(area_of<1>(m, Crack<1>{{Point<1>(12.0)}, {false}}), 1.0, 1e-12);
  // The wall itself is where the bar meets its image: half a cut each.
  EXPECT_NEAR(area_of<1>(m, Crack<1>{{Point<1>(15.0)}, {false}}), 0.5, 1e-12);
}

TEST(CrackArea, PreCracksCountAsGiven) {
  Model m = box_model({20, 20}, 0.5, 3.0);
  add_crack(m, {{0.0, 5.0}, {3.0, 5.0}});
  add_crack(m, {{6.0, 5.0}, {6.0, 9.0}});
  EXPECT_NEAR(crack_area_scale(m, build_body<2>(m)).initial, 7.0, 1e-14);
  Model solid = box_model({8, 8, 8}, 0.5, 2.0);
  add_crack(solid, {{0.0, 0.0, 2.0}, {1.0, 0.0, 2.0}, {1.0, 2.0, 2.0}, {0.0, 2.0, 2.0}});
  EXPECT_NEAR(crack_area_scale(solid, build_body<3>(solid)).initial, 2.0, 1e-14);
}

/// A cloud of the same mean density everywhere: a square lattice with every particle moved by up to a fifth
/// of a spacing. The sum over its bonds is a quadrature of the continuum's integral.
TEST(CrackArea, ACutThroughACloudIsCloseToItsLength) {
  const auto path =
      std::filesystem::temp_directory_path() / ("crack_area_cloud_" + std::to_string(getpid()) + ".csv");
  {
    std::ofstream out(path);
    out << "x,y,volume\n";
    std::mt19937 generator(3);
    std::uniform_real_distribution<double> shift(-0.2, 0.2);
    for (int i = 0; i < 70; ++i)
      for (int j = 0; j < 70; ++j) out << i + shift(generator) << ',' << j + shift(generator) << ",0.5\n";
  }
  for (const auto rule : {HorizonSpec::Rule::length, HorizonSpec::Rule::neighbours}) {
    Model m;
    m.thickness = 0.5;
    m.particles = CloudSpec{path, {}};
    m.horizon = {rule, rule == HorizonSpec::Rule::length ? 5.0 : 80.0, {}};
    m.material.youngs_modulus = m.material.density = 1.0;
    EXPECT_NEAR(area_of<2>(m, segment({15.0, 34.0}, {55.0, 34.0})), 40.0, 0.04 * 40.0);
    EXPECT_NEAR(area_of<2>(m, segment({20.0, 20.0}, {50.0, 45.0})), std::hypot(30.0, 25.0), 0.06 * 39.0);
  }
  std::filesystem::remove(path);
}

TEST(Griffith, TheIncrementGoesStraightOnAndJoins) {
  Model m = box_model({40, 30}, 0.25, 3.0);
  add_crack(m, {{0.0, 3.75}, {3.0, 3.75}});
  add_crack(m, {{8.0, 1.0}, {8.0, 2.0}});
  const auto body = build_body<2>(m);
  const auto more = crack_increment(m, body);
  EXPECT_EQ(more.corner[0], Point<2>(3.0, 3.75));
  EXPECT_NEAR((more.corner[1] - Point<2>(3.25, 3.75)).norm(), 0.0, 1e-14);
  EXPECT_EQ(extent(more), 0.25);
  // Cutting what it adds leaves the body of the longer crack.
  for (const double spacings : {1.0, 3.0}) {
    Model longer = m;
    longer.precracks[0].points[1][0] += 0.25 * spacings;
    Body<2> cut = body;
    const auto bonds = crossing_bonds(cut, crack_increment(m, body, spacings));
    for (const BondRef& b : bonds) break_bond(cut.bonds, b.particle, b.slot);
    EXPECT_EQ(std::get<GridBonds<2>>(cut.bonds).alive,
              std::get<GridBonds<2>>(build_body<2>(longer).bonds).alive);
    EXPECT_GT(bonds.size(), 0U);
  }
}

TEST(Griffith, TheIncrementOfAPolygonLiesAtItsFarEdge) {
  Model m = box_model({10, 9, 11}, 0.5, 2.0);
  for (const bool other_way : {false, true}) {
    m.precracks.clear();
    std::vector<Coordinates> corners = {{0.0, 0.0, 2.5}, {0.0, 4.5, 2.5}, {2.0, 4.5, 2.5}, {2.0, 0.0, 2.5}};
    if (other_way) corners = {{0.0, 4.5, 2.5}, {0.0, 0.0, 2.5}, {2.0, 0.0, 2.5}, {2.0, 4.5, 2.5}};
    add_crack(m, corners);
    const auto body = build_body<3>(m);
    const auto more = crack_increment(m, body, 2.0);
    EXPECT_NEAR(extent(more), 4.5, 1e-13);
    for (const auto& c : more.corner) EXPECT_GE(c[0], 2.0);
    Model longer = m;
    longer.precracks[0].points[2][0] = longer.precracks[0].points[3][0] = 3.0;
    Body<3> cut = body;
    for (const BondRef& b : crossing_bonds(cut, more)) break_bond(cut.bonds, b.particle, b.slot);
    EXPECT_EQ(std::get<GridBonds<3>>(cut.bonds).alive,
              std::get<GridBonds<3>>(build_body<3>(longer).bonds).alive);
  }
}

TEST(Griffith, WithoutACrackNothingGrows) {
  const Model m = box_model({10, 9}, 0.5, 2.0);
  EXPECT_THROW((void)crack_increment(m, build_body<2>(m)), Error);
  Model bar = box_model({10}, 0.5, 2.0);
  add_crack(bar, {{2.0}});
  EXPECT_THROW((void)crack_increment(bar, build_body<1>(bar)), Error);
}

/// The critical stretch of a fracture energy has that fracture energy.
TEST(Griffith, FractureEnergiesThereAndBack) {
  for (const auto kernel : {Kernel::constant, Kernel::conical, Kernel::gaussian, Kernel::inverse_distance}) {
    Model m = box_model({12, 9}, 0.5, 3.0);
    m.plane = Plane::strain;
    m.thickness = 0.7;
    m.material.micromodulus.kernel = kernel;
    EXPECT_THROW((void)fracture_energy_of(m, build_body<2>(m)), Error);
    m.material.fracture_energy = 135.0;
    const auto body = build_body<2>(m);
    EXPECT_EQ(fracture_energy_of(m, body), 135.0);
    m.material.critical_stretch =
        critical_stretch(m.material.micromodulus, 1.0, 135.0, 1.5, {2, Plane::strain, 0.7});
    m.material.fracture_energy.reset();
    EXPECT_NEAR(fracture_energy_of(m, body), 135.0, 1e-10);
  }
}

/// What a unit of crack stores at the critical stretch is the fracture energy: bond by bond, on a lattice
/// fine enough for the sum to be near the integral.
TEST(Griffith, BrokenBondsHoldTheFractureEnergy) {
  Model m = box_model({60, 60}, 0.5, 8.0);
  m.thickness = 0.7;
  m.material.youngs_modulus = 3.0;
  m.material.critical_stretch = 0.01;
  const auto body = build_body<2>(m);
  double sum = 0.0;
  for (const BondRef& b : crossing_bonds(body, segment({10.0001, 15.0}, {20.0001, 15.0}))) {
    const auto end = bond_end(body, b);
    sum += 0.5 * bond_stiffness(body, b.particle, end) * std::pow(0.01 * end.length, 2);
  }
  EXPECT_NEAR(sum / (10.0 * 0.7), fracture_energy_of(m, body), 0.05 * fracture_energy_of(m, body));
}

}  // namespace
}  // namespace perimode
