// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "chebyshev.hpp"
#include "perimode/core/error.hpp"
#include "perimode/linalg/conjugate_gradients.hpp"
#include "sparse_engine.hpp"

namespace perimode {
namespace {

/// What both ways share.
struct Search {
  const EigenProblem& problem;
  const EigenOptions& options;
  const Sink& sink;
  const LinearOperator& action;
  Eigen::MatrixXd known;
  Wanted wanted;
  SearchSettings settings;
};

SearchSettings settings_of(const EigenOptions& options, Eigen::Index count) {
  SearchSettings settings{.block = options.block_size > 0 ? options.block_size : 4,
                          .tolerance = options.tolerance,
                          .seed = options.seed};
  settings.columns = static_cast<int>(std::max<Eigen::Index>(2 * count + 8 * settings.block, 60));
  return settings;
}

/// After the first pairs: further copies, and how all of it is certified.
void conclude(const Search& search, SpectralTransform& op, SearchResult& found, EigenResult& out) {
  if (!found.pairs.converged) {
    out.message = "the iteration did not converge";
    return;
  }
  complete(op, search.known, search.wanted, search.settings, found, search.sink);
  out.restarts += found.pairs.restarts;
  if (!found.clean) {
    out.message = found.message;
    return;
  }
  out.status = EigenStatus::converged;
  if (search.options.check == CompletenessCheck::none) {
    out.certificate = {.asked = false, .method = "none"};
    return;
  }
  const Offset total = found.pairs.theta.size() + search.known.cols();
  out.certificate = {.complete = true,
                     .method = total == op.size() ? "all modes" : "restart",
                     .count = total,
                     .at = op.eigenvalue(found.cut),
                     .seconds = found.probe_seconds,
                     .solves = static_cast<int>(found.probe_columns)};
}

/// The filter of the next trial: where it begins to hold the spectrum down, and the degree.
struct Edge {
  double at = 0.0;
  bool linear = false;  ///< degree 1: in the order of the eigenvalues everywhere
};

/// Block Lanczos on a filter with its edge somewhat above the wanted modes. The edge is found on the way:
/// Ritz values bound eigenvalues from above, so an edge far above those wanted is lowered, and one they do
/// not stay below is raised. Beyond the edge a filter mixes the order of the eigenvalues; where even the
/// highest edge lies too low the filter of degree 1 takes its place.
SearchResult filtered(Search& search, EigenResult& out) {
  const Eigen::VectorXd& mass = *search.problem.mass;
  double top = spectrum_top(search.action, mass, search.options.seed + 17);
  if (search.options.top > 0.0) top = std::min(top, search.options.top);
  top *= 1.001;
  const double highest = 0.25 * top;
  Edge edge{search.options.edge > 0.0 ? std::min(search.options.edge, highest) : highest};
  // No lower: mechanisms at zero would draw the edge down without end.
  const double lowest = search.options.edge > 0.0 ? 1e-5 * edge.at : 1e-10 * top;
  Eigen::MatrixXd start(mass.size(), 0);
  constexpr int most_filters = 40;
  for (int trial = 0;; ++trial) {
    const int degree = edge.linear ? 1 : filter_degree(edge.at, top);
    SpectralTransform op = chebyshev_filter(search.action, mass, edge.at, top, degree);
    const Edge higher = edge.at < highest ? Edge{std::min(4.0 * edge.at, highest)} : Edge{highest, true};
    Edge better;
    const Eigen::Index last = std::max<Eigen::Index>(search.wanted.count, 1) - 1;
    search.settings.give_up = [&](const Eigen::VectorXd& theta) {
      if (trial >= most_filters || degree == 1 || theta.size() <= last) return false;
      constexpr double wasteful = 8.0, room = 2.0, close = 0.8;
      const double seen = op.eigenvalue(theta[last]);
      const bool full = theta.size() + 2 * search.settings.block > search.settings.columns;
      if (wasteful * std::max(seen, lowest) < edge.at) better = {room * std::max(seen, lowest)};
      if (full && seen > close * edge.at) better = higher;
      return better.at > 0.0;
    };
    SearchResult found;
    found.pairs = block_lanczos(op, search.known, start, search.wanted, search.settings);
    const Eigen::VectorXd& theta = found.pairs.theta;
    if (degree > 1 && found.pairs.converged && theta.size() > last && !(op.eigenvalue(theta[last]) < edge.at))
      better = trial < most_filters ? higher : Edge{highest, true};
    out.products += op.applied * degree;
    if (better.at == 0.0) {
      search.settings.give_up = {};
      const Offset before = op.applied;
      conclude(search, op, found, out);
      out.products += (op.applied - before) * degree;
      return found;
    }
    const Eigen::Index some = std::min<Eigen::Index>(search.settings.block, found.pairs.vector.cols());
    start = found.pairs.vector.leftCols(some);
    edge = better;
  }
}

/// Block Lanczos on (K - sigma M)^-1, every column by conjugate gradients.
SearchResult inverted(Search& search, EigenResult& out) {
  const Eigen::VectorXd& mass = *search.problem.mass;
  const double sigma = !std::isnan(search.options.negative_shift) ? search.options.negative_shift
                       : search.options.scale > 0.0
                           ? -0.1 * search.options.scale
                           : -1e-6 * spectrum_top(search.action, mass, search.options.seed);
  out.shift = sigma;
  const LinearOperator shifted{search.action.size, [&](const double* x, double* y) {
                                 search.action.apply(x, y);
                                 const Eigen::Map<const Eigen::VectorXd> from(x, mass.size());
                                 Eigen::Map<Eigen::VectorXd>(y, mass.size()) -=
                                     sigma * mass.cwiseProduct(from);
                               }};
  const LinearOperator preconditioner =
      search.problem.preconditioner != nullptr ? *search.problem.preconditioner : LinearOperator{};
  constexpr double inner = 1e-12;
  const CgOptions cg{.tolerance = inner};
  const auto solve = [&](const MatrixView& b) {
    Eigen::MatrixXd x(b.rows(), b.cols());
    for (Eigen::Index j = 0; j < b.cols(); ++j) {
      const CgResult r = conjugate_gradients(shifted, b.col(j), preconditioner, cg);
      // As far down as round-off lets it go is good enough: what is left is rough, and the inverse damps it.
      constexpr double rough = 1e-8;
      if (!r.converged && !(r.residual <= rough))
        throw Error(ErrorKind::solver_failure, "conjugate gradients for the inverse: " + r.message);
      out.products += r.iterations;
      x.col(j) = r.x;
    }
    return x;
  };
  SpectralTransform op = shift_invert(sigma, true, mass.cwiseSqrt(), solve);
  op.round_off = 10.0 * inner;
  SearchResult found;
  found.pairs =
      block_lanczos(op, search.known, Eigen::MatrixXd(mass.size(), 0), search.wanted, search.settings);
  conclude(search, op, found, out);
  out.solves = static_cast<int>(op.applied);
  return found;
}

}  // namespace

LinearOperator action_of(const EigenProblem& problem) {
  return problem.action != nullptr ? *problem.action : as_operator(*problem.stiffness);
}

double factor_free_bytes(double dofs, double modes) {
  const double columns = std::max(2.0 * modes + 32.0, 60.0);
  // The basis, the vectors that a restart or the end of the search copies out of it, and the modes: fitted to
  // measured peaks for 3 to 60 modes, since which pages are touched depends on the course of the iteration.
  return 8.0 * dofs * (2.68 * columns + 1.81 * modes - 45.0);
}

EigenResult solve_factor_free(const EigenProblem& problem, const EigenOptions& options, const Sink& sink) {
  EigenResult out;
  const bool inverse = options.engine == EigenEngine::inverse;
  out.engine = inverse ? "inverse" : "chebyshev";
  const LinearOperator action = action_of(problem);
  Search search{problem, options, sink, action, known_directions(problem), {}, {}};
  search.wanted.count = std::min<Eigen::Index>(options.count, problem.mass->size() - search.known.cols());
  search.settings = settings_of(options, search.wanted.count);
  sink.report("modes");
  const Stopwatch iteration;
  const SearchResult found = inverse ? inverted(search, out) : filtered(search, out);
  out.seconds_iterate = iteration.seconds() - found.probe_seconds;
  rayleigh_ritz(problem, found.pairs.vector, out);
  keep(out, 0, std::min(search.wanted.count, out.value.size()));
  return out;
}

}  // namespace perimode
