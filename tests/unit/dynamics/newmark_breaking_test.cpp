// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "perimode/assembly/assemble.hpp"
#include "perimode/core/error.hpp"
#include "perimode/dynamics/step_breaking.hpp"
#include "perimode/linalg/threads.hpp"
#include "transient_runs.hpp"

namespace perimode {
namespace {

using test::box_model;
using test::face;
using test::record;
using test::Recorded;
using test::until;

/// A plate with an edge crack, held at x- and pulled at x+ and y+, E = rho = 1.
Model torn_plate() {
  Model m = box_model({12, 10}, 0.1, 2.01);
  test::fix_face(m, 0, false, 2, {0, 1});
  test::add_crack(m, {{0.6, -0.01}, {0.6, 0.31}});
  return m;
}

/// The same pulled by given motion of x+, which shears it too.
Model moved_plate() {
  Model m = torn_plate();
  m.boundary.push_back(
      {Prescribe{{{0, 0.08}, {1, 0.02}}, face(0, true, 2), {TimeFunction::Kind::ramp, 3.0, 0.0, {}, {}, {}}},
       {}});
  return m;
}

TransientOptions tearing(TimeMethod method, double end, double dt) {
  TransientOptions options = test::with_method(until(end), method);
  options.dt = dt;
  options.critical_stretch = {0.01};
  return options;
}

TransientOptions with_pull(TransientOptions options) {
  options.loads = {
      {Traction{{0.03, 0.01}}, face(0, true, 1), {TimeFunction::Kind::ramp, 2.0, 0.0, {}, {}, {}}, {}}};
  options.no_fail = {face(0, true, 2)};
  return options;
}

template <int Dim>
std::vector<std::uint64_t> alive_bits(const Body<Dim>& body) {
  return std::visit([](const auto& bonds) { return bonds.alive; }, body.bonds);
}

/// A run that also keeps the bonds as they are at every row.
template <int Dim>
struct Watched {
  std::vector<HistoryRow> rows;
  std::vector<Eigen::VectorXd> displacement;
  std::vector<std::vector<std::uint64_t>> alive;
  TransientResult result;
};

/// v = rate (x - centre): what shatters a body.
template <int Dim>
Eigen::VectorXd spreading(const Body<Dim>& body, double rate) {
  Point<Dim> centre = Point<Dim>::Zero();
  for (const Point<Dim>& x : body.particles.position) centre += x / static_cast<double>(body.count());
  Eigen::VectorXd v(static_cast<Eigen::Index>(body.count()) * Dim);
  for (Index i = 0; i < body.count(); ++i)
    v.template segment<Dim>(static_cast<Eigen::Index>(i) * Dim) =
        rate * (body.particles.position[static_cast<std::size_t>(i)] - centre);
  return v;
}

template <int Dim>
Watched<Dim> watch(const Model& model, TransientOptions options, double rate = 0.0) {
  Body<Dim> body = build_body<Dim>(model);
  const InitialState initial{{}, spreading(body, rate)};
  options.fields_every = 1;
  Watched<Dim> watched;
  TransientObserver<Dim> observer;
  observer.history = [&](const HistoryRow& row) { watched.rows.push_back(row); };
  observer.fields = [&](const TransientFrame<Dim>& frame) {
    watched.displacement.push_back(frame.displacement);
    watched.alive.push_back(alive_bits(*frame.body));
  };
  watched.result = run_transient(body, options, initial, observer);
  return watched;
}

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

struct Scheme {
  TimeMethod method;
  NewmarkOptions options;
};

Scheme newmark_with(double beta, double gamma) {
  Scheme s{TimeMethod::newmark, {}};
  s.options.beta = beta;
  s.options.gamma = gamma;
  return s;
}
Scheme hht_with(double alpha) {
  Scheme s{TimeMethod::hht, {}};
  s.options.alpha = alpha;
  return s;
}

double worst_balance(const std::vector<HistoryRow>& rows) {
  double worst = 0.0, scale = 0.0;
  for (const HistoryRow& row : rows) {
    worst = std::max(worst, std::abs(row.energies.balance()));
    scale = std::max(scale, std::abs(row.energies.external_work) + row.energies.initial);
  }
  return worst / scale;
}

class BreakingBalance : public testing::TestWithParam<Scheme> {};

TEST_P(BreakingBalance, ClosesToRoundOffWhileHundredsOfBondsBreak) {
  for (const bool moved : {false, true}) {
    for (const bool damped : {false, true}) {
      TransientOptions options = tearing(GetParam().method, 6.0, 0.05);
      if (!moved) options = with_pull(options);
      options.newmark = GetParam().options;
      if (damped) {
        options.rayleigh_mass = 0.05;
        options.rayleigh_stiffness = 0.02;
        options.damping = {{0.3, face(1, true, 3), {}}};
      }
      const Watched<2> run = watch<2>(moved ? moved_plate() : torn_plate(), options, 0.1);
      EXPECT_EQ(run.result.status, TransientStatus::done);
      EXPECT_GT(run.result.broken_bonds, 200) << moved << damped;
      EXPECT_GT(run.result.energies.broken, 0.0);
      EXPECT_TRUE(run.result.plan.conserves);
      EXPECT_LT(worst_balance(run.rows), 1e-12) << moved << damped;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Newmark, BreakingBalance,
                         testing::Values(newmark_with(0.25, 0.5), newmark_with(0.3, 0.5),
                                         newmark_with(0.3025, 0.6), newmark_with(0.5, 0.8), hht_with(-0.05),
                                         hht_with(-1.0 / 3.0)));

/// Walls share bonds with their images; a blow that runs through the body tears it.
TEST(NewmarkBreaking, TheBalanceClosesBetweenWalls) {
  for (const WallType wall : {WallType::mirror, WallType::antimirror, WallType::zero_layer}) {
    Model m = box_model({14, 8}, 0.1, 2.01);
    test::add_wall(m, 0, false, wall);
    test::add_wall(m, 1, false, WallType::mirror);
    for (const TimeMethod method : {TimeMethod::newmark, TimeMethod::hht}) {
      TransientOptions options = tearing(method, 5.0, 0.05);
      options.loads = {{Traction{{0.05, 0.0}}, face(0, true, 1), test::half_sine(1.5), {}}};
      const Watched<2> run = watch<2>(m, options, 0.1);
      EXPECT_GT(run.result.broken_bonds, 100);
      EXPECT_LT(worst_balance(run.rows), 1e-12);
    }
  }
}

TEST(NewmarkBreaking, CloudsAndSolidsBalance) {
  Model solid = box_model({6, 4, 4}, 0.1, 1.75);
  test::fix_face(solid, 0, false, 1, {0, 1, 2});
  TransientOptions options = tearing(TimeMethod::newmark, 3.0, 0.05);
  options.loads = {
      {Traction{{0.05, 0.0, 0.01}}, face(0, true, 1), {TimeFunction::Kind::ramp, 1.0, 0.0, {}, {}, {}}, {}}};
  options.no_fail = {face(0, true, 1)};
  const Watched<3> run = watch<3>(solid, options);
  EXPECT_GT(run.result.broken_bonds, 50);
  EXPECT_LT(worst_balance(run.rows), 1e-12);
}

TEST(NewmarkBreaking, ABodyThatHoldsMovesAsAnUnbreakableOne) {
  for (const TimeMethod method : {TimeMethod::newmark, TimeMethod::hht}) {
    TransientOptions options = with_pull(tearing(method, 3.0, 0.1));
    options.critical_stretch = {1e3};
    const Watched<2> held = watch<2>(torn_plate(), options);
    options.critical_stretch = {};
    const Watched<2> plain = watch<2>(torn_plate(), options);
    EXPECT_EQ(held.result.broken_bonds, 0);
    for (std::size_t n = 1; n < plain.rows.size(); ++n) {
      ASSERT_LT((held.displacement[n] - plain.displacement[n]).norm(), 1e-12 * plain.displacement[n].norm());
    }
  }
}

/// As the step shrinks, implicit and explicit steps tear a plate along the same bonds.
TEST(NewmarkBreaking, SmallStepsBreakTheBondsThatExplicitStepsBreak) {
  Model m = box_model({12, 4}, 0.1, 2.01);
  test::fix_face(m, 0, false, 2, {0, 1});
  m.boundary.push_back(
      {Prescribe{{{0, 0.08}, {1, 0.0}}, face(0, true, 2), {TimeFunction::Kind::ramp, 20.0, 0.0, {}, {}, {}}},
       {}});
  test::add_crack(m, {{0.6, -0.01}, {0.6, 0.11}});
  const double end = 7.0;
  const Watched<2> implicit = watch<2>(m, tearing(TimeMethod::newmark, end, 1e-3));
  const Watched<2> exact = watch<2>(m, tearing(TimeMethod::central_difference, end, 1e-3));
  ASSERT_GT(exact.result.broken_bonds, 5);
  EXPECT_EQ(implicit.alive.back(), exact.alive.back());
}

/// A bar pulled apart flies off in two pieces that no support holds.
TEST(NewmarkBreaking, FragmentsFlyFreely) {
  Model m = test::bar(40);
  TransientOptions options = tearing(TimeMethod::newmark, 3.0, 0.02);
  options.critical_stretch = {0.01};
  const Watched<1> run = watch<1>(m, options, 0.05);
  EXPECT_EQ(run.result.status, TransientStatus::done);
  EXPECT_GT(run.result.broken_bonds, 3);
  EXPECT_LT(worst_balance(run.rows), 1e-12);
  const Eigen::VectorXd& v = run.result.velocity;
  EXPECT_NEAR(v.sum(), 0.0, 1e-13);
  EXPECT_LT(v.head(20).mean(), -0.005);
  EXPECT_GT(v.tail(20).mean(), 0.005);
}

TEST(NewmarkBreaking, FactorAndConjugateGradientsBreakTheSameBonds) {
  TransientOptions options = with_pull(tearing(TimeMethod::newmark, 4.0, 0.1));
  options.solver = ImplicitSolver::factor;
  const Watched<2> factor = watch<2>(torn_plate(), options);
  options.solver = ImplicitSolver::cg;
  const Watched<2> cg = watch<2>(torn_plate(), options);
  EXPECT_GT(factor.result.broken_bonds, 100);
  EXPECT_GT(cg.result.iterations, 0);
  EXPECT_EQ(factor.alive, cg.alive);
}

TEST(NewmarkBreaking, SameBitsForAnyNumberOfThreads) {
  for (const ImplicitSolver solver : {ImplicitSolver::factor, ImplicitSolver::cg}) {
    for (const bool breaks : {false, true}) {
      std::vector<Watched<2>> runs;
      for (const int threads : {1, 2}) {
        set_threads(threads);
        TransientOptions options = tearing(TimeMethod::hht, 4.0, 0.1);
        if (!breaks)
          options.critical_stretch = {};
        else
          options.critical_stretch = {0.02};
        options.solver = solver;
        runs.push_back(watch<2>(moved_plate(), options, 0.05));
      }
      set_threads(1);
      for (std::size_t n = 0; n < runs[0].rows.size(); ++n)
        if (runs[0].displacement[n] != runs[1].displacement[n]) {
          printf("differ at %zu solver %d breaks %d %g\n", n, int(solver), breaks,
                 (runs[0].displacement[n] - runs[1].displacement[n]).norm());
          break;
        }
      EXPECT_EQ(runs[0].result.energies.broken, runs[1].result.energies.broken);
    }
  }
}

TEST(NewmarkBreaking, ResumesBitForBitFromItsCheckpoints) {
  for (const StiffnessForm form : {StiffnessForm::automatic, StiffnessForm::bonds, StiffnessForm::blocks}) {
    for (const ImplicitSolver solver : {ImplicitSolver::factor, ImplicitSolver::cg}) {
      TransientOptions options = tearing(TimeMethod::hht, 4.0, 0.1);
      options.form = form;
      options.solver = solver;
      options.checkpoint_every = 16;
      const Recorded whole = record<2>(moved_plate(), options);
      ASSERT_EQ(whole.checkpoints.size(), 2U);
      for (const IntegratorState& state : whole.checkpoints) {
        const Recorded rest = record<2>(moved_plate(), options, false, &state);
        EXPECT_EQ(rest.result.displacement, whole.result.displacement);
        EXPECT_EQ(rest.result.velocity, whole.result.velocity);
        EXPECT_EQ(rest.result.broken_bonds, whole.result.broken_bonds);
        EXPECT_EQ(rest.result.repeats.all, whole.result.repeats.all);
        EXPECT_EQ(rest.rows.back().energies.balance(), whole.rows.back().energies.balance());
      }
      EXPECT_GT(whole.result.broken_bonds, 40);
    }
  }
}

TEST(NewmarkBreaking, ProtectedParticlesKeepTheirBonds) {
  for (const TimeMethod method : {TimeMethod::central_difference, TimeMethod::newmark}) {
    TransientOptions options = tearing(method, 4.0, 0.02);
    options.no_fail = {Region{BoxRegion{{0.3, 0.0}, {0.9, 1.0}}, {}}};
    const Watched<2> run = watch<2>(moved_plate(), options);
    EXPECT_GT(run.result.broken_bonds, 0);
    Body<2> body = build_body<2>(moved_plate());
    const std::vector<Index> held = select(options.no_fail[0], body.particles);
    std::vector<Offset> before;
    const auto alive_of = [&](Index i) {
      Offset count = 0;
      for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<2>&) { ++count; });
      return count;
    };
    for (const Index i : held) before.push_back(alive_of(i));
    std::visit([&](auto& bonds) { bonds.alive = run.alive.back(); }, body.bonds);
    for (std::size_t k = 0; k < held.size(); ++k) EXPECT_EQ(alive_of(held[k]), before[k]);
  }
}

TEST(NewmarkBreaking, WhatDoesNotFitIsRefused) {
  const auto message = [](const TransientOptions& options, const Model& model) -> std::string {
    try {
      (void)record<2>(model, options);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
      return error.what();
    }
    return "nothing was refused";
  };
  using testing::HasSubstr;
  EXPECT_THAT(message(tearing(TimeMethod::modal, 1.0, 0.1), torn_plate()),
              HasSubstr("central_difference, newmark or hht"));
  Model odd = torn_plate();
  test::add_wall(odd, 1, true, WallType::odd);
  EXPECT_THAT(message(tearing(TimeMethod::newmark, 1.0, 0.1), odd), HasSubstr("a symmetric boundary"));
  TransientOptions options = tearing(TimeMethod::newmark, 1.0, 0.1);
  options.no_fail = {Region{BoxRegion{{5.0, 0.0}, {6.0, 1.0}}, {}}};
  EXPECT_THAT(message(options, torn_plate()), HasSubstr("no_fail regions that hold at least one particle"));
  options = tearing(TimeMethod::newmark, 1.0, 0.1);
  const Recorded other = record<2>(torn_plate(), test::with_method(until(1.0), TimeMethod::newmark));
  Body<2> body = build_body<2>(torn_plate());
  options.checkpoint_every = 5;
  options.critical_stretch = {};
  const Recorded plain = record<2>(torn_plate(), options);
  options.critical_stretch = {0.01};
  EXPECT_THROW((void)record<2>(torn_plate(), options, false, plain.checkpoints.data()), Error);
}

}  // namespace
}  // namespace perimode
