// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "perimode/assembly/assemble.hpp"
#include "perimode/assembly/bond_forces.hpp"
#include "perimode/assembly/fields.hpp"
#include "perimode/assembly/operators.hpp"
#include "unit/assembly/operator_checks.hpp"

namespace perimode::test {

inline constexpr Kinematics both[] = {Kinematics::linear, Kinematics::large_rotation};

template <int Dim>
Eigen::VectorXd force(const BondForces<Dim>& forces, const Eigen::VectorXd& q) {
  Eigen::VectorXd y = Eigen::VectorXd::Constant(q.size(), std::nan(""));
  forces.product().apply(q.data(), [&](const RowPiece& piece) {
    for (Index r = 0; r < piece.count; ++r) {
      EXPECT_TRUE(std::isnan(y[piece.first + r])) << "row " << piece.first + r << " twice";
      y[piece.first + r] = piece.y[r];
    }
  });
  return y;
}

/// Strain energy of the bonds that an evaluation at q leaves alive.
template <int Dim>
double energy_at(BondForces<Dim>& forces, const Eigen::VectorXd& q) {
  forces.follow_energy(true);
  (void)force(forces, q);
  return forces.last_strain_energy();
}

/// Force, stretch and energy of one bond by the formulas of the books.
template <int Dim>
struct Plain {
  Point<Dim> force;
  double stretch, energy;
  Plain(const Body<Dim>& body, const std::vector<double>& u, Index i, const BondEnd<Dim>& end,
        Kinematics kinematics) {
    Point<Dim> own;
    for (int a = 0; a < Dim; ++a) own[a] = u[static_cast<std::size_t>(i) * Dim + a];
    const Point<Dim> y =
        end.xi + (partner_displacement(body.boundary, u.data(), end.neighbour, body.count()) - own);
    const double k = bond_stiffness(body, i, end);
    if (kinematics == Kinematics::linear) {
      const Point<Dim> n = end.xi / end.length;
      stretch = n.dot(y - end.xi) / end.length;
      force = k * stretch * end.length * n;
    } else {
      stretch = (y.norm() - end.length) / end.length;
      force = k * stretch * end.length * y / y.norm();
    }
    energy = 0.5 * k * stretch * stretch * end.length * end.length;
  }
};

/// One evaluation bond by bond, breaking included: internal forces on the free dofs, and the sizes of what
/// they sum.
template <int Dim>
struct Reference {
  Eigen::VectorXd force, size;
  Offset broken = 0;
  double energy = 0.0;

  Reference(Body<Dim>& body, const Eigen::VectorXd& q, Kinematics kinematics,
            const std::vector<double>& critical, const std::vector<Index>& no_fail = {}, double t = 0.0) {
    const BoundaryMap<Dim> map = at_time(body.boundary, t);
    const std::vector<double> u = map.expand(q.data());
    Body<Dim> now = body;
    now.boundary = map;
    std::vector<char> holds(static_cast<std::size_t>(body.count()), 0);
    for (Index i : no_fail) holds[i] = 1;
    const auto& block = body.particles.block;
    for (Index i = 0; i < body.count(); ++i) {
      for_each_bond(now.bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
        const Index j = owner(body.bonds, end.neighbour, body.count());
        const Plain<Dim> bond(now, u, i, end, kinematics);
        const double limit = critical.empty() ? std::numeric_limits<double>::infinity()
                                              : std::min(critical[block[i]], critical[block[j]]);
        if (!(bond.stretch > limit) || holds[i] != 0 || holds[j] != 0) return;
        if (!std::visit([&](const auto& b) { return is_alive(b, i, end.slot); }, body.bonds)) return;
        bool still = end.neighbour >= body.count();
        for (int a = 0; a < Dim && still; ++a)
          still = map.coefficient[static_cast<std::size_t>(end.neighbour - body.count()) * Dim + a] == 0.0;
        energy += bond.energy * (end.neighbour < body.count() || still ? 1.0 : 0.5);
        ++broken;
        break_bond(body.bonds, i, end.slot);
      });
    }
    force = size = Eigen::VectorXd::Zero(map.free);
    for (Index i = 0; i < body.count(); ++i) {
      for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
        const Plain<Dim> bond(now, u, i, end, kinematics);
        for (int a = 0; a < Dim; ++a) {
          const Index row = map.free_number[static_cast<std::size_t>(i) * Dim + a];
          if (row < 0) continue;
          force[row] -= bond.force[a];
          size[row] += bond_stiffness(body, i, end) * end.length;  // y - xi rounds at the size of xi
        }
      });
    }
  }
};

template <int Dim>
std::vector<std::uint64_t> alive_bits(const Body<Dim>& body) {
  return std::visit([](const auto& bonds) { return bonds.alive; }, body.bonds);
}

/// Random displacements of a tenth of the shortest bond.
template <int Dim>
Eigen::VectorXd shaken(const Body<Dim>& body, unsigned seed) {
  return 0.05 * typical_spacing(body.particles, body.section) * random_vector(body.boundary.free, seed);
}

/// Forces, what breaks and the energies of two evaluations against the plain ones.
template <int Dim>
void expect_plain(const Body<Dim>& original, const std::vector<double>& critical,
                  const std::vector<Index>& no_fail = {}, double t = 0.0) {
  for (const Kinematics kinematics : both) {
    Body<Dim> body = original;
    Body<Dim> reference_body = original;
    BondForces<Dim> forces(body, kinematics, critical, no_fail);
    forces.set_time(t);
    Offset broken = 0;
    double energy = 0.0;
    for (unsigned seed : {1U, 2U}) {
      const Eigen::VectorXd q = shaken(body, seed);
      const Reference<Dim> expected(reference_body, q, kinematics, critical, no_fail, t);
      const Eigen::VectorXd y = force(forces, q);
      ASSERT_LE(((y - expected.force).array().abs() / expected.size.array().max(1e-300)).maxCoeff(), 1e-14);
      broken += expected.broken;
      energy += expected.energy;
      EXPECT_EQ(forces.broken(), broken);
      EXPECT_NEAR(forces.broken_energy(), energy, 1e-12 * energy);
      EXPECT_EQ(alive_bits(body), alive_bits(reference_body));
      EXPECT_EQ(damage(body), damage(reference_body));
    }
    EXPECT_EQ(broken > 0, !critical.empty());
  }
}

template <int Dim>
void expect_plain(const Model& model) {
  const auto body = build_body<Dim>(model);
  const std::vector<double> none, some(body.density.size(), 0.03);
  expect_plain(body, none);
  expect_plain(body, some);
}

}  // namespace perimode::test
