// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/certificate.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "linalg/search.hpp"
#include "matrices.hpp"
#include "perimode/linalg/factor.hpp"

namespace perimode {
namespace {

/// A periodic lattice (1, 6, 12 copies at the bottom) with its 19 lowest modes found, from which a
/// test can take copies away, as a solver that lost them would.
class MissedMode : public testing::Test {
 protected:
  MissedMode() : factor_(k_, {}) {
    EXPECT_EQ(factor_.factorize(k_, 0.0, mass_), FactorStatus::done);
    op_ =
        shift_invert(0.0, true, mass_.cwiseSqrt(), [this](const MatrixView& b) { return factor_.solve(b); });
    found_ = search(op_, Eigen::MatrixXd(k_.rows, 0), {.count = 19}, {}, block_lanczos, {});
  }

  Csr k_ = test::periodic_lattice(8, 0.1);
  Eigen::VectorXd mass_ = Eigen::VectorXd::Ones(k_.rows);
  CholeskyFactor factor_;
  SpectralTransform op_;
  SearchResult found_;
};

TEST_F(MissedMode, InertiaAcceptsTheCompleteSet) {
  const Certificate certificate =
      certify_by_inertia({.stiffness = &k_, .mass = &mass_}, op_.eigenvalue(found_.cut),
                         found_.pairs.theta.size(), factor_.order());
  EXPECT_TRUE(certificate.complete);
  EXPECT_EQ(certificate.count, 19);
}

TEST_F(MissedMode, InertiaNoticesALostCopy) {
  const Certificate certificate =
      certify_by_inertia({.stiffness = &k_, .mass = &mass_}, op_.eigenvalue(found_.cut),
                         found_.pairs.theta.size() - 1, factor_.order());
  EXPECT_FALSE(certificate.complete);
  EXPECT_EQ(certificate.count, 19);
}

TEST_F(MissedMode, RestartAcceptsTheCompleteSet) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    EXPECT_TRUE(certify_by_restart(op_, found_.pairs.vector, {}, found_.cut, 4, 2, seed).complete);
}

TEST_F(MissedMode, RestartNoticesALostCopyOfAnyMode) {
  for (Eigen::Index lost = 0; lost < 19; ++lost) {
    Eigen::MatrixXd left(k_.rows, 18);
    left << found_.pairs.vector.leftCols(lost), found_.pairs.vector.rightCols(18 - lost);
    EXPECT_FALSE(certify_by_restart(op_, left, {}, found_.cut, 4, 1, 17 + lost).complete) << lost;
    EXPECT_FALSE(certify_by_restart(op_, left, found_.pairs.rest, found_.cut, 4, 1, lost).complete) << lost;
  }
}

TEST_F(MissedMode, SearchFindsLostCopiesAgain) {
  found_.pairs.vector = found_.pairs.vector.leftCols(5).eval();
  found_.pairs.theta.conservativeResize(5);
  complete(op_, Eigen::MatrixXd(k_.rows, 0), {.count = 19, .floor = found_.cut}, {}, found_, {});
  EXPECT_TRUE(found_.clean);
  EXPECT_EQ(found_.pairs.theta.size(), 19);
}

// A single column meets further copies by round-off only, so it ends at all stages of meeting one.
TEST_F(MissedMode, OneColumnBlocksLoseNoCopies) {
  const std::vector<double> all = test::periodic_lattice_eigenvalues(8, 0.1);
  for (const Eigen::Index count : {3, 13, 27, 30})
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      const SearchResult single = search(op_, Eigen::MatrixXd(k_.rows, 0), {.count = count},
                                         {.block = 1, .seed = 1000 * seed}, block_lanczos, {});
      ASSERT_TRUE(single.clean);
      ASSERT_GE(single.pairs.theta.size(), count);
      for (Eigen::Index i = 0; i < single.pairs.theta.size(); ++i)
        EXPECT_NEAR(op_.eigenvalue(single.pairs.theta[i]), all[i], 1e-10) << count << " " << seed;
    }
}

// What the iteration holds may contain a lost copy in part: here two parts in three of |x|^2, so
// that neither the held vector nor what is outside it reaches the cut by itself.
TEST_F(MissedMode, RestartNoticesACopyOfWhichTheIterationHoldsAPart) {
  const double share = 2.0 / 3.0;
  const Eigen::MatrixXd copy = found_.pairs.vector.rightCols(1);
  const Eigen::MatrixXd left = found_.pairs.vector.leftCols(18);
  std::mt19937_64 random(5);
  Eigen::MatrixXd other = random_columns(k_.rows, 1, random);
  for (int pass = 0; pass < 2; ++pass)
    other -= found_.pairs.vector * (found_.pairs.vector.transpose() * other);
  other.normalize();
  Neighbourhood held;
  held.vector = std::sqrt(share) * copy + std::sqrt(1.0 - share) * other;
  Eigen::MatrixXd image = op_.apply(held.vector);
  image -= left * (left.transpose() * image);
  held.theta = held.vector.transpose() * image;
  held.newest = image - held.vector * held.theta;
  held.tail = Eigen::MatrixXd::Constant(1, 1, held.newest.norm());
  held.newest /= held.tail(0, 0);
  ASSERT_LT(held.theta[0], found_.cut);
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    EXPECT_FALSE(certify_by_restart(op_, left, held, found_.cut, 4, 1, seed).complete);
}

TEST(InertiaIsCheap, ForSmallMatricesAndNotForLargeFactors) {
  EXPECT_TRUE(inertia_is_cheap(1000, 100'000, 1e8));
  EXPECT_FALSE(inertia_is_cheap(75'000, 27'000'000, 2e10));  // plane lattice of 200 x 200
}

}  // namespace
}  // namespace perimode
