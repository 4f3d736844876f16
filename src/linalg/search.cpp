// SPDX-License-Identifier: BSD-3-Clause
#include "search.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "sparse_engine.hpp"

namespace perimode {
namespace {

/// T_degree(x) for x >= 1.
double chebyshev(int degree, double x) { return std::cosh(degree * std::acosh(std::max(x, 1.0))); }

constexpr int least_width = 4;  ///< columns of a random block at least
constexpr int most_steps = 40;

/// Would a random block have shown an eigenvalue >= cut in a space of polynomials of this degree?
bool must_have_shown(const SpectralTransform& op, int degree, double rho, double cut) {
  constexpr double shy = 0.03;
  const double x = op.positive ? 2.0 * cut / rho - 1.0 : cut / rho;
  const double growth = chebyshev(degree, x);
  return rho < cut && growth * growth >= static_cast<double>(op.size()) / (shy * shy) * rho / (cut - rho);
}

/// The bound on |B| below which nothing at or above the cut is left, see Probe; <= 0: there is none.
double cut_beside(const Neighbourhood& held, double cut) {
  if (held.theta.size() == 0) return cut;
  const Eigen::VectorXd distance = cut - held.theta.cwiseAbs().array();
  if (distance.minCoeff() <= 0.0) return 0.0;
  if (held.newest.cols() == 0) return cut;
  const Eigen::MatrixXd scaled = held.tail * distance.cwiseSqrt().cwiseInverse().asDiagonal();
  Eigen::MatrixXd coupling = scaled * scaled.transpose();
  return cut - symmetric_eigen(coupling).maxCoeff();
}

/// The probe with the held vectors in the space. An eigenvector (w, u) with |theta| >= cut > |B| has
/// u = (theta - B)^-1 v s, which the powers of B on v approach as fast as the random columns show an
/// eigenvalue of B itself; a small residual of the largest Ritz pair settles the rest.
Probe coupled_probe(SpectralTransform& op, const Eigen::MatrixXd& deflated, Neighbourhood& held, double cut,
                    int width, std::uint64_t seed) {
  Probe out;
  out.found = Eigen::MatrixXd(op.size(), 0);
  const Eigen::Index inside = held.theta.size();
  const Eigen::Index room = op.size() - deflated.cols() - inside;
  const int extra = static_cast<int>(std::min<Eigen::Index>(width, room - held.newest.cols()));
  const int block = static_cast<int>(held.newest.cols()) + extra;
  BlockKrylov space(op, deflated, held, extra, (most_steps + 2) * block, seed);
  for (int degree = 0;; ++degree) {
    const bool more = space.step();
    const BlockKrylov::Ritz ritz = space.ritz();
    const double largest = std::abs(ritz.theta[0]);
    if (largest >= cut) {
      out.found = space.vectors(ritz, 0, (ritz.theta.cwiseAbs().array() >= cut).count());
      return out;
    }
    const bool settled = ritz.residual[0] <= 0.25 * (cut - largest) &&
                         must_have_shown(op, degree, space.radius_beyond(inside), cut);
    out.clean = !more || settled;
    if (out.clean) return out;
    if (degree + 1 == most_steps) {
      constexpr Eigen::Index most_held = 400;
      held = space.neighbourhood(ritz, 0, std::min(most_held, ritz.theta.size()));
      return out;
    }
  }
}

/// Modified Gram-Schmidt by blocks: b orthonormal and orthogonal to a. Purified vectors of separate
/// runs are orthogonal to about their residuals only; this makes it exact.
void orthonormalise_against(const Eigen::MatrixXd& a, Eigen::MatrixXd& b) {
  for (int pass = 0; pass < 2; ++pass) {
    add_product(-1.0, a, transposed_product(a, b), b);
    Eigen::MatrixXd gram = transposed_product(b, b);
    const Eigen::VectorXd value = symmetric_eigen(gram);
    b = product(b, gram * value.cwiseSqrt().cwiseInverse().asDiagonal() * gram.transpose());
  }
}

/// Joins new pairs to old ones, largest first.
void merge(EigenPairs& all, EigenPairs& fresh) {
  if (fresh.theta.size() == 0) return;
  orthonormalise_against(all.vector, fresh.vector);
  Eigen::VectorXd theta(all.theta.size() + fresh.theta.size());
  theta << all.theta, fresh.theta;
  std::vector<Eigen::Index> rank(theta.size());
  std::iota(rank.begin(), rank.end(), 0);
  std::stable_sort(rank.begin(), rank.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return std::abs(theta[a]) > std::abs(theta[b]); });
  const Eigen::MatrixXd vector = beside(all.vector, fresh.vector);
  all.vector = vector(Eigen::all, rank);
  all.theta = theta(rank);
  all.next = std::max(all.next, fresh.next);
  all.restarts += fresh.restarts;
}

/// Drops what lies beyond the cluster of the last wanted pair and returns the cut: the middle of
/// the gap that follows.
double trim_and_cut(const SpectralTransform& op, const Wanted& wanted, EigenPairs& pairs) {
  if (wanted.floor > 0.0) return wanted.floor;
  Eigen::Index end = std::min(wanted.count, pairs.theta.size());
  while (end > 0 && end < pairs.theta.size() && same_cluster(op, pairs.theta[end - 1], pairs.theta[end]))
    ++end;
  if (end == 0) return 0.0;
  if (end < pairs.theta.size()) {
    const Eigen::Index over = pairs.theta.size() - end;
    pairs.next = std::abs(pairs.theta[end]);
    Neighbourhood& rest = pairs.rest;
    rest.vector = beside(pairs.vector.rightCols(over), rest.vector);
    Eigen::VectorXd theta(over + rest.theta.size());
    theta << pairs.theta.tail(over), rest.theta;
    rest.theta = std::move(theta);
    rest.tail = beside(Eigen::MatrixXd::Zero(rest.newest.cols(), over), rest.tail);
    pairs.vector.conservativeResize(Eigen::NoChange, end);
    pairs.theta.conservativeResize(end);
  }
  return 0.5 * (std::abs(pairs.theta[end - 1]) + pairs.next);
}

}  // namespace

Eigen::MatrixXd beside(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXd out(std::max(a.rows(), b.rows()), a.cols() + b.cols());
  if (a.cols() > 0) out.leftCols(a.cols()) = a;
  if (b.cols() > 0) out.rightCols(b.cols()) = b;
  return out;
}

Probe probe(SpectralTransform& op, const Eigen::MatrixXd& deflated, Neighbourhood& held, double cut,
            int block, std::uint64_t seed) {
  Probe out;
  out.found = Eigen::MatrixXd(op.size(), 0);
  const Eigen::Index room = op.size() - deflated.cols() - held.vector.cols();
  const int width = static_cast<int>(std::min<Eigen::Index>(std::max(block, least_width), room));
  const double lowered = cut_beside(held, cut);
  if (lowered > 0.0) {
    if (room <= 0) {
      out.clean = true;
      return out;
    }
    const Eigen::MatrixXd all = beside(deflated, held.vector);
    BlockKrylov space(op, all, Eigen::MatrixXd(op.size(), 0), width, (most_steps + 2) * width, seed);
    for (int degree = 0; degree < most_steps; ++degree) {  // degree of the polynomials in the space
      const bool more = space.step();
      const BlockKrylov::Ritz ritz = space.ritz();
      const double rho = std::abs(ritz.theta[0]);
      if (rho >= cut) {
        out.found = space.vectors(ritz, 0, (ritz.theta.cwiseAbs().array() >= cut).count());
        return out;
      }
      if (rho >= lowered) break;
      if (!more || must_have_shown(op, degree, rho, lowered)) {
        out.clean = true;
        return out;
      }
    }
  }
  return coupled_probe(op, deflated, held, cut, width, seed);
}

void complete(SpectralTransform& op, const Eigen::MatrixXd& known, const Wanted& wanted,
              const SearchSettings& settings, SearchResult& result, const Sink& sink) {
  EigenPairs& pairs = result.pairs;
  SearchSettings again = settings;
  constexpr int most_rounds = 40, widest_block = 24;
  result.clean = false;
  for (int round = 0; round < most_rounds; ++round) {
    result.cut = trim_and_cut(op, wanted, pairs);
    ++again.seed;
    const Eigen::MatrixXd found = beside(known, pairs.vector);
    const Stopwatch probing;
    const Offset applied = op.applied;
    const Probe seen = probe(op, found, pairs.rest, result.cut, again.block, again.seed);
    if (seen.clean) {
      result.probe_seconds = probing.seconds();
      result.probe_columns = op.applied - applied;
      result.clean = true;
      return;
    }
    if (seen.found.cols() == 0) continue;
    sink.report("further copies");
    again.block = std::min(widest_block, 2 * again.block);
    if (again.columns == 0) again.columns = std::max(140, 10 * again.block);
    bool cramped = false;  // more copies than half of the basis
    again.give_up = [&](const Eigen::VectorXd& theta) {
      const Eigen::Index above = (theta.cwiseAbs().array() >= result.cut).count();
      cramped = 2 * above > again.columns && again.columns < op.size() - found.cols();
      return cramped;
    };
    EigenPairs fresh = block_lanczos(op, found, seen.found, {.count = 0, .floor = result.cut}, again);
    while (cramped) {
      cramped = false;
      again.columns *= 2;
      fresh = block_lanczos(op, found, seen.found, {.count = 0, .floor = result.cut}, again);
    }
    if (!fresh.converged) {
      result.message = "the search for further copies of repeated eigenvalues did not converge";
      return;
    }
    pairs.rest = std::move(fresh.rest);
    merge(pairs, fresh);
  }
  result.message = "modes kept turning up at or below the last one wanted";
}

SearchResult search(SpectralTransform& op, const Eigen::MatrixXd& known, const Wanted& wanted,
                    const SearchSettings& settings, const Method& method, const Sink& sink) {
  SearchResult out;
  sink.report("modes");
  out.pairs = method(op, known, Eigen::MatrixXd(op.size(), 0), wanted, settings);
  if (out.pairs.converged)
    complete(op, known, wanted, settings, out, sink);
  else
    out.message = "the iteration did not converge";
  return out;
}

}  // namespace perimode
