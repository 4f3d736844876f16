// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "certificate.hpp"
#include "perimode/core/error.hpp"
#include "perimode/linalg/factor.hpp"
#include "sparse_engine.hpp"

namespace perimode {

double negative_shift(const EigenProblem& problem, const EigenOptions& options) {
  if (!std::isnan(options.negative_shift)) return options.negative_shift;
  if (options.scale > 0.0) return -0.1 * options.scale;
  const Csr& k = *problem.stiffness;
  double largest = 0.0;
  for (Index i = 0; i < k.rows; ++i)
    for (Offset e = k.row_start[i]; e < k.row_start[i + 1]; ++e)
      if (k.column[e] == i) largest = std::max(largest, k.value[e] / (*problem.mass)[i]);
  return -1e-6 * std::max(largest, std::numeric_limits<double>::min());
}

namespace {

/// Factors K - sigma M positive definite and says with which sigma; singular K falls back to a
/// negative shift, indefinite K to one below its spectrum where options.top says how far that may reach.
double factor_definite(CholeskyFactor& factor, const EigenProblem& problem, const EigenOptions& options) {
  const bool free = problem.known != nullptr && problem.known->cols() > 0;
  double sigma = free || !std::isnan(options.negative_shift) ? negative_shift(problem, options) : 0.0;
  if (factor.factorize(*problem.stiffness, sigma, *problem.mass) == FactorStatus::done) return sigma;
  sigma = std::min(sigma, 0.0) == 0.0 ? negative_shift(problem, options) : 100.0 * sigma;
  if (factor.factorize(*problem.stiffness, sigma, *problem.mass) == FactorStatus::done) return sigma;
  while (sigma > -options.top) {
    sigma = std::max(100.0 * sigma, -1.01 * options.top);
    if (factor.factorize(*problem.stiffness, sigma, *problem.mass) == FactorStatus::done) return sigma;
  }
  throw Error(ErrorKind::solver_failure, "the stiffness is not positive semidefinite: K - (" +
                                             std::to_string(sigma) + ") M has no Cholesky factor");
}

/// Shows that `found` and `known` are all there is below the cut; searches on, a few times, where
/// something is missing.
Certificate certify(const EigenProblem& problem, const EigenOptions& options, const CholeskyFactor& factor,
                    SpectralTransform& op, const Eigen::MatrixXd& known, const Wanted& wanted,
                    SearchResult& found, const Sink& sink) {
  if (options.check == CompletenessCheck::none) return {.asked = false, .method = "none"};
  const bool inertia =
      options.check == CompletenessCheck::inertia ||
      (options.check == CompletenessCheck::automatic &&
       inertia_is_cheap(problem.stiffness->rows, factor.fill().nonzeros, factor.fill().flops));
  SearchSettings settings = search_settings(options, problem.stiffness->rows);
  Certificate out;
  constexpr int most_searches = 3;
  for (int attempt = 0;; ++attempt) {
    const Offset total = found.pairs.theta.size() + known.cols();
    const double at = op.eigenvalue(found.cut);
    sink.report("certificate");
    if (total == op.size()) return {.complete = true, .method = "all modes", .count = total, .at = at};
    settings.seed += 7919;
    if (inertia) {
      out = certify_by_inertia(problem, at, total, factor.order());
    } else {
      out = certify_by_restart(op, beside(known, found.pairs.vector), found.pairs.rest, found.cut,
                               settings.block, 1, settings.seed);
      out.count = total;
    }
    if (out.complete || attempt == most_searches) return out;
    settings.block = 8;
    complete(op, known, wanted, settings, found, sink);
  }
}

}  // namespace

std::vector<Index> elimination_order(const EigenProblem& problem) {
  return problem.position != nullptr
             ? dissection_order(*problem.stiffness, problem.node_of_dof, *problem.position)
             : fill_reducing_order(*problem.stiffness, problem.node_of_dof);
}

namespace {

/// The lowest modes by a factor of K - out.shift M.
void search_lowest(const EigenProblem& problem, const EigenOptions& options, const CholeskyFactor& factor,
                   EigenResult& out, const Sink& sink) {
  const Stopwatch iteration;
  SpectralTransform op = shift_invert(out.shift, true, problem.mass->cwiseSqrt(),
                                      [&](const MatrixView& b) { return factor.solve(b); });
  const Eigen::MatrixXd known = known_directions(problem);
  const Wanted wanted{.count = std::min<Eigen::Index>(options.count, op.size() - known.cols())};
  SearchResult found = search(op, known, wanted, search_settings(options, problem.stiffness->rows),
                              search_method(options), sink);
  out.seconds_iterate = iteration.seconds();
  out.solves = static_cast<int>(op.applied);
  if (found.clean) {
    out.certificate = certify(problem, options, factor, op, known, wanted, found, sink);
    const bool certified = out.certificate.complete || !out.certificate.asked;
    out.status = certified ? EigenStatus::converged : EigenStatus::not_certified;
    if (!certified)
      out.message = "found " + std::to_string(found.pairs.theta.size() + known.cols()) +
                    " eigenvalues below " + std::to_string(out.certificate.at) + ", but the certificate (" +
                    out.certificate.method + ") disagrees";
  } else {
    out.message = found.message;
  }
  out.restarts = found.pairs.restarts;
  rayleigh_ritz(problem, found.pairs.vector, out);
  keep(out, 0, std::min(wanted.count, out.value.size()));
}

}  // namespace

EigenResult solve_lowest(const EigenProblem& problem, const EigenOptions& options, const Sink& sink) {
  EigenResult out;
  out.engine = method_name(options);
  if (problem.factor != nullptr) {
    out.shift = options.negative_shift;
    out.factor_nonzeros = problem.factor->fill().nonzeros;
    search_lowest(problem, options, *problem.factor, out, sink);
    return out;
  }
  sink.report("analysis");
  const Stopwatch analysis;
  CholeskyFactor factor = CholeskyFactor::with_order(*problem.stiffness, elimination_order(problem));
  out.seconds_analyse = analysis.seconds();
  out.factor_nonzeros = factor.fill().nonzeros;

  sink.report("factorisation");
  const Stopwatch factorisation;
  out.shift = factor_definite(factor, problem, options);
  out.seconds_factor = factorisation.seconds();
  search_lowest(problem, options, factor, out, sink);
  return out;
}

}  // namespace perimode
