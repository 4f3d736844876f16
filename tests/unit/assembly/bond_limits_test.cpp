// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/assembly/bond_limits.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "breaking_models.hpp"
#include "operator_checks.hpp"
#include "perimode/assembly/assemble.hpp"
#include "perimode/linalg/threads.hpp"

namespace perimode {
namespace {

using test::box_model;
using test::for_random_bodies;
using test::random_vector;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// s and s_c of a bond, one by one.
template <int Dim>
double stretch(const Body<Dim>& body, Index i, const BondEnd<Dim>& end, const Eigen::VectorXd& u) {
  if (u.size() == 0) return 0.0;
  const Point<Dim> other = partner_displacement(body.boundary, u.data(), end.neighbour, body.count(), false);
  const Point<Dim> relative = other - u.segment<Dim>(static_cast<Eigen::Index>(i) * Dim);
  return end.xi.dot(relative) / (end.length * end.length);
}
template <int Dim>
double limit(const Body<Dim>& body, const BondLimits& limits, Index i, const BondEnd<Dim>& end) {
  const Index j = owner(body.bonds, end.neighbour, body.count());
  const auto held = [&](Index p) {
    return !limits.no_fail.empty() && limits.no_fail[static_cast<std::size_t>(p)] != 0;
  };
  if (held(i) || held(j)) return infinity;
  const auto of = [&](Index p) {
    return limits
        .critical_stretch[static_cast<std::size_t>(body.particles.block[static_cast<std::size_t>(p)])];
  };
  return std::min(of(i), of(j));
}

template <int Dim, class Visit>
void for_all_ends(const Body<Dim>& body, const Visit& visit) {
  for (Index i = 0; i < body.count(); ++i)
    for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<Dim>& end) { visit(i, end); });
}

template <int Dim>
std::vector<BondRef> beyond(const Body<Dim>& body, const BondLimits& limits, const Eigen::VectorXd& u,
                            double least) {
  std::vector<BondRef> bonds;
  for_all_ends<Dim>(body, [&](Index i, const BondEnd<Dim>& end) {
    if (stretch(body, i, end, u) >= least * limit(body, limits, i, end)) bonds.push_back({i, end.slot});
  });
  return with_images(body, bonds);
}

template <int Dim>
double worst(const Body<Dim>& body, const BondLimits& limits, const Eigen::VectorXd& u) {
  double ratio = -infinity;
  for_all_ends<Dim>(body, [&](Index i, const BondEnd<Dim>& end) {
    const double s_c = limit(body, limits, i, end);
    if (s_c < infinity) ratio = std::max(ratio, stretch(body, i, end, u) / s_c);
  });
  return ratio;
}

double energy(const FirstBreak& found, double lambda) {
  return found.energy[0] + lambda * (2.0 * found.energy[1] + lambda * found.energy[2]);
}

/// Numbers agree to round-off of sums of a few thousand products; bonds are the same.
template <int Dim>
void expect_first_break(const Body<Dim>& body, const BondLimits& limits, const Eigen::VectorXd& u_0,
                        const Eigen::VectorXd& u_1, double tie) {
  double factor = infinity;
  for_all_ends<Dim>(body, [&](Index i, const BondEnd<Dim>& end) {
    const double s_1 = stretch(body, i, end, u_1);
    if (s_1 > 0.0)
      factor = std::min(factor, (limit(body, limits, i, end) - stretch(body, i, end, u_0)) / s_1);
  });
  const FirstBreak found = first_break(body, limits, u_0, u_1, tie);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(u_1.size());
  const Eigen::VectorXd base = u_0.size() > 0 ? u_0 : zero;
  for (const double lambda : {0.0, 1.0, -0.7}) {
    const double expected = bond_energy(body, Eigen::MatrixXd(base + lambda * u_1))[0];
    const double size =
        bond_energy(body, Eigen::MatrixXd(base))[0] + bond_energy(body, Eigen::MatrixXd(u_1))[0];
    EXPECT_NEAR(energy(found, lambda), expected, 1e-12 * size);
  }
  if (factor == infinity) {
    EXPECT_EQ(found.factor, infinity);
    EXPECT_TRUE(found.bonds.empty());
    return;
  }
  EXPECT_NEAR(found.factor, factor, 1e-12 * (1.0 + std::abs(factor)));
  const Eigen::VectorXd u = base + found.factor * u_1;
  EXPECT_NEAR(found.worst, worst(body, limits, u), 1e-11 * (1.0 + std::abs(found.worst)));
  EXPECT_FALSE(found.bonds.empty());
  EXPECT_EQ(found.bonds, beyond(body, limits, u, 1.0 - tie));
}

template <int Dim>
BondLimits some_limits(const Body<Dim>& body, bool no_fail) {
  BondLimits limits;
  for (std::size_t b = 0; b < body.density.size(); ++b) limits.critical_stretch.push_back(b == 0 ? 0.3 : 0.7);
  if (no_fail) {
    limits.no_fail.resize(static_cast<std::size_t>(body.count()));
    for (std::size_t i = 0; i < limits.no_fail.size(); ++i) limits.no_fail[i] = i % 7 == 0 ? 1 : 0;
  }
  return limits;
}

/// Displacements of all dofs, fixed ones zero.
template <int Dim>
Eigen::VectorXd field(const Body<Dim>& body, unsigned seed) {
  const Eigen::VectorXd q = random_vector(body.boundary.free, seed);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(body.boundary.free_number.size()));
  for (Eigen::Index d = 0; d < u.size(); ++d) {
    const Index number = body.boundary.free_number[static_cast<std::size_t>(d)];
    if (number >= 0) u[d] = q[number];
  }
  return u;
}

template <int Dim>
void expect_all(const Body<Dim>& body) {
  const auto some = [&](unsigned seed) { return field(body, seed); };
  for (const bool no_fail : {false, true}) {
    const BondLimits limits = some_limits(body, no_fail);
    for (const double tie : {1e-6, 0.2}) {
      expect_first_break(body, limits, {}, some(1), tie);
      expect_first_break(body, limits, Eigen::VectorXd(0.1 * some(2)), some(1), tie);
      expect_first_break(body, limits, some(3), Eigen::VectorXd(-0.5 * some(1)), tie);
    }
  }
  BondLimits never{std::vector<double>(body.density.size(), infinity)};
  expect_first_break(body, never, {}, some(1), 1e-6);
  never.critical_stretch[0] = 0.2;
  expect_first_break(body, never, {}, some(1), 1e-6);
}

TEST(BondLimits, TheFirstBreakIsThatOfAPlainLoop) {
  for_random_bodies<1>(20, expect_all<1>);
  for_random_bodies<2>(20, expect_all<2>);
  for_random_bodies<3>(10, expect_all<3>);
}

TEST(BondLimits, NothingStretchedNeverBreaks) {
  const auto body = build_body<2>(box_model({12, 9}, 1.0, 3.0));
  Eigen::VectorXd u(body.count() * 2);
  for (Index i = 0; i < body.count(); ++i)
    u.segment<2>(static_cast<Eigen::Index>(i) * 2) =
        -0.01 * body.particles.position[static_cast<std::size_t>(i)];
  const FirstBreak found = first_break(body, {{0.1}}, {}, u, 1e-6);
  EXPECT_EQ(found.factor, infinity);
  EXPECT_TRUE(found.bonds.empty());
  EXPECT_EQ(found.worst, 0.0);
  EXPECT_TRUE(overstretched(body, {{0.1}}, u, 0, 1e-6).bonds.empty());
}

/// Uniform stretch of a symmetric body: every bond is as far as every other, and all break together.
TEST(BondLimits, TiesBreakTogether) {
  const auto body = build_body<3>(box_model({5, 4, 4}, 0.5, 2.0));
  Eigen::VectorXd u(body.count() * 3);
  for (Index i = 0; i < body.count(); ++i)
    u.segment<3>(static_cast<Eigen::Index>(i) * 3) =
        0.01 * body.particles.position[static_cast<std::size_t>(i)];
  const FirstBreak found = first_break(body, {{0.1}}, {}, u, 1e-6);
  EXPECT_NEAR(found.factor, 10.0, 1e-10);
  EXPECT_EQ(static_cast<Offset>(found.bonds.size()), count_bonds(body.bonds, body.count()));
  // Along x alone those along x are stretched most: n_x^2 of the strain.
  for (Eigen::Index d = 0; d < u.size(); ++d)
    if (d % 3 != 0) u[d] = 0.0;
  const FirstBreak along = first_break(body, {{0.1}}, {}, u, 1e-6);
  EXPECT_NEAR(along.factor, 10.0, 1e-10);
  EXPECT_EQ(along.bonds.size(), static_cast<std::size_t>((4 + 3) * 4 * 4));  // one and two cells on
  for (const BondRef& b : along.bonds) EXPECT_EQ(bond_end(body, b).xi.tail<2>().norm(), 0.0);
}

/// A compressed body whose two halves are pulled apart at lambda = 0 already.
TEST(BondLimits, BondsBeyondAtZeroHaveANegativeFactor) {
  const auto body = build_body<1>(box_model({4}, 1.0, 1.0));
  Eigen::VectorXd u_0(4), u_1(4);
  u_0 << 0.0, 0.0, 0.3, 0.3;
  u_1 << 0.0, 0.0, 0.1, 0.1;
  const FirstBreak found = first_break(body, {{0.2}}, u_0, u_1, 1e-6);
  EXPECT_NEAR(found.factor, -1.0, 1e-12);
  ASSERT_EQ(found.bonds.size(), 1U);
  EXPECT_EQ(found.bonds[0].particle, 1);
  EXPECT_NEAR(found.worst, 1.0, 1e-12);
}

template <int Dim>
void expect_overstretched(const Body<Dim>& body) {
  const Eigen::VectorXd u = field(body, 4);
  for (const bool no_fail : {false, true}) {
    const BondLimits limits = some_limits(body, no_fail);
    const OverstretchedBonds all = overstretched(body, limits, u, 0, 1e-6);
    EXPECT_EQ(all.bonds, beyond(body, limits, u, 1.0 + 1e-12));
    EXPECT_NEAR(all.energy, bond_energy(body, Eigen::MatrixXd(u))[0], 1e-12 * all.energy);
    EXPECT_NEAR(all.worst, std::max(0.0, worst(body, limits, u)), 1e-12 * all.worst);
    if (all.bonds.size() < 8) continue;
    const OverstretchedBonds few = overstretched(body, limits, u, 3, 1e-9);
    EXPECT_EQ(few.worst, all.worst);
    // The worst three of the whole body: none that is left is as far as one of them. Beyond an antimirror
    // wall the image is as far compressed.
    double least = infinity;
    for (const BondRef& b : few.bonds)
      least = std::min(least, std::abs(stretch(body, b.particle, bond_end(body, b), u)) /
                                  limit(body, limits, b.particle, bond_end(body, b)));
    EXPECT_EQ(few.bonds, beyond(body, limits, u, least * (1.0 - 1e-9)));
    EXPECT_GE(few.bonds.size(), 3U);
    EXPECT_LE(few.bonds.size(), 6U);
  }
}

TEST(BondLimits, OverstretchedBondsAreThoseOfAPlainLoop) {
  for_random_bodies<1>(20, expect_overstretched<1>);
  for_random_bodies<2>(20, expect_overstretched<2>);
  for_random_bodies<3>(10, expect_overstretched<3>);
}

/// The states of all bonds give the energy of the body.
template <int Dim>
void expect_states(const Body<Dim>& body) {
  const Eigen::VectorXd u = field(body, 5);
  const auto bonds = with_images(body, test::all_ends(body));
  const auto states = bond_states(body, std::span<const BondRef>(bonds), u);
  ASSERT_EQ(states.size(), bonds.size());
  double sum = 0.0;
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    const auto end = bond_end(body, bonds[b]);
    EXPECT_NEAR(states[b].elongation, stretch(body, bonds[b].particle, end, u) * end.length, 1e-14);
    sum += 0.5 * states[b].share * states[b].stiffness * states[b].elongation * states[b].elongation;
  }
  const double expected = bond_energy(body, Eigen::MatrixXd(u))[0];
  EXPECT_NEAR(sum, expected, 1e-12 * expected);
}

TEST(BondLimits, StatesOfAllBondsGiveTheEnergy) {
  for_random_bodies<1>(10, expect_states<1>);
  for_random_bodies<2>(10, expect_states<2>);
  for_random_bodies<3>(6, expect_states<3>);
}

TEST(BondLimits, TheSameBitsForAnyNumberOfThreads) {
  const int before = threads();
  const auto body = build_body<2>(box_model({61, 47}, 1.0, 3.0));
  const Eigen::VectorXd u_0 = field(body, 6), u_1 = field(body, 7);
  std::vector<FirstBreak> found;
  for (const int count : {1, 2, 5}) {
    set_threads(count);
    found.push_back(first_break(body, {{0.3}}, u_0, u_1, 0.01));
  }
  set_threads(before);
  for (std::size_t k : {1U, 2U}) {
    EXPECT_EQ(found[k].factor, found[0].factor);
    EXPECT_EQ(found[k].worst, found[0].worst);
    EXPECT_EQ(found[k].energy, found[0].energy);
    EXPECT_EQ(found[k].bonds, found[0].bonds);
  }
}

}  // namespace
}  // namespace perimode
