// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/assembly/multigrid.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <random>
#include <string>

#include "assembly/transfer.hpp"
#include "perimode/assembly/assemble.hpp"
#include "perimode/assembly/operators.hpp"
#include "perimode/bonds/connectivity.hpp"
#include "perimode/core/error.hpp"
#include "perimode/linalg/conjugate_gradients.hpp"
#include "perimode/linalg/factor.hpp"
#include "perimode/linalg/threads.hpp"
#include "support/models.hpp"

namespace perimode {
namespace {

Eigen::VectorXd random_vector(Eigen::Index n, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  return Eigen::VectorXd::NullaryExpr(n, [&] { return normal(random); });
}

Model box(const std::vector<int>& cells, double ratio = 3.0) {
  return test::box_model(cells, 1.0 / cells[0], ratio);
}

/// Three layers on the left held, as wide as the horizon.
Model clamped(const std::vector<int>& cells, double ratio = 3.0) {
  Model m = box(cells, ratio);
  std::vector<int> all;
  for (int a = 0; a < m.dimension; ++a) all.push_back(a);
  test::fix_face(m, 0, false, 3, all);
  return m;
}

/// A shear and a pull on the last layer of the right face.
template <int Dim>
Eigen::VectorXd load_on_the_right(const Body<Dim>& body) {
  Eigen::VectorXd b = Eigen::VectorXd::Zero(body.boundary.free);
  const Grid<Dim>& grid = *body.particles.grid;
  for (Index i = 0; i < body.count(); ++i) {
    if (body.particles.position[i][0] < grid.upper()[0] - grid.spacing) continue;
    for (int a = 0; a < Dim; ++a) {
      const Index free = body.boundary.free_number[static_cast<std::size_t>(i) * Dim + a];
      if (free >= 0) b[free] = a == Dim - 1 ? 1.0 : 0.3;
    }
  }
  return b;
}

template <int Dim>
CgResult solve(const Body<Dim>& body, const Eigen::VectorXd& b, const MultigridOptions& options) {
  const LinearOperator k = stiffness_operator(body);
  return conjugate_gradients(k, b, multigrid(body, k, options).preconditioner,
                             {.tolerance = 1e-8, .most_iterations = 200});
}

/// Models of every kind the hierarchy treats in its own way, odd and even.
std::vector<std::pair<std::string, Model>> plane_models(int nx, int ny) {
  std::vector<std::pair<std::string, Model>> out;
  const auto add = [&](const std::string& name, const Model& m) { out.emplace_back(name, m); };
  add("clamped", clamped({nx, ny}));
  add("free", box({nx, ny}));
  const std::pair<std::string, WallType> walls[] = {{"mirror", WallType::mirror},
                                                    {"antimirror", WallType::antimirror},
                                                    {"zero layer", WallType::zero_layer}};
  for (const auto& [name, type] : walls) {
    Model m = box({nx, ny});
    test::add_walls(m, 0, type);
    test::add_walls(m, 1, type);
    add(name, m);
  }
  Model m = box({nx, ny});
  m.periodic = {true, true, false};
  add("periodic", m);
  m = clamped({nx, ny});
  test::add_wall(m, 1, true, WallType::mirror);
  test::add_crack(m, {{0.45, 0.3}, {0.45, 1.5}});  // into the wall and its image
  add("crack into a wall", m);
  m = clamped({nx, ny});
  m.periodic = {false, true, false};
  test::add_crack(m, {{0.45, 0.3}, {0.7, 1.2}});
  add("crack in a periodic strip", m);
  m = clamped({nx, ny});
  std::get<GridSpec>(m.particles).remove.push_back(Region{BallRegion{{0.5, 0.4}, 0.15}, {}});
  add("hole", m);
  m = clamped({nx, ny});
  m.blocks.push_back({"stiff", Region{BallRegion{{0.6, 0.4}, 0.25}, {}}});
  m.block_materials["stiff"] = m.material;
  m.block_materials["stiff"].youngs_modulus = 100.0;
  add("two materials", m);
  m = clamped({nx, ny});
  m.calibration = Calibration::discrete;
  add("calibrated", m);
  m = box({nx, ny});
  test::fix_face(m, 0, false, 3, {0});  // rollers: nodes with one free dof
  test::fix_face(m, 1, false, 2, {1});
  add("rollers", m);
  return out;
}

TEST(Coarsen, KeepsVolumeAndStiffnessAndDoublesLengths) {
  const auto check = []<int Dim>(const Body<Dim>& fine) {
    const Body<Dim> coarse = coarsen(fine);
    ASSERT_EQ(coarse.count() << Dim, fine.count());
    const auto& f = std::get<GridBonds<Dim>>(fine.bonds).family;
    const auto& c = std::get<GridBonds<Dim>>(coarse.bonds).family;
    EXPECT_EQ(c.offset, f.offset);
    EXPECT_DOUBLE_EQ(c.horizon, 2.0 * f.horizon);
    EXPECT_DOUBLE_EQ(coarse.particles.volume[0] * coarse.count(), fine.particles.volume[0] * fine.count());
    // Behind mirrors all families are whole, so nothing is left to calibrate, and the energy density of a
    // uniform dilation, k_b |xi|^2 / V, is that of the fine body.
    for (const double factor : coarse.constants.factor) EXPECT_NEAR(factor, 1.0, 1e-12);
    const auto energy = [](const Body<Dim>& body) {
      double sum = 0.0;
      for_each_bond(body.bonds, 0, Which::alive, [&](const BondEnd<Dim>& end) {
        sum += bond_stiffness(body, 0, end) * end.length * end.length;
      });
      return sum / body.particles.volume[0];
    };
    EXPECT_NEAR(energy(coarse), energy(fine), 1e-12 * energy(fine));
  };
  const auto behind_mirrors = [](const std::vector<int>& cells) {
    Model m = box(cells);
    for (int a = 0; a < m.dimension; ++a) test::add_walls(m, a, WallType::mirror);
    return m;
  };
  check(build_body<1>(behind_mirrors({16})));
  check(build_body<2>(behind_mirrors({12, 8})));
  check(build_body<3>(behind_mirrors({8, 8, 8})));
}

TEST(Coarsen, FixesADofWhereAChildIsFixed) {
  const auto coarse =
      coarsen(build_body<2>(clamped({16, 16})));  // three layers: a coarse one and half of the next
  for (Index i = 0; i < coarse.count(); ++i)
    EXPECT_EQ(coarse.boundary.free_number[2 * i] < 0, coarse.particles.cell[i] % 8 < 2);
}

TEST(Coarsen, CarriesACutDown) {
  Model m = clamped({32, 32});
  test::add_crack(m, {{0.5, -0.1}, {0.5, 1.1}});
  Body<2> body = build_body<2>(m);
  for (int level = 0; level < 2; ++level) {
    EXPECT_EQ(find_pieces(body.bonds, body.count()).count, 2) << "level " << level;
    body = coarsen(body);
  }
}

TEST(Coarsen, LeavesIntactBondsWhole) {
  const auto coarse = coarsen(build_body<2>(box({20, 14})));
  const auto made = build_body<2>(test::box_model({10, 7}, 0.1, 3.0));
  EXPECT_EQ(std::get<GridBonds<2>>(coarse.bonds).alive, std::get<GridBonds<2>>(made.bonds).alive);
}

/// The coarse body of each kind has a symmetric positive semi-definite K: the V-cycle stands on that.
TEST(Coarsen, GivesSymmetricMatrices) {
  for (const auto& cells : {std::pair{16, 16}, {15, 17}}) {
    for (const auto& [name, m] : plane_models(cells.first, cells.second)) {
      const auto coarse = coarsen(build_body<2>(m));
      const Csr k = scalar_csr(assemble_stiffness(coarse), coarse.boundary.free_number);
      EXPECT_LT(asymmetry(k), 1e-14) << name << " " << cells.first;
    }
  }
}

TEST(Coarsen, RefusesClouds) {
  Body<2> cloud;
  cloud.bonds = CloudBonds<2>{};
  EXPECT_THROW((void)coarsen(cloud), Error);
  EXPECT_THROW((void)multigrid(cloud, LinearOperator{}), Error);
}

/// (P c) . r = c . (P^T r), in every kind of body.
TEST(Transfer, RestrictionIsTheTransposeOfInterpolation) {
  for (const auto& cells : {std::pair{16, 16}, {15, 17}}) {
    for (const auto& [name, m] : plane_models(cells.first, cells.second)) {
      const auto fine = build_body<2>(m);
      const auto coarse = coarsen(fine);
      Transfer<2> transfer(fine, coarse);
      const Eigen::VectorXd c = random_vector(coarse.boundary.free, 1),
                            b = random_vector(fine.boundary.free, 2),
                            q = random_vector(fine.boundary.free, 3);
      Eigen::VectorXd up = Eigen::VectorXd::Zero(b.size()), down(c.size());
      transfer.add_prolonged(c.data(), up.data());
      transfer.restrict_difference(b.data(), q.data(), down.data());
      EXPECT_NEAR(up.dot(b - q), c.dot(down), 1e-13 * up.norm() * (b - q).norm()) << name;
    }
  }
}

/// On a free body translations are met everywhere and linear fields away from the surface.
TEST(Transfer, InterpolatesLinearFields) {
  const auto fine = build_body<3>(box({8, 10, 12}));
  const auto coarse = coarsen(fine);
  Transfer<3> transfer(fine, coarse);
  const auto field = [](const Point<3>& x) { return 1.0 + 2.0 * x[0] - 3.0 * x[1] + 0.5 * x[2]; };
  Eigen::VectorXd c(coarse.boundary.free), x = Eigen::VectorXd::Zero(fine.boundary.free);
  for (Index i = 0; i < coarse.count(); ++i) {
    c.segment<3>(3 * i) << 1.0, -2.0, field(coarse.particles.position[i]);
  }
  transfer.add_prolonged(c.data(), x.data());
  const Grid<3>& grid = *fine.particles.grid;
  for (Index i = 0; i < fine.count(); ++i) {
    EXPECT_NEAR(x[3 * i], 1.0, 1e-15);
    EXPECT_NEAR(x[3 * i + 1], -2.0, 1e-15);
    const Point<3> p = fine.particles.position[i];
    if ((p - grid.lower).minCoeff() < grid.spacing || (grid.upper() - p).minCoeff() < grid.spacing) continue;
    EXPECT_NEAR(x[3 * i + 2], field(p), 1e-14);
  }
}

/// The whole spectrum of the V-cycle: symmetric to round-off and positive.
TEST(Multigrid, IsSymmetricPositiveDefinite) {
  for (const auto& cells : {std::pair{16, 16}, {15, 17}}) {
    for (const auto& [name, m] : plane_models(cells.first, cells.second)) {
      const auto body = build_body<2>(m);
      const LinearOperator k = stiffness_operator(body);
      const Multigrid mg = multigrid(body, k, {.coarsest_dofs = 40});
      EXPECT_EQ(mg.dofs.size(), 3U) << name;
      const Index n = k.size;
      const Eigen::MatrixXd dense =
          multiply(mg.preconditioner, Eigen::MatrixXd(Eigen::MatrixXd::Identity(n, n)));
      // A shifted coarsest level (free, periodic) answers 1e8 times louder than the rest.
      EXPECT_LT((dense - dense.transpose()).cwiseAbs().maxCoeff(), 1e-13 * dense.cwiseAbs().maxCoeff())
          << name;
      const Eigen::VectorXd values =
          Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense, Eigen::EigenvaluesOnly).eigenvalues();
      const double round_off = name == "free" || name == "periodic" ? 1e-14 * values.maxCoeff() : 0.0;
      EXPECT_GT(values.minCoeff(), -round_off) << name;
    }
  }
}

/// No eigenvalue of D^-1 K lies above 2, also where bonds are broken down to pairs and single particles: the
/// bound that the smoother rests on. K and its coarse ones are singular then.
TEST(Multigrid, StaysPositiveWhereNearlyAllBondsAreBroken) {
  for (const double share : {0.3, 0.6, 0.8}) {
    auto body = build_body<2>(clamped({16, 16}));
    std::mt19937 random(11);
    std::bernoulli_distribution broken(share);
    for (Index i = 0; i < body.count(); ++i) {
      for (int k = 0; k < std::get<GridBonds<2>>(body.bonds).family.size(); ++k)
        if (broken(random)) break_bond(body.bonds, i, k);
    }
    const LinearOperator k = stiffness_operator(body);
    const Index n = k.size;
    const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(n, n);
    const LinearOperator jacobi = block_jacobi(diagonal_blocks(body), 2, body.boundary.free_number);
    const Eigen::MatrixXd stiffness = multiply(k, identity), inverse = multiply(jacobi, identity);
    const Eigen::VectorXd scaled = Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(
                                       stiffness, inverse.inverse(), Eigen::EigenvaluesOnly)
                                       .eigenvalues();
    EXPECT_LT(scaled.maxCoeff(), 2.0 * (1.0 + 1e-12)) << share;
    const Eigen::MatrixXd cycle =
        multiply(multigrid(body, k, {.coarsest_dofs = 40}).preconditioner, identity);
    const Eigen::VectorXd values =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(cycle, Eigen::EigenvaluesOnly).eigenvalues();
    EXPECT_GT(values.minCoeff(), -1e-14 * values.maxCoeff()) << share;  // 1e8 of a shift times round-off
  }
}

template <int Dim>
void expect_symmetric_and_positive(const Model& m, const char* name) {
  const auto body = build_body<Dim>(m);
  const LinearOperator k = stiffness_operator(body);
  const Multigrid mg = multigrid(body, k, {.coarsest_dofs = 200});
  EXPECT_GE(mg.dofs.size(), 2U) << name;
  EXPECT_LT(asymmetry(mg.preconditioner), 1e-13) << name;
  for (unsigned seed = 0; seed < 5; ++seed) {
    const Eigen::VectorXd x = random_vector(k.size, seed);
    EXPECT_GT(x.dot(multiply(mg.preconditioner, x)), 0.0) << name;
    const Eigen::VectorXd rough = multiply(k, multiply(k, x));  // the upper end of the spectrum
    EXPECT_GT(rough.dot(multiply(mg.preconditioner, rough)), 0.0) << name;
  }
}

TEST(Multigrid, IsSymmetricPositiveDefiniteInSpaceAndOnALine) {
  expect_symmetric_and_positive<3>(clamped({10, 9, 8}), "clamped");
  expect_symmetric_and_positive<3>(box({9, 8, 8}), "free");
  for (const WallType type : {WallType::mirror, WallType::antimirror, WallType::zero_layer}) {
    Model m = box({9, 8, 7});
    for (int a = 0; a < 3; ++a) test::add_walls(m, a, type);
    expect_symmetric_and_positive<3>(m, "walls");
  }
  Model m = clamped({10, 9, 8});
  m.periodic = {false, true, true};
  test::add_crack(m, {{0.5, -0.1, -0.1}, {0.5, 0.5, -0.1}, {0.5, 0.5, 0.9}, {0.5, -0.1, 0.9}});
  expect_symmetric_and_positive<3>(m, "cracked periodic");
  expect_symmetric_and_positive<1>(clamped({1001}), "line");
}

template <int Dim>
void expect_the_solution_of_a_factor(const Model& m, const std::string& name) {
  const auto body = build_body<Dim>(m);
  const Csr k = scalar_csr(assemble_stiffness(body), body.boundary.free_number);
  CholeskyFactor factor(k, particle_of_free_dof(body));
  ASSERT_EQ(factor.factorize(k, 0.0, Eigen::VectorXd::Zero(k.rows)), FactorStatus::done) << name;
  const Eigen::VectorXd b = load_on_the_right(body);
  const Eigen::VectorXd exact = factor.solve(b);
  const LinearOperator a = stiffness_operator(body);
  const Multigrid mg = multigrid(body, a, {.coarsest_dofs = 200});
  // The error is up to the condition number, 1e4 here, times the residual.
  const CgResult r = conjugate_gradients(a, b, mg.preconditioner, {.tolerance = 1e-12});
  EXPECT_TRUE(r.converged) << name << ": " << r.message;
  EXPECT_LT((r.x - exact).norm(), 1e-8 * exact.norm()) << name;
}

TEST(Multigrid, LeadsToTheSolutionOfACholeskyFactor) {
  for (const auto& [name, m] : plane_models(24, 23)) {
    if (name == "free" || name == "periodic") continue;  // singular
    expect_the_solution_of_a_factor<2>(m, name);
  }
  expect_the_solution_of_a_factor<3>(clamped({10, 9, 8}), "3D");
  expect_the_solution_of_a_factor<1>(clamped({999}), "1D");
}

/// Rigid motions are the null space; b = K x has no part in it.
TEST(Multigrid, SolvesFreeBodies) {
  for (const auto& m : {box({48, 48}), box({45, 47})}) {
    const auto body = build_body<2>(m);
    const CgResult r = solve(body, multiply(stiffness_operator(body), random_vector(body.boundary.free, 5)),
                             {.coarsest_dofs = 500});
    EXPECT_TRUE(r.converged) << r.message;
    EXPECT_LE(r.iterations, 15);
  }
}

/// Measured when written: 2D 7, 10, 10, 11; 3D 6, 10, 10 iterations with three, four ... levels.
TEST(Multigrid, TakesNearlyTheSameIterationsForAnySize) {
  for (const int n : {32, 64, 128, 256}) {
    const auto body = build_body<2>(clamped({n, n}));
    const CgResult r = solve(body, load_on_the_right(body), {.coarsest_dofs = 500});
    EXPECT_TRUE(r.converged) << r.message;
    EXPECT_LE(r.iterations, 14) << n;
  }
  for (const int n : {8, 16, 32}) {
    const auto body = build_body<3>(clamped({n, n, n}));
    const CgResult r = solve(body, load_on_the_right(body), {.coarsest_dofs = 500});
    EXPECT_TRUE(r.converged) << r.message;
    EXPECT_LE(r.iterations, 14) << n;
  }
}

TEST(Multigrid, HoldsOutWithCracksAndBrokenBonds) {
  for (const int n : {64, 101, 128}) {
    Model m = clamped({n, n});
    test::add_crack(m, {{0.5, -0.1}, {0.5, 0.7}});
    auto body = build_body<2>(m);
    const CgResult cracked = solve(body, load_on_the_right(body), {.coarsest_dofs = 500});
    EXPECT_TRUE(cracked.converged) << n << ": " << cracked.message;
    EXPECT_LT(cracked.iterations, 60) << n;
    std::mt19937 random(7);
    std::bernoulli_distribution broken(0.15);  // of both ends: more than a quarter of the bonds
    const int size = std::get<GridBonds<2>>(body.bonds).family.size();
    for (Index i = 0; i < body.count(); ++i) {
      for (int k = 0; k < size; ++k) {
        if (body.particles.position[i][0] > 0.3 && broken(random)) break_bond(body.bonds, i, k);
      }
    }
    const CgResult damaged = solve(body, load_on_the_right(body), {.coarsest_dofs = 500});
    EXPECT_TRUE(damaged.converged) << n << ": " << damaged.message;
    EXPECT_LT(damaged.iterations, 60) << n;
  }
}

TEST(Multigrid, GivesTheSameBitsForAnyNumberOfThreads) {
  Model m = clamped({97, 90});
  std::get<GridSpec>(m.particles).remove.push_back(Region{BallRegion{{0.5, 0.4}, 0.15}, {}});
  test::add_wall(m, 1, false, WallType::mirror);
  const auto body = build_body<2>(m);
  const Eigen::VectorXd b = random_vector(body.boundary.free, 9);
  const LinearOperator k = stiffness_operator(body);
  const int before = threads();
  set_threads(1);
  const Eigen::VectorXd one = multiply(multigrid(body, k).preconditioner, b);
  set_threads(2);
  const Eigen::VectorXd two = multiply(multigrid(body, k).preconditioner, b);
  set_threads(before);
  EXPECT_EQ(one, two);
}

TEST(Multigrid, FactorsBodiesTooSmallOrTooThinToCoarsen) {
  for (const auto& cells : {std::vector<int>{10, 10}, {900, 3}}) {
    const auto body = build_body<2>(clamped(cells));
    const LinearOperator k = stiffness_operator(body);
    const Multigrid mg = multigrid(body, k);
    EXPECT_EQ(mg.dofs, std::vector<Index>{k.size});
    const CgResult r = conjugate_gradients(k, random_vector(k.size, 3), mg.preconditioner, {});
    EXPECT_TRUE(r.converged) << r.message;
    EXPECT_LE(r.iterations, 2);  // a slender strip loses digits in its factor
  }
}

TEST(Multigrid, RefusesWhatDoesNotBelongTogether) {
  const auto body = build_body<2>(clamped({16, 16}));
  EXPECT_THROW((void)multigrid(body, LinearOperator{3, {}}), Error);
  EXPECT_THROW((void)multigrid(body, stiffness_operator(body), {.smoothing = 0}), Error);
}

}  // namespace
}  // namespace perimode
