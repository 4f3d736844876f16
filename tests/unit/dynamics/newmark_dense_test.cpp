// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "perimode/assembly/bond_limits.hpp"
#include "perimode/dynamics/newmark.hpp"
#include "tearing_runs.hpp"

namespace perimode {
namespace {

using test::alive_bits;
using test::moved_plate;
using test::spreading;
using test::tearing;
using test::torn_plate;
using test::watch;
using test::Watched;
using test::with_pull;

/// The scheme written out with dense matrices over all dofs, bond by bond; no walls, no damping.
template <int Dim>
class DenseMarch {
 public:
  struct Bond {
    Index i, j;
    Point<Dim> n;
    double k, limit;  // elongation at which it breaks
    bool alive = true;
    Offset slot;
  };

  DenseMarch(const Model& model, const TransientOptions& options, double rate)
      : body(build_body<Dim>(model)), o(options) {
    std::vector<char> held(static_cast<std::size_t>(body.count()), 0);
    for (const Region& region : options.no_fail)
      for (const Index i : select(region, body.particles)) held[static_cast<std::size_t>(i)] = 1;
    for (Index i = 0; i < body.count(); ++i) {
      for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
        if (end.neighbour < i) return;
        const bool kept =
            held[static_cast<std::size_t>(i)] != 0 || held[static_cast<std::size_t>(end.neighbour)] != 0;
        bonds.push_back(
            {i, end.neighbour, end.xi / end.length, bond_stiffness(body, i, end),
             kept ? std::numeric_limits<double>::infinity() : options.critical_stretch[0] * end.length, true,
             end.slot});
      });
    }
    const auto dofs = static_cast<Eigen::Index>(body.count()) * Dim;
    mass = Eigen::VectorXd(dofs);
    for (Eigen::Index d = 0; d < dofs; ++d)
      mass[d] = body.particles.volume[static_cast<std::size_t>(d / Dim)];
    u = a = Eigen::VectorXd::Zero(dofs);  // no load and no given motion at t = 0
    v = spreading(body, rate);
    for (Eigen::Index d = 0; d < dofs; ++d)
      if (!is_free(d)) v[d] = 0.0;
  }

  [[nodiscard]] bool is_free(Eigen::Index d) const {
    return body.boundary.free_number[static_cast<std::size_t>(d)] >= 0;
  }

  [[nodiscard]] Eigen::MatrixXd stiffness() const {
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(u.size(), u.size());
    for (const Bond& b : bonds) {
      if (!b.alive) continue;
      const Eigen::Matrix<double, Dim, Dim> nn = b.k * b.n * b.n.transpose();
      k.template block<Dim, Dim>(b.i * Dim, b.i * Dim) += nn;
      k.template block<Dim, Dim>(b.j * Dim, b.j * Dim) += nn;
      k.template block<Dim, Dim>(b.i * Dim, b.j * Dim) -= nn;
      k.template block<Dim, Dim>(b.j * Dim, b.i * Dim) -= nn;
    }
    return k;
  }

  [[nodiscard]] double elongation(const Bond& b, const Eigen::VectorXd& w) const {
    return b.n.dot(w.template segment<Dim>(b.j * Dim) - w.template segment<Dim>(b.i * Dim));
  }

  [[nodiscard]] Eigen::VectorXd given(double t) const {
    const BoundaryMap<Dim> map = at_time(body.boundary, t);
    return Eigen::Map<const Eigen::VectorXd>(map.given.data(), static_cast<Eigen::Index>(map.given.size()));
  }
  [[nodiscard]] Eigen::VectorXd load(double t) const {
    Eigen::VectorXd f = Eigen::VectorXd::Zero(u.size());
    for (const Load& l : o.loads) f += value_at(l.time, t) * load_vector(body.particles, {l});
    return f;
  }

  /// To the next step; returns how often it was solved.
  int advance(double dt) {
    NewmarkOptions n = o.newmark;
    if (o.method == TimeMethod::newmark) n.alpha = 0.0;
    if (n.alpha != 0.0) {
      n.beta = 0.25 * (1.0 - n.alpha) * (1.0 - n.alpha);
      n.gamma = 0.5 - n.alpha;
    }
    const double t = static_cast<double>(step + 1) * dt;
    const Eigen::VectorXd end_given = given(t);
    const Eigen::VectorXd f = (1.0 + n.alpha) * load(t) - n.alpha * load(t - dt);
    const std::vector<Bond> bonds_before = bonds;
    Eigen::VectorXd next, next_a;
    int solutions = 0;
    for (bool broke = true; broke;) {
      ++solutions;
      const Eigen::MatrixXd k = stiffness();
      // Unknown: accelerations of the free dofs, with the displacements of the others in place.
      next = u + dt * v + dt * dt * (0.5 - n.beta) * a;
      Eigen::MatrixXd system = Eigen::MatrixXd(mass.asDiagonal()) + (1.0 + n.alpha) * n.beta * dt * dt * k;
      for (Eigen::Index d = 0; d < u.size(); ++d)
        if (!is_free(d)) next[d] = end_given[d];
      Eigen::VectorXd rhs = f - k * ((1.0 + n.alpha) * next - n.alpha * u);
      for (Eigen::Index d = 0; d < u.size(); ++d) {
        if (is_free(d)) continue;
        system.row(d).setZero();
        system.col(d).setZero();
        system(d, d) = 1.0;
        rhs[d] = 0.0;
      }
      next_a = system.partialPivLu().solve(rhs);
      next += n.beta * dt * dt * next_a;
      broke = false;
      for (Bond& b : bonds) {
        if (!b.alive || elongation(b, next) <= b.limit) continue;
        b.alive = false;
        break_bond(body.bonds, b.i, b.slot);
        broke = true;
      }
    }
    for (std::size_t b = 0; b < bonds.size(); ++b) {
      if (bonds_before[b].alive && !bonds[b].alive)
        broken_energy += 0.5 * bonds[b].k * elongation(bonds[b], u) * elongation(bonds[b], next);
    }
    Eigen::VectorXd next_v = v + dt * ((1.0 - n.gamma) * a + n.gamma * next_a);
    for (Eigen::Index d = 0; d < u.size(); ++d)
      if (!is_free(d)) next_v[d] = 0.0;
    u = next;
    v = next_v;
    a = next_a;
    ++step;
    return solutions;
  }

  Body<Dim> body;
  TransientOptions o;
  std::vector<Bond> bonds;
  Eigen::VectorXd mass, u, v, a;
  double broken_energy = 0.0;
  int step = 0;
};

void expect_brute_force(const Model& model, const TransientOptions& options) {
  const double rate = 0.05;
  const Watched<2> run = watch<2>(model, options, rate);
  DenseMarch<2> dense(model, options, rate);
  Offset repeats = 0, most = 0;
  ASSERT_EQ(run.alive.front(), alive_bits(dense.body));
  for (std::size_t n = 1; n < run.rows.size(); ++n) {
    const Offset again = dense.advance(run.result.plan.dt) - 1;
    repeats += again;
    most = std::max(most, again);
    ASSERT_EQ(run.alive[n], alive_bits(dense.body)) << "step " << n;
    const double scale = std::max(dense.u.cwiseAbs().maxCoeff(), 1e-6);
    ASSERT_LT((run.displacement[n] - dense.u).cwiseAbs().maxCoeff(), 1e-10 * scale) << "step " << n;
    if (options.method == TimeMethod::newmark) {
      ASSERT_NEAR(run.rows[n].energies.broken, dense.broken_energy, 1e-11 * dense.broken_energy);
    }
  }
  EXPECT_GT(run.result.broken_bonds, 100);
  EXPECT_EQ(run.result.repeats.all, repeats);
  EXPECT_EQ(run.result.repeats.most, most);
  EXPECT_GT(most, 1);
}

TEST(NewmarkBreaking, ALoadedPlateTearsAsWithDenseMatrices) {
  expect_brute_force(torn_plate(), with_pull(tearing(TimeMethod::newmark, 6.0, 0.1)));
  expect_brute_force(torn_plate(), with_pull(tearing(TimeMethod::hht, 6.0, 0.1)));
}

TEST(NewmarkBreaking, AMovedPlateTearsAsWithDenseMatrices) {
  expect_brute_force(moved_plate(), tearing(TimeMethod::newmark, 4.0, 0.1));
  expect_brute_force(moved_plate(), tearing(TimeMethod::hht, 4.0, 0.05));
}

/// At the end of a step no alive bond is beyond its critical stretch.
TEST(NewmarkBreaking, NoBondIsOverStretchedAtTheEndOfAStep) {
  const Watched<2> run = watch<2>(moved_plate(), tearing(TimeMethod::newmark, 4.0, 0.2), 0.05);
  ASSERT_GT(run.result.broken_bonds, 100);
  Body<2> body = build_body<2>(moved_plate());
  for (std::size_t n = 0; n < run.rows.size(); ++n) {
    std::visit([&](auto& bonds) { bonds.alive = run.alive[n]; }, body.bonds);
    EXPECT_LE(overstretched(body, {{0.01}}, run.displacement[n], 0, 0.0).worst, 1.0 + 1e-12);
  }
}

}  // namespace
}  // namespace perimode
