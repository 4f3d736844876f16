// SPDX-License-Identifier: BSD-3-Clause
#include <cholmod.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <numeric>
#include <random>

#include "bond_terms.hpp"
#include "matrices.hpp"
#include "perimode/core/error.hpp"
#include "perimode/linalg/factor.hpp"
#include "support/models.hpp"

namespace perimode {
namespace {

using test::add_products;
using test::bond_terms;
using test::chosen;
using test::no_columns;

struct Problem {
  Csr k;
  std::vector<Index> order;
  SparseColumns bonds;
};

const auto every_bond = [](Index, Index) { return true; };

/// A box whose left layers are held, with all its bonds.
template <int Dim>
Problem held_box(int n) {
  Model m = test::box_model(std::vector<int>(Dim, n), 1.0 / n, Dim == 3 ? 2.0 : 3.0);
  std::vector<int> all(Dim);
  std::iota(all.begin(), all.end(), 0);
  test::fix_face(m, 0, false, 2, all);
  const auto body = build_body<Dim>(m);
  Problem out;
  out.k = scalar_csr(assemble_stiffness(body), body.boundary.free_number, Zeros::keep);
  out.order = dissection_order(out.k, particle_of_free_dof(body), particle_positions(body));
  out.bonds = bond_terms(body, every_bond);
  return out;
}

/// A random definite matrix, its own graph's edges as terms; each may be taken away half.
Problem random_problem(Index n, unsigned seed) {
  Problem out;
  out.k = test::random_definite(n, 6, seed);
  out.order = fill_reducing_order(out.k, {});
  out.bonds = no_columns(n);
  for (Index i = 0; i < n; ++i)
    for (Offset e = out.k.row_start[i]; e < out.k.row_start[i + 1]; ++e)
      if (out.k.column[e] > i) {
        const double half = std::sqrt(0.5 * std::abs(out.k.value[e]));
        test::append(out.bonds, {{i, half}, {out.k.column[e], -half}});
      }
  return out;
}

std::vector<std::pair<const char*, Problem>> problems() {
  return {{"1D", held_box<1>(60)},
          {"2D", held_box<2>(14)},
          {"3D", held_box<3>(7)},
          {"random", random_problem(300, 4)}};
}

std::vector<Index> some_bonds(const Problem& p, Index count, unsigned seed) {
  std::vector<Index> all(p.bonds.count());
  std::iota(all.begin(), all.end(), 0);
  std::shuffle(all.begin(), all.end(), std::mt19937(seed));
  all.resize(count);
  return all;
}

Eigen::VectorXd wave(Index n) {
  return Eigen::VectorXd::NullaryExpr(n, [](Eigen::Index i) { return std::sin(1.0 + 3.0 * i); });
}

CholeskyFactor factored(const Csr& k, const std::vector<Index>& order) {
  CholeskyFactor factor = CholeskyFactor::with_order(k, order);
  if (factor.factorize(k, 0.0, Eigen::VectorXd::Zero(k.rows)) != FactorStatus::done)
    throw std::runtime_error("not positive definite");
  return factor;
}

double residual(const Csr& k, const Eigen::VectorXd& x, const Eigen::VectorXd& b) {
  return (b - multiply(k, Eigen::MatrixXd(x)).col(0)).norm() / b.norm();
}

/// Both are backward stable: they differ by round-off times the condition number, some 1e4 here.
double difference(const CholeskyFactor& a, const CholeskyFactor& b, Index n) {
  const Eigen::VectorXd x = a.solve(wave(n)), y = b.solve(wave(n));
  return (x - y).norm() / y.norm();
}
constexpr double same = 1e-10;

TEST(FactorUpdate, OfAnyRankEqualsAFreshFactor) {
  for (const auto& [name, p] : problems()) {
    for (const Index rank : {1, 2, 3, 4, 5, 7, 8, 9, 13, 20}) {
      const SparseColumns change = chosen(p.bonds, some_bonds(p, rank, 10 + rank));
      for (const double sign : {1.0, -1.0}) {
        Csr changed = p.k;
        add_products(changed, change, 0.5 * sign);
        SparseColumns half = change;
        for (double& v : half.value) v *= std::sqrt(0.5);
        CholeskyFactor factor = factored(p.k, p.order);
        const UpdateResult result = sign > 0.0 ? factor.update(half, no_columns(p.k.rows))
                                               : factor.update(no_columns(p.k.rows), half);
        ASSERT_EQ(result.status, FactorStatus::done) << name << " " << rank;
        EXPECT_GT(result.touched, 0);
        EXPECT_LE(result.touched, rank * factor.fill().factor_bytes / 8.0);
        EXPECT_LE(difference(factor, factored(changed, p.order), p.k.rows), same)
            << name << " rank " << rank << " sign " << sign;
      }
    }
  }
}

TEST(FactorUpdate, AddsAndRemovesInOneCall) {
  for (const auto& [name, p] : problems()) {
    const SparseColumns gained = chosen(p.bonds, some_bonds(p, 11, 1));
    const SparseColumns lost = chosen(p.bonds, some_bonds(p, 6, 2));
    Csr changed = p.k;
    add_products(changed, gained, 1.0);
    add_products(changed, lost, -1.0);
    CholeskyFactor factor = factored(p.k, p.order);
    ASSERT_EQ(factor.update(gained, lost).status, FactorStatus::done) << name;
    EXPECT_LE(difference(factor, factored(changed, p.order), p.k.rows), same) << name;
  }
}

/// What is taken away after it was added, in one call: the additions come first, so that nothing is singular
/// in between.
TEST(FactorUpdate, ThatTakesBackWhatItGaveReturnsTheFactor) {
  for (const auto& [name, p] : problems()) {
    const CholeskyFactor old = factored(p.k, p.order);
    CholeskyFactor factor = factored(p.k, p.order);
    SparseColumns heavy = chosen(p.bonds, some_bonds(p, 10, 3));
    for (double& v : heavy.value) v *= 10.0;
    ASSERT_EQ(factor.update(heavy, heavy).status, FactorStatus::done) << name;
    EXPECT_LE(difference(factor, old, p.k.rows), same) << name;
    ASSERT_EQ(factor.update(heavy, no_columns(p.k.rows)).status, FactorStatus::done) << name;
    EXPECT_GT(difference(factor, old, p.k.rows), 1e-6) << name;
    ASSERT_EQ(factor.update(no_columns(p.k.rows), heavy).status, FactorStatus::done) << name;
    EXPECT_LE(difference(factor, old, p.k.rows), same) << name;
  }
}

/// CHOLMOD's own downdate of a simplicial L D L^T.
Eigen::VectorXd solve_by_updown(const Problem& p, const SparseColumns& removed, const Eigen::VectorXd& b) {
  cholmod_common common;
  cholmod_start(&common);
  cholmod_triplet* entries =
      cholmod_allocate_triplet(p.k.rows, p.k.rows, p.k.nonzeros(), 1, CHOLMOD_REAL, &common);
  for (Index i = 0; i < p.k.rows; ++i)
    for (Offset e = p.k.row_start[i]; e < p.k.row_start[i + 1]; ++e)
      if (p.k.column[e] >= i) {
        static_cast<int*>(entries->i)[entries->nnz] = i;
        static_cast<int*>(entries->j)[entries->nnz] = p.k.column[e];
        static_cast<double*>(entries->x)[entries->nnz++] = p.k.value[e];
      }
  cholmod_sparse* a = cholmod_triplet_to_sparse(entries, 0, &common);
  cholmod_factor* l = cholmod_analyze(a, &common);
  cholmod_factorize(a, l, &common);
  cholmod_change_factor(CHOLMOD_REAL, 0, 0, 1, 1, l, &common);
  cholmod_triplet* terms =
      cholmod_allocate_triplet(p.k.rows, removed.count(), removed.row.size(), 0, CHOLMOD_REAL, &common);
  for (Index c = 0; c < removed.count(); ++c)
    for (Offset e = removed.start[c]; e < removed.start[c + 1]; ++e) {
      static_cast<int*>(terms->i)[terms->nnz] = removed.row[e];
      static_cast<int*>(terms->j)[terms->nnz] = c;
      static_cast<double*>(terms->x)[terms->nnz++] = removed.value[e];
    }
  cholmod_sparse* c = cholmod_triplet_to_sparse(terms, 0, &common);
  cholmod_sparse* permuted =
      cholmod_submatrix(c, static_cast<int*>(l->Perm), p.k.rows, nullptr, -1, 1, 1, &common);
  cholmod_updown(0, permuted, l, &common);
  cholmod_dense right = {};
  right.nrow = right.d = right.nzmax = b.size();
  right.ncol = 1;
  right.x = const_cast<double*>(b.data());
  right.xtype = CHOLMOD_REAL;
  right.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* x = cholmod_solve(CHOLMOD_A, l, &right, &common);
  Eigen::VectorXd out = Eigen::Map<const Eigen::VectorXd>(static_cast<double*>(x->x), b.size());
  cholmod_free_dense(&x, &common);
  cholmod_free_sparse(&permuted, &common);
  cholmod_free_sparse(&c, &common);
  cholmod_free_triplet(&terms, &common);
  cholmod_free_factor(&l, &common);
  cholmod_free_sparse(&a, &common);
  cholmod_free_triplet(&entries, &common);
  cholmod_finish(&common);
  return out;
}

TEST(FactorUpdate, AgreesWithTheUpdatesOfCholmod) {
  for (const auto& [name, p] : problems()) {
    const SparseColumns lost = chosen(p.bonds, some_bonds(p, 7, 5));
    CholeskyFactor factor = factored(p.k, p.order);
    ASSERT_EQ(factor.update(no_columns(p.k.rows), lost).status, FactorStatus::done) << name;
    const Eigen::VectorXd b = wave(p.k.rows), x = factor.solve(b), y = solve_by_updown(p, lost, b);
    EXPECT_LE((x - y).norm(), same * y.norm()) << name;
  }
}

/// [davis_hager2001]: a thousand changes one by one leave the residual where a fresh factor has it.
TEST(FactorUpdate, AThousandTimesKeepsTheResidual) {
  const Problem p = held_box<2>(40);
  CholeskyFactor factor = factored(p.k, p.order);
  Csr changed = p.k;
  for (const Index bond : some_bonds(p, 1000, 6)) {
    const SparseColumns lost = chosen(p.bonds, {bond});
    add_products(changed, lost, -1.0);
    ASSERT_EQ(factor.update(no_columns(p.k.rows), lost).status, FactorStatus::done);
  }
  const Eigen::VectorXd b = wave(p.k.rows);
  const double fresh = residual(changed, factored(changed, p.order).solve(b), b);
  EXPECT_LE(residual(changed, factor.solve(b), b), 10.0 * fresh);
}

/// A chain held at its left end, eliminated from left to right: without the spring between m - 1 and m the
/// masses from m on float, and the last pivot of all vanishes, the others do not.
TEST(FactorUpdate, FindsThePivotThatVanishes) {
  constexpr Index n = 50, m = 20;
  Csr chain = test::chain(n, true);
  chain.value.back() = 1.0;  // the right end is free
  std::vector<Index> natural(n);
  std::iota(natural.begin(), natural.end(), 0);
  SparseColumns spring = no_columns(n);
  test::append(spring, {{m - 1, 1.0}, {m, -1.0}});
  CholeskyFactor factor = factored(chain, natural);
  const UpdateResult result = factor.update(no_columns(n), spring);
  EXPECT_EQ(result.status, FactorStatus::not_positive_definite);
  EXPECT_EQ(result.dof, n - 1);

  Csr broken = chain;
  add_products(broken, spring, -1.0);
  EXPECT_EQ(factor.factorize(broken, 0.0, Eigen::VectorXd::Zero(n)), FactorStatus::not_positive_definite);
  EXPECT_EQ(factor.failed_dof(), n - 1);
  ASSERT_EQ(factor.factorize(chain, 0.0, Eigen::VectorXd::Zero(n)), FactorStatus::done);
  EXPECT_LE(residual(chain, factor.solve(wave(n)), wave(n)), 1e-11);
}

/// A particle that loses all its bonds: one of its dofs is named, and the factor works again after a fresh
/// one.
template <int Dim>
void loose_particle(int n) {
  Model m = test::box_model(std::vector<int>(Dim, n), 1.0 / n, 2.0);
  std::vector<int> all(Dim);
  std::iota(all.begin(), all.end(), 0);
  test::fix_face(m, 0, false, 1, all);
  const auto body = build_body<Dim>(m);
  const Csr k = scalar_csr(assemble_stiffness(body), body.boundary.free_number, Zeros::keep);
  const std::vector<Index> particle = particle_of_free_dof(body);
  const auto order = dissection_order(k, particle, particle_positions(body));
  for (const Index loose : {body.count() - 1, body.count() / 2, body.count() / 3 + 1}) {
    if (body.boundary.free_number[static_cast<std::size_t>(loose) * Dim] < 0) continue;
    const SparseColumns lost = bond_terms(body, [&](Index i, Index j) { return i == loose || j == loose; });
    CholeskyFactor factor = factored(k, order);
    const UpdateResult result = factor.update(no_columns(k.rows), lost);
    ASSERT_EQ(result.status, FactorStatus::not_positive_definite) << Dim << "D, particle " << loose;
    EXPECT_EQ(particle[result.dof], loose) << Dim << "D";
    Csr broken = k;
    add_products(broken, lost, -1.0);
    ASSERT_EQ(factor.factorize(broken, 0.0, Eigen::VectorXd::Zero(k.rows)),
              FactorStatus::not_positive_definite);
    EXPECT_EQ(particle[factor.failed_dof()], loose) << Dim << "D";
    ASSERT_EQ(factor.factorize(k, 0.0, Eigen::VectorXd::Zero(k.rows)), FactorStatus::done);
    EXPECT_EQ(factor.solve(wave(k.rows)), factored(k, order).solve(wave(k.rows)));
    ASSERT_EQ(factor.update(chosen(lost, {0}), no_columns(k.rows)).status, FactorStatus::done);
  }
}

TEST(FactorUpdate, NamesADofOfTheParticleThatCameLoose) {
  loose_particle<1>(30);
  loose_particle<2>(9);
  loose_particle<3>(5);
}

TEST(FactorUpdate, RefusesColumnsOutsideThePattern) {
  const Csr k = test::chain(30, true);
  CholeskyFactor factor(k, {});
  ASSERT_EQ(factor.factorize(k, 0.0, Eigen::VectorXd::Zero(30)), FactorStatus::done);
  SparseColumns far = no_columns(30), longer = no_columns(31), beyond = no_columns(30);
  test::append(far, {{2, 1.0}, {27, -1.0}});
  test::append(longer, {{2, 1.0}, {3, -1.0}});
  test::append(beyond, {{29, 1.0}, {30, -1.0}});
  const Eigen::VectorXd before = factor.solve(wave(30));
  for (const SparseColumns& wrong : {far, longer, beyond}) {
    try {
      static_cast<void>(factor.update(wrong, no_columns(30)));
      ADD_FAILURE() << "accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
    }
  }
  EXPECT_EQ(factor.solve(wave(30)), before);
  EXPECT_EQ(factor.update(no_columns(30), no_columns(30)).touched, 0);
}

/// The same kernels on the supernodes that count: the same bits.
TEST(SolveSparse, EqualsTheFullSolution) {
  for (const auto& [name, p] : problems()) {
    const CholeskyFactor factor = factored(p.k, p.order);
    for (const std::vector<Index>& rows :
         {std::vector<Index>{0}, {p.k.rows - 1, 3, 3}, {p.k.rows / 2, p.k.rows / 3, 1}}) {
      Eigen::VectorXd b = Eigen::VectorXd::Zero(p.k.rows);
      for (const Index row : rows) b[row] = 1.0 + row;
      EXPECT_EQ(factor.solve_sparse(rows, b), factor.solve(b)) << name;
    }
    EXPECT_EQ(factor.solve_sparse({}, Eigen::VectorXd::Zero(p.k.rows)), Eigen::VectorXd::Zero(p.k.rows));
  }
}

}  // namespace
}  // namespace perimode
