// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "assembly/transfer.hpp"
#include "grid_models.hpp"
#include "perimode/assembly/assemble.hpp"
#include "perimode/assembly/multigrid.hpp"
#include "perimode/bonds/connectivity.hpp"
#include "perimode/core/error.hpp"

namespace perimode {
namespace {

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
    Model m = test::box(cells);
    for (int a = 0; a < m.dimension; ++a) test::add_walls(m, a, WallType::mirror);
    return m;
  };
  check(build_body<1>(behind_mirrors({16})));
  check(build_body<2>(behind_mirrors({12, 8})));
  check(build_body<3>(behind_mirrors({8, 8, 8})));
}

TEST(Coarsen, FixesADofWhereAChildIsFixed) {
  const auto coarse =
      coarsen(build_body<2>(test::clamped({16, 16})));  // three layers: a coarse one and half of the next
  for (Index i = 0; i < coarse.count(); ++i)
    EXPECT_EQ(coarse.boundary.free_number[2 * i] < 0, coarse.particles.cell[i] % 8 < 2);
}

TEST(Coarsen, CarriesACutDown) {
  Model m = test::clamped({32, 32});
  test::add_crack(m, {{0.5, -0.1}, {0.5, 1.1}});
  Body<2> body = build_body<2>(m);
  for (int level = 0; level < 2; ++level) {
    EXPECT_EQ(find_pieces(body.bonds, body.count()).count, 2) << "level " << level;
    body = coarsen(body);
  }
}

TEST(Coarsen, LeavesIntactBondsWhole) {
  const auto coarse = coarsen(build_body<2>(test::box({20, 14})));
  const auto made = build_body<2>(test::box_model({10, 7}, 0.1, 3.0));
  EXPECT_EQ(std::get<GridBonds<2>>(coarse.bonds).alive, std::get<GridBonds<2>>(made.bonds).alive);
}

/// The coarse body of each kind has a symmetric positive semi-definite K: the V-cycle stands on that.
TEST(Coarsen, GivesSymmetricMatrices) {
  for (const auto& cells : {std::pair{16, 16}, {15, 17}}) {
    for (const auto& [name, m] : test::plane_models(cells.first, cells.second)) {
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
    for (const auto& [name, m] : test::plane_models(cells.first, cells.second)) {
      const auto fine = build_body<2>(m);
      const auto coarse = coarsen(fine);
      Transfer<2> transfer(fine, coarse);
      const Eigen::VectorXd c = test::random_vector(coarse.boundary.free, 1),
                            b = test::random_vector(fine.boundary.free, 2),
                            q = test::random_vector(fine.boundary.free, 3);
      Eigen::VectorXd up = Eigen::VectorXd::Zero(b.size()), down(c.size());
      transfer.add_prolonged(c.data(), up.data());
      transfer.restrict_difference(b.data(), q.data(), down.data());
      EXPECT_NEAR(up.dot(b - q), c.dot(down), 1e-13 * up.norm() * (b - q).norm()) << name;
    }
  }
}

/// On a free body translations are met everywhere and linear fields away from the surface.
TEST(Transfer, InterpolatesLinearFields) {
  const auto fine = build_body<3>(test::box({8, 10, 12}));
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

}  // namespace
}  // namespace perimode
