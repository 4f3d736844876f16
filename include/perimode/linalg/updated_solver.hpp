// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "perimode/linalg/factor.hpp"
#include "perimode/linalg/operator.hpp"
#include "perimode/linalg/sparse.hpp"

namespace perimode {

/// How the solution after a change of the matrix is found. update: the factor follows the change. stale:
/// conjugate gradients with the factor as it was. refactor: a fresh factor. iterate: conjugate gradients
/// without a factor.
enum class SolveWay { update, stale, refactor, iterate };
constexpr int solve_ways = 4;
[[nodiscard]] std::string name(SolveWay way);  ///< "update", "stale", "refactor", "iterate"

struct UpdatedSolverOptions {
  std::optional<SolveWay> only = {};  ///< empty: by the cost model
  double tolerance = 1e-10;           ///< of conjugate gradients: |b - A x| <= tolerance |b|
  int most_iterations = 20000;
};

/// A relative residual above which iterations gave no solution.
inline constexpr double hopeless_residual = 1e-6;

/// One solution.
struct SolveOutcome {
  SolveWay way = SolveWay::update;
  int iterations = 0;     ///< of conjugate gradients
  int refinements = 0;    ///< steps of iterative refinement
  double residual = 0.0;  ///< |b - A x| / |b|, the largest over the columns
  bool converged = true;
  std::string message;    ///< why not
  bool singular = false;  ///< A is not positive definite
  Index dof = -1;  ///< singular, with a factor: the dof whose pivot vanished, or that moves most in the
                   ///< motion A does not hold
};

/// What all solutions of one way came to.
struct WayTotals {
  Offset solves = 0;
  Offset columns = 0;  ///< of change, added or removed
  Offset iterations = 0;
  double seconds = 0.0;
};

/// Solves A x = b for a symmetric positive definite A that loses (or gains) a few rank-one terms between
/// solutions. With a factor, the way is the cheapest by a cost model (docs/theory/15_updates.md): the
/// measured times of the first factor and of a solution, the measured cost of an updated column, the
/// iterations a stale factor takes for the changes it lacks. Every solution's residual is checked; one that
/// is worse than 10 times that of the last fresh factor (and 1e-12) is refined, then refactored. Moves, does
/// not copy.
class UpdatedSolver {
 public:
  /// With a factor, made at once. `a` is the product with the matrix as it is at every solve; `matrix` its
  /// values now and an entry, if zero, for all that will change (scalar_csr with Zeros::keep). Throws
  /// Error(environment) as CholeskyFactor, invalid_input for sizes that differ. A matrix that is not positive
  /// definite shows in the first solve.
  UpdatedSolver(LinearOperator a, Csr matrix, std::vector<Index> order, const UpdatedSolverOptions& options);
  /// Without one: `preconditioner` makes that of the matrix as it is (again where the iterations have
  /// doubled).
  UpdatedSolver(LinearOperator a, std::function<LinearOperator()> preconditioner,
                const UpdatedSolverOptions& options);
  ~UpdatedSolver();
  UpdatedSolver(UpdatedSolver&&) noexcept;
  UpdatedSolver& operator=(UpdatedSolver&&) noexcept;
  UpdatedSolver(const UpdatedSolver&) = delete;
  UpdatedSolver& operator=(const UpdatedSolver&) = delete;

  /// A became A + sum_a a a^T - sum_r r r^T; `a` above shows it already. Changes collect until the next
  /// solve. Throws invalid_input for columns of another length, or beyond the entries of the matrix.
  void change(const SparseColumns& added, const SparseColumns& removed);

  /// A X = B, all columns; X comes in as the guess (last solution). After a singular outcome a change that
  /// makes A definite again has to come before the next solve, which then makes a fresh factor.
  [[nodiscard]] SolveOutcome solve(const Eigen::MatrixXd& b, Eigen::MatrixXd& x);

  /// The next solve makes a fresh factor (or preconditioner) and takes no guess: two solvers whose matrices
  /// went through the same changes in the same order then give the same bits, whatever they solved between.
  void refresh();

  [[nodiscard]] const std::array<WayTotals, solve_ways>& totals() const;  ///< by SolveWay
  [[nodiscard]] double factor_seconds()
      const;  ///< of the last fresh factor, analysis left out; 0 without one
  [[nodiscard]] double fresh_residual() const;  ///< of the last solution with a fresh factor
  [[nodiscard]] Offset factor_nonzeros() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace perimode
