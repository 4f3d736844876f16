// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/linalg/updated_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "column_products.hpp"
#include "core/stopwatch.hpp"
#include "perimode/core/error.hpp"
#include "perimode/linalg/conjugate_gradients.hpp"

namespace perimode {
namespace {

/// A time measured again and again; the last half counts as much as all before.
struct MeasuredTime {
  double seconds = 0.0;
  bool known = false;
  void see(double now) {
    seconds = known ? 0.5 * (seconds + now) : now;
    known = true;
  }
};

/// Iterations with a factor that lacks k columns grow like k^0.4, and no more than k (docs/theory/
/// 15_updates.md); `scale` follows what was counted.
struct StaleIterations {
  double scale = 3.2;
  [[nodiscard]] double predict(double missing) const {
    return std::min(missing, std::max(1.0, scale * std::pow(missing, 0.4)));
  }
  void see(double missing, double counted) {
    if (missing > 1.0) scale = counted / std::pow(missing, 0.4);
  }
};

constexpr double start_share = 0.001;       // of a factorisation: an updated column before any was measured
constexpr double too_small_to_time = 5e-3;  // s, a factorisation beside which no choice pays
// A stale factor puts the update off, it does not spare it.
constexpr double much_cheaper = 2.0;
constexpr double worse_than_fresh = 10.0;
constexpr double always_fine = 1e-12;  // a residual that needs no refinement
constexpr int most_refinements = 2;

/// The row with the entry of largest size; -1 where some are no numbers.
Index largest_row(const Eigen::MatrixXd& x) {
  if (!x.allFinite() || x.size() == 0) return -1;
  Eigen::Index row = 0, column = 0;
  x.cwiseAbs().maxCoeff(&row, &column);
  return static_cast<Index>(row);
}

}  // namespace

std::string name(SolveWay way) {
  switch (way) {
    case SolveWay::update:
      return "update";
    case SolveWay::stale:
      return "stale";
    case SolveWay::refactor:
      return "refactor";
    default:
      return "iterate";
  }
}

struct UpdatedSolver::Implementation {
  Implementation(LinearOperator matrix_product, const UpdatedSolverOptions& given)
      : a(std::move(matrix_product)),
        options(given),
        added(no_columns(a.size)),
        removed(no_columns(a.size)) {}

  LinearOperator a;
  UpdatedSolverOptions options;
  std::array<WayTotals, solve_ways> totals = {};
  SparseColumns added, removed;  // changes that the factor lacks
  Offset changed = 0;            // columns since the last solution

  // With a factor.
  Csr matrix;
  std::optional<CholeskyFactor> factor;
  bool usable = false;              // the factor is that of the matrix less the pending columns
  bool unused = false;              // it is fresh, and no solution was made with it yet
  std::vector<Index> changed_rows;  // since the last solution
  double factor_time = 0.0, fresh = 0.0;
  MeasuredTime solution, product, column;
  StaleIterations stale_iterations;

  // Without one.
  std::function<LinearOperator()> make_preconditioner;
  LinearOperator preconditioner;
  bool wanted = true;        // a new preconditioner
  int first_iterations = 0;  // with it

  [[nodiscard]] Index missing() const { return added.count() + removed.count(); }
  void forget_pending() {
    added = no_columns(a.size);
    removed = no_columns(a.size);
  }

  void refactor() {
    const auto begin = Clock::now();
    forget_pending();
    usable = factor->factorize(matrix, 0.0, Eigen::VectorXd::Zero(a.size)) == FactorStatus::done;
    unused = usable;
    factor_time = seconds_since(begin);
  }

  /// r = b - A x; returns the largest |r| / |b| over the columns (|r| where b = 0).
  double residual(const Eigen::MatrixXd& b, const Eigen::MatrixXd& x, Eigen::MatrixXd& r) {
    const auto begin = Clock::now();
    r.resize(b.rows(), b.cols());
    double worst = 0.0;
    for (Eigen::Index j = 0; j < b.cols(); ++j) {
      a.apply(x.col(j).data(), r.col(j).data());
      r.col(j) = b.col(j) - r.col(j);
      const double size = b.col(j).norm();
      const double relative = r.col(j).norm() / (size > 0.0 ? size : 1.0);
      worst = relative <= worst ? worst : relative;  // a nan stays
    }
    if (b.cols() > 0) product.see(seconds_since(begin) / static_cast<double>(b.cols()));
    return worst;
  }

  [[nodiscard]] SolveWay choose() const {
    if (options.only == SolveWay::iterate) return SolveWay::iterate;
    if (!usable || (unused && missing() == 0)) return SolveWay::refactor;
    if (options.only) return *options.only;
    const double lacking = missing();
    if (lacking == 0.0) return SolveWay::update;
    const double each = column.known ? column.seconds : start_share * factor_time;
    const double update = lacking * each + solution.seconds;
    const double stale = stale_iterations.predict(lacking) * (solution.seconds + product.seconds);
    const double again = factor_time + solution.seconds;
    if (factor_time < too_small_to_time || update <= std::min(much_cheaper * stale, again))
      return SolveWay::update;
    return much_cheaper * stale < again ? SolveWay::stale : SolveWay::refactor;
  }

  /// Brings the factor up to date. False: the matrix is not positive definite.
  bool follow(SolveOutcome& outcome) {
    if (missing() == 0) return true;
    const auto begin = Clock::now();
    const UpdateResult result = factor->update(added, removed);
    column.see(seconds_since(begin) / missing());
    forget_pending();
    usable = result.status == FactorStatus::done;
    unused = false;
    outcome.dof = result.dof;
    return usable;
  }

  /// x += A^-1 r with r zero but in the rows that changed, where the rest of b - A x is that of a fresh
  /// solution: then the forward substitution keeps to a few paths.
  bool correct(const Eigen::MatrixXd& b, Eigen::MatrixXd& x) {
    if (b.cols() != 1 || changed_rows.empty() || fresh == 0.0) return false;
    Eigen::MatrixXd r;
    if (!std::isfinite(residual(b, x, r))) return false;
    std::sort(changed_rows.begin(), changed_rows.end());
    changed_rows.erase(std::unique(changed_rows.begin(), changed_rows.end()), changed_rows.end());
    Eigen::VectorXd load = Eigen::VectorXd::Zero(a.size);
    for (const Index row : changed_rows) std::swap(load[row], r(row, 0));
    constexpr double no_worse = 2.0;
    if (!(r.norm() <= no_worse * fresh * b.norm())) return false;
    x.col(0) += factor->solve_sparse(changed_rows, load);
    return true;
  }

  void substitute(const Eigen::MatrixXd& b, Eigen::MatrixXd& x) {
    const auto begin = Clock::now();
    x = factor->solve(b);
    solution.see(seconds_since(begin));
  }

  void solve_by_factor(const Eigen::MatrixXd& b, Eigen::MatrixXd& x, SolveOutcome& outcome) {
    const bool fresh_factor = unused;
    unused = false;
    if (fresh_factor || !correct(b, x)) substitute(b, x);
    Eigen::MatrixXd r;
    outcome.residual = residual(b, x, r);
    if (fresh_factor) {
      fresh = outcome.residual;
      return;
    }
    const double limit = std::max(worse_than_fresh * fresh, always_fine);
    while (!(outcome.residual <= limit) && outcome.refinements < most_refinements) {
      x += factor->solve(r);
      ++outcome.refinements;
      outcome.residual = residual(b, x, r);
    }
    if (!(outcome.residual <= limit)) usable = false;
  }

  void solve_freshly(const Eigen::MatrixXd& b, Eigen::MatrixXd& x, SolveOutcome& outcome) {
    outcome.way = SolveWay::refactor;
    if (!unused || missing() > 0) refactor();
    if (!usable) {
      outcome.dof = factor->failed_dof();
      return;
    }
    solve_by_factor(b, x, outcome);
  }

  /// Conjugate gradients column by column, from x. Returns whether all converged.
  bool descend(const Eigen::MatrixXd& b, Eigen::MatrixXd& x, const LinearOperator& with, int most,
               SolveOutcome& outcome) {
    outcome.residual = 0.0;
    for (Eigen::Index j = 0; j < b.cols(); ++j) {
      const Eigen::VectorXd start = x.col(j);
      CgResult result = conjugate_gradients(
          a, b.col(j), with, {.tolerance = options.tolerance, .most_iterations = most}, &start);
      x.col(j) = result.x;
      outcome.iterations += result.iterations;
      outcome.residual = std::max(outcome.residual, result.residual);
      outcome.singular = result.singular;
      outcome.message = result.message;
      if (!result.converged) return false;
    }
    return true;
  }

  bool solve_stale(const Eigen::MatrixXd& b, Eigen::MatrixXd& x, SolveOutcome& outcome) {
    const double lacking = missing(), predicted = stale_iterations.predict(lacking);
    const int most = options.only ? options.most_iterations
                                  : std::min(options.most_iterations, 20 + static_cast<int>(3.0 * predicted));
    const bool converged = descend(b, x, factor_preconditioner(*factor, a.size), most, outcome);
    if (b.cols() > 0) stale_iterations.see(lacking, outcome.iterations / static_cast<double>(b.cols()));
    return converged;
  }

  void iterate(const Eigen::MatrixXd& b, Eigen::MatrixXd& x, SolveOutcome& outcome) {
    const bool made = std::exchange(wanted, false);
    if (made) preconditioner = make_preconditioner();
    outcome.converged = descend(b, x, preconditioner, options.most_iterations, outcome);
    if (made) first_iterations = outcome.iterations;
    wanted = outcome.iterations > 2 * std::max(first_iterations, 1);
  }

  SolveOutcome solve(const Eigen::MatrixXd& b, Eigen::MatrixXd& x) {
    if (b.rows() != a.size)
      invalid_input({fmt::format("right-hand sides of size {}, that of the operator", a.size),
                     fmt::format("{}", b.rows()),
                     "use one set of free dofs",
                     {}});
    if (x.rows() != b.rows() || x.cols() != b.cols()) x = Eigen::MatrixXd::Zero(b.rows(), b.cols());
    const auto begin = Clock::now();
    SolveOutcome outcome;
    outcome.way = factor ? choose() : SolveWay::iterate;
    if (outcome.way == SolveWay::iterate) {
      iterate(b, x, outcome);
    } else {
      solve_with_factor(b, x, outcome);
    }
    WayTotals& total = totals[static_cast<std::size_t>(outcome.way)];
    ++total.solves;
    total.columns += std::exchange(changed, 0);
    total.iterations += outcome.iterations;
    total.seconds += seconds_since(begin);
    changed_rows.clear();
    return outcome;
  }

  void solve_with_factor(const Eigen::MatrixXd& b, Eigen::MatrixXd& x, SolveOutcome& outcome) {
    bool done = false;
    if (outcome.way == SolveWay::stale) {
      done = solve_stale(b, x, outcome);
      if (done) return;
    } else if (outcome.way == SolveWay::update) {
      done = follow(outcome);
      if (done) {
        solve_by_factor(b, x, outcome);
        done = usable;
      } else {
        done = true;  // singular: nothing to solve
      }
    }
    if (!done) solve_freshly(b, x, outcome);
    if (usable && !(outcome.residual <= hopeless_residual)) {
      // A fresh factor whose vanishing pivot rounding has kept positive: x is the motion it belongs to.
      usable = false;
      outcome.dof = largest_row(x);
    }
    outcome.singular = !usable;
    if (outcome.singular) {
      outcome.converged = false;
      outcome.residual = std::numeric_limits<double>::infinity();
      outcome.message = "the matrix is not positive definite";
      return;
    }
    outcome.dof = -1;
    outcome.message.clear();
    outcome.converged = true;
  }
};

UpdatedSolver::UpdatedSolver(LinearOperator a, Csr matrix, std::vector<Index> order,
                             const UpdatedSolverOptions& options)
    : implementation_(std::make_unique<Implementation>(std::move(a), options)) {
  Implementation& s = *implementation_;
  if (matrix.rows != s.a.size)
    invalid_input({fmt::format("a matrix of {} rows, those of the operator", s.a.size),
                   fmt::format("{}", matrix.rows),
                   "use one set of free dofs",
                   {}});
  s.matrix = std::move(matrix);
  s.factor = CholeskyFactor::with_order(s.matrix, std::move(order));
  s.make_preconditioner = [&s] {
    std::vector<double> diagonal(s.matrix.rows, 0.0);
    std::vector<Index> number(s.matrix.rows);
    for (Index i = 0; i < s.matrix.rows; ++i) {
      number[i] = i;
      for (Offset e = s.matrix.row_start[i]; e < s.matrix.row_start[i + 1]; ++e)
        if (s.matrix.column[e] == i) diagonal[i] = s.matrix.value[e];
    }
    return block_jacobi(diagonal, 1, number);
  };
  if (options.only != SolveWay::iterate) {
    s.refactor();
    s.totals[static_cast<std::size_t>(SolveWay::refactor)].seconds += s.factor_time;
  }
}

UpdatedSolver::UpdatedSolver(LinearOperator a, std::function<LinearOperator()> preconditioner,
                             const UpdatedSolverOptions& options)
    : implementation_(std::make_unique<Implementation>(std::move(a), options)) {
  if (options.only && *options.only != SolveWay::iterate)
    invalid_input({"the way iterate, or none, without a factor",
                   name(*options.only),
                   "give the matrix and an order of elimination",
                   {}});
  implementation_->make_preconditioner = std::move(preconditioner);
}

UpdatedSolver::~UpdatedSolver() = default;
UpdatedSolver::UpdatedSolver(UpdatedSolver&&) noexcept = default;
UpdatedSolver& UpdatedSolver::operator=(UpdatedSolver&&) noexcept = default;

void UpdatedSolver::change(const SparseColumns& added, const SparseColumns& removed) {
  Implementation& s = *implementation_;
  for (const SparseColumns* columns : {&added, &removed})
    if (columns->count() > 0 && columns->rows != s.a.size)
      invalid_input({fmt::format("columns of length {}, that of the operator", s.a.size),
                     fmt::format("{}", columns->rows),
                     "use one set of free dofs",
                     {}});
  if (s.factor) {
    const std::vector<Offset> gains = places_of_products(added, s.matrix);
    const std::vector<Offset> losses = places_of_products(removed, s.matrix);
    add_products(added, 1.0, gains, s.matrix);
    add_products(removed, -1.0, losses, s.matrix);
    append(added, s.added);
    append(removed, s.removed);
    for (const SparseColumns* columns : {&added, &removed})
      s.changed_rows.insert(s.changed_rows.end(), columns->row.begin(), columns->row.end());
  }
  s.changed += added.count() + removed.count();
  if (!s.usable) s.forget_pending();
}

SolveOutcome UpdatedSolver::solve(const Eigen::MatrixXd& b, Eigen::MatrixXd& x) {
  return implementation_->solve(b, x);
}

void UpdatedSolver::refresh() {
  implementation_->usable = implementation_->unused = false;
  implementation_->wanted = true;
}

const std::array<WayTotals, solve_ways>& UpdatedSolver::totals() const { return implementation_->totals; }
double UpdatedSolver::factor_seconds() const { return implementation_->factor_time; }
double UpdatedSolver::fresh_residual() const { return implementation_->fresh; }
Offset UpdatedSolver::factor_nonzeros() const {
  return implementation_->factor ? implementation_->factor->fill().nonzeros : 0;
}

}  // namespace perimode
