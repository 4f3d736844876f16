// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "perimode/linalg/sparse.hpp"

namespace perimode {

/// A fill-reducing order of a matrix with symmetric pattern: order[k] = the dof eliminated k-th.
/// The dofs of one node (equal, non-decreasing node_of_dof; empty: each its own) stay together:
/// METIS nested dissection runs on the graph of the nodes. Cost O(nonzeros log rows).
[[nodiscard]] std::vector<Index> fill_reducing_order(const Csr& pattern, std::span<const Index> node_of_dof);

/// The same from the positions of the nodes, m (dimension x nodes; column node_of_dof[i] is that of dof i):
/// nested dissection by planes across the longest side of each part, the separator taken from the graph, so
/// that cracks, holes, clouds and periodic bodies are treated as what they are. Far cheaper than
/// METIS; tests/bench/bench_solvers.cpp compares the two. Cost O(nonzeros + bonds log nodes).
[[nodiscard]] std::vector<Index> dissection_order(const Csr& pattern, std::span<const Index> node_of_dof,
                                                  const Eigen::MatrixXd& position);

/// What a Cholesky factorisation would cost, from the pattern alone.
struct FillEstimate {
  Offset nonzeros = 0;        ///< of L
  double flops = 0.0;         ///< of the factorisation
  double factor_bytes = 0.0;  ///< L as stored (dense supernodes hold some zeros)
  double peak_bytes = 0.0;    ///< L, the copies of the matrix and the work space of the factorisation
};
/// Orders and counts; no numbers are touched. Cost as an ordering and O(nonzeros).
[[nodiscard]] FillEstimate predict_fill(const Csr& pattern, std::span<const Index> node_of_dof);
/// The same with a given order of elimination.
[[nodiscard]] FillEstimate predict_fill_with_order(const Csr& pattern, const std::vector<Index>& order);

enum class FactorStatus { done, not_positive_definite };

/// What an update of a factor came to.
struct UpdateResult {
  FactorStatus status = FactorStatus::done;
  /// not_positive_definite: the dof whose pivot vanished, in the order of the matrix. The leading minors
  /// before it (in the order of elimination) are positive definite. The factor is spent until the next
  /// factorize.
  Index dof = -1;
  Offset touched = 0;  ///< numbers of L rewritten, once per column of rank: what the update cost
};

/// P (K - sigma diag(mass)) P^T = L L^T, supernodal (CHOLMOD). One analysis serves any number of
/// factorisations of matrices with the same pattern. Moves, does not copy.
class CholeskyFactor {
 public:
  /// Orders and analyses. Throws Error(environment) if L needs 2^31 entries or more, or if memory
  /// runs out.
  CholeskyFactor(const Csr& pattern, std::span<const Index> node_of_dof);
  /// The same with a given order of elimination.
  [[nodiscard]] static CholeskyFactor with_order(const Csr& pattern, std::vector<Index> order);
  ~CholeskyFactor();
  CholeskyFactor(CholeskyFactor&&) noexcept;
  CholeskyFactor& operator=(CholeskyFactor&&) noexcept;
  CholeskyFactor(const CholeskyFactor&) = delete;
  CholeskyFactor& operator=(const CholeskyFactor&) = delete;

  /// Factors matrix - sigma diag(mass); `matrix` is symmetric with the analysed pattern. A matrix
  /// whose smallest pivot is below 1e-13 of the largest counts as not positive definite.
  [[nodiscard]] FactorStatus factorize(const Csr& matrix, double sigma, const Eigen::VectorXd& mass);

  /// x = (K - sigma M)^-1 b for all columns at once. Not for two threads at a time.
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& b) const;

  /// The factor of A + sum_a a a^T - sum_r r r^T from that of A, in place on the supernodes: only those on
  /// the paths from the columns' rows to the root of the elimination tree are touched, several columns at a
  /// time; additions come first. Every product c c^T has to lie within the analysed pattern. A pivot that
  /// falls below 1e-11 of the diagonal of the matrix last factored counts as vanished. [davis_hager2001],
  /// [gill1974]. Throws invalid_input for columns of another length or outside the pattern.
  /// Cost: 2 operations per number of L on the paths and column. @pre the last factorize was `done`.
  [[nodiscard]] UpdateResult update(const SparseColumns& added, const SparseColumns& removed);

  /// x = A^-1 b for one b that is zero but in `rows` (any order, repetitions allowed): the forward
  /// substitution keeps to the paths from these rows.
  [[nodiscard]] Eigen::VectorXd solve_sparse(std::span<const Index> rows, const Eigen::VectorXd& b) const;

  /// The dof at which the last factorize that was not `done` met its first pivot that is not positive, or -1.
  [[nodiscard]] Index failed_dof() const;

  [[nodiscard]] const FillEstimate& fill() const;
  [[nodiscard]] const std::vector<Index>& order() const;

 private:
  struct Handle;
  explicit CholeskyFactor(std::unique_ptr<Handle> handle);
  std::unique_ptr<Handle> handle_;
};

/// K - sigma diag(mass) = L D L^T with pivoting, for indefinite matrices (sequential MUMPS).
/// Its inertia counts eigenvalues: by Sylvester's law the number of negative pivots is the number
/// of lambda < sigma of K x = lambda M x.
class IndefiniteFactor {
 public:
  /// Factors at once; `order` as from fill_reducing_order. Throws Error(solver_failure) with the
  /// code of MUMPS if it breaks down and Error(environment) if memory runs out.
  IndefiniteFactor(const Csr& matrix, double sigma, const Eigen::VectorXd& mass,
                   std::span<const Index> order);
  ~IndefiniteFactor();
  IndefiniteFactor(IndefiniteFactor&&) noexcept;
  IndefiniteFactor& operator=(IndefiniteFactor&&) noexcept;
  IndefiniteFactor(const IndefiniteFactor&) = delete;
  IndefiniteFactor& operator=(const IndefiniteFactor&) = delete;

  [[nodiscard]] Index negative_pivots() const;
  [[nodiscard]] Offset nonzeros() const;
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& b) const;

 private:
  struct Handle;
  std::unique_ptr<Handle> handle_;
};

/// P (K - sigma diag(mass)) Q = L U for unsymmetric matrices (UMFPACK).
class LuFactor {
 public:
  /// Factors at once. Throws Error(solver_failure) if the matrix is singular to working precision.
  LuFactor(const Csr& matrix, double sigma, const Eigen::VectorXd& mass);
  ~LuFactor();
  LuFactor(LuFactor&&) noexcept;
  LuFactor& operator=(LuFactor&&) noexcept;
  LuFactor(const LuFactor&) = delete;
  LuFactor& operator=(const LuFactor&) = delete;

  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  /// x = (K - sigma M)^-T b
  [[nodiscard]] Eigen::VectorXd solve_transposed(const Eigen::VectorXd& b) const;

 private:
  struct Handle;
  std::unique_ptr<Handle> handle_;
};

}  // namespace perimode
