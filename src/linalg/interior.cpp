// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "certificate.hpp"
#include "dense.hpp"
#include "perimode/core/error.hpp"
#include "perimode/linalg/factor.hpp"
#include "sparse_engine.hpp"

namespace perimode {
namespace {

/// Modes that one shift inside the spectrum is asked for at most.
constexpr Offset most_per_shift = 100;

/// A stretch of the spectrum and how many eigenvalues lie below its ends.
struct Stretch {
  double lower = 0.0, upper = 0.0;
  Offset below_lower = 0, below_upper = 0;
  [[nodiscard]] Offset count() const { return below_upper - below_lower; }
};

/// No eigenvalue lies above: the largest row sum of |M^-1/2 K M^-1/2| [Gershgorin].
double spectrum_bound(const EigenProblem& problem) {
  const Csr& k = *problem.stiffness;
  const Eigen::VectorXd root = problem.mass->cwiseSqrt();
  double largest = 0.0;
  for (Index i = 0; i < k.rows; ++i) {
    double sum = 0.0;
    for (Offset e = k.row_start[i]; e < k.row_start[i + 1]; ++e)
      sum += std::abs(k.value[e]) / (root[i] * root[k.column[e]]);
    largest = std::max(largest, sum);
  }
  return largest;
}

/// The largest eigenvalue from below, to about a part in a thousand: Lanczos on M^-1/2 K M^-1/2.
double largest_estimate(const EigenProblem& problem, std::uint64_t seed) {
  constexpr int steps = 40, block = 1;
  SpectralTransform op =
      shift_invert(0.0, true, problem.mass->cwiseSqrt().cwiseInverse(),
                   [&](const MatrixView& b) { return multiply(*problem.stiffness, Eigen::MatrixXd(b)); });
  const Eigen::MatrixXd nothing(op.size(), 0);
  BlockKrylov space(op, nothing, nothing, block, (steps + 2) * block, seed);
  for (int step = 0; step < steps && space.step(); ++step) continue;
  return std::abs(space.ritz().theta[0]);
}

/// What the searches of one request share.
struct Interior {
  const EigenProblem& problem;
  const EigenOptions& options;
  const Sink& sink;
  Eigen::MatrixXd known;
  std::vector<Index> order;
  EigenResult& result;

  /// Runs a search around sigma; moves sigma by 1e-7 of itself when it hits an eigenvalue.
  SearchResult around(double sigma, const Wanted& wanted) const {
    const Stopwatch factorisation;
    constexpr double nudge = 1e-7;
    for (int trial = 0;; ++trial) {
      const IndefiniteFactor factor(*problem.stiffness, sigma, *problem.mass, order);
      result.factor_nonzeros = factor.nonzeros();
      SpectralTransform op = shift_invert(sigma, false, problem.mass->cwiseSqrt(),
                                          [&](const MatrixView& b) { return factor.solve(b); });
      // A vector without symmetries, so that it has a part along whatever mode sigma may have hit.
      const Eigen::VectorXd probe =
          Eigen::VectorXd::LinSpaced(op.size(), 1.0, static_cast<double>(op.size())).array().square().sin();
      const Eigen::MatrixXd image = op.apply(probe);
      constexpr double blow_up = 1e9;
      const bool regular =
          image.allFinite() && image.norm() * std::abs(sigma) < blow_up * std::sqrt(op.size());
      if (!regular && trial < 3) {
        sigma *= 1.0 + nudge;
        continue;
      }
      result.seconds_factor += factorisation.seconds();
      const Stopwatch iteration;
      SearchResult found = search(op, known, wanted, search_settings(options, problem.stiffness->rows),
                                  search_method(options), sink);
      result.seconds_iterate += iteration.seconds();
      result.solves += static_cast<int>(op.applied);
      result.restarts += found.pairs.restarts;
      result.shift = sigma;
      return found;
    }
  }

  /// Eigenvalues below sigma; K >= 0 leaves none below zero.
  [[nodiscard]] Offset below(double sigma) const {
    return sigma <= 0.0 ? 0 : count_below(problem, sigma, order);
  }
  /// A shift with the same nearest modes. From above the spectrum these are the largest, from wherever,
  /// but from far away their distances are all but equal and the iteration has no gap to work with.
  [[nodiscard]] double brought_near(double sigma) const {
    const double close = 1.003 * largest_estimate(problem, options.seed);
    if (sigma <= close) return sigma;
    if (below(close) == problem.stiffness->rows) return close;
    return std::min(sigma, 1.001 * spectrum_bound(problem));
  }
  /// Of them, how many the caller knows: all (they are null vectors) or none.
  [[nodiscard]] Offset known_below(double sigma) const { return sigma <= 0.0 ? 0 : known.cols(); }

  /// All modes of a stretch side by side, in pieces that one shift can serve.
  [[nodiscard]] Eigen::MatrixXd collect(const Stretch& stretch, bool& clean) const {
    if (stretch.count() == 0) return {problem.mass->size(), 0};
    const double width = stretch.upper - stretch.lower;
    // Off the middle: cases of round numbers like to have eigenvalues there.
    const double inside = stretch.lower + 0.4871 * width;
    if (stretch.count() > most_per_shift && width > 1e-6 * stretch.upper) {
      const Offset half = below(inside);
      return beside(collect({stretch.lower, inside, stretch.below_lower, half}, clean),
                    collect({inside, stretch.upper, half, stretch.below_upper}, clean));
    }
    const SearchResult found = around(inside, {.count = 0, .floor = 1.0 / (stretch.upper - inside)});
    if (!found.clean) {
      clean = false;
      result.message = found.message;
    }
    std::vector<Eigen::Index> pick;
    for (Eigen::Index i = 0; i < found.pairs.theta.size(); ++i) {
      const double value = result.shift + 1.0 / found.pairs.theta[i];
      if (value >= stretch.lower && value < stretch.upper) pick.push_back(i);
    }
    return found.pairs.vector(Eigen::all, pick);
  }

  void conclude(Offset counted, double at, double seconds) const {
    Certificate& certificate = result.certificate;
    certificate = {.asked = options.check != CompletenessCheck::none,
                   .method = "inertia",
                   .count = counted,
                   .at = at,
                   .seconds = seconds};
    certificate.complete = counted == result.value.size();
    result.status = certificate.complete ? EigenStatus::converged : EigenStatus::not_certified;
    if (!certificate.complete)
      result.message = "found " + std::to_string(result.value.size()) + " modes where inertia counts " +
                       std::to_string(counted);
  }
};

}  // namespace

EigenResult solve_range(const EigenProblem& problem, const EigenOptions& options, const Sink& sink) {
  EigenResult out;
  const Stopwatch analysis;
  Interior interior{problem, options, sink, known_directions(problem), elimination_order(problem), out};
  out.engine = method_name(options);
  out.seconds_analyse = analysis.seconds();

  // An end that is an eigenvalue to round-off belongs to the range.
  const double slack = 1e-9 * std::max(std::abs(options.lower), std::abs(options.upper));
  Stretch stretch{.lower = options.lower - slack, .upper = options.upper + slack};
  const Stopwatch counting;
  sink.report("counting");
  stretch.below_lower = interior.below(stretch.lower) - interior.known_below(stretch.lower);
  stretch.below_upper = interior.below(stretch.upper) - interior.known_below(stretch.upper);
  const double seconds = counting.seconds();
  const Offset count = stretch.count();
  const Index n = problem.stiffness->rows;

  constexpr Index dense_rows = 4000;
  constexpr Offset near_bottom = 20;
  if (count > n / 4 && n <= dense_rows) return solve_dense(problem, options);
  if (count > 0 && stretch.below_lower <= std::max(near_bottom, count) &&
      stretch.below_upper <= 4 * most_per_shift) {
    // Near the bottom a positive definite factor finds them, and those below, at less cost.
    EigenOptions lowest = options;
    lowest.has_range = false;
    lowest.count = static_cast<int>(stretch.below_upper);
    lowest.check = CompletenessCheck::none;
    out = solve_lowest(problem, lowest, sink);
    if (out.status == EigenStatus::not_converged) return out;
    const Eigen::Index first = (out.value.array() < stretch.lower).count();
    keep(out, first, (out.value.array() <= stretch.upper).count() - first);
  } else {
    bool clean = true;
    rayleigh_ritz(problem, interior.collect(stretch, clean), out);
    if (!clean) return out;
  }
  interior.conclude(count, options.upper, seconds);
  return out;
}

EigenResult solve_nearest(const EigenProblem& problem, const EigenOptions& options, const Sink& sink) {
  EigenResult out;
  const Stopwatch analysis;
  Interior interior{problem, options, sink, known_directions(problem), elimination_order(problem), out};
  out.engine = method_name(options);
  out.seconds_analyse = analysis.seconds();
  const Eigen::Index room = problem.mass->size() - interior.known.cols();
  const double shift = interior.brought_near(options.shift);
  const SearchResult found = interior.around(shift, {.count = std::min<Eigen::Index>(options.count, room)});
  rayleigh_ritz(problem, found.pairs.vector, out);
  if (!found.clean) {
    out.message = found.message;
    return out;
  }
  if (options.check == CompletenessCheck::none) {
    out.certificate = {.asked = false, .method = "none"};
    out.status = EigenStatus::converged;
  } else {
    const Stopwatch counting;
    const double reach = 1.0 / found.cut;
    const double lower = out.shift - reach, upper = out.shift + reach;
    const Offset counted = interior.below(upper) - interior.known_below(upper) - interior.below(lower) +
                           interior.known_below(lower);
    interior.conclude(counted, upper, counting.seconds());
  }
  // The nearest `count`, ascending.
  std::vector<Eigen::Index> pick(out.value.size());
  std::iota(pick.begin(), pick.end(), 0);
  const auto distance = [&](Eigen::Index i) { return std::abs(out.value[i] - shift); };
  std::stable_sort(pick.begin(), pick.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return distance(a) < distance(b); });
  pick.resize(std::min<std::size_t>(pick.size(), options.count));
  std::sort(pick.begin(), pick.end());
  out.value = out.value(pick).eval();
  out.vector = out.vector(Eigen::all, pick).eval();
  return out;
}

}  // namespace perimode
