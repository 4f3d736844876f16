// SPDX-License-Identifier: BSD-3-Clause
#include "search.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "block_krylov.hpp"

namespace perimode {
namespace {

/// T_degree(x) for x >= 1.
double chebyshev(int degree, double x) { return std::cosh(degree * std::acosh(std::max(x, 1.0))); }

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
double trim_and_cut(const ShiftInvert& op, const Wanted& wanted, EigenPairs& pairs) {
  if (wanted.floor > 0.0) return wanted.floor;
  Eigen::Index end = std::min(wanted.count, pairs.theta.size());
  while (end > 0 && end < pairs.theta.size() && same_cluster(op, pairs.theta[end - 1], pairs.theta[end]))
    ++end;
  if (end == 0) return 0.0;
  if (end < pairs.theta.size()) {
    const Eigen::Index over = pairs.theta.size() - end;
    pairs.next = std::abs(pairs.theta[end]);
    pairs.neighbourhood = beside(pairs.vector.rightCols(over), pairs.neighbourhood);
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

Probe probe(ShiftInvert& op, const Eigen::MatrixXd& deflated, double cut, int block, std::uint64_t seed) {
  const Eigen::Index room = op.size() - deflated.cols();
  Probe out;
  out.found = Eigen::MatrixXd(op.size(), 0);
  if (room <= 0) return out;
  constexpr double shy = 0.1;
  const int width = static_cast<int>(std::min<Eigen::Index>(block, room));
  constexpr int most_steps = 40;
  BlockKrylov space(op, deflated, {}, width, (most_steps + 2) * width, seed);
  for (int degree = 0; degree < most_steps; ++degree) {  // degree of the polynomials in the space
    const bool more = space.step();
    const BlockKrylov::Ritz ritz = space.ritz();
    const double rho = std::abs(ritz.theta[0]);
    if (rho >= cut) {
      const Eigen::Index found = (ritz.theta.cwiseAbs().array() >= cut).count();
      out.clean = false;
      out.found = space.vectors(ritz, 0, found);
      return out;
    }
    if (!more) return out;
    const double x = op.positive ? 2.0 * cut / rho - 1.0 : cut / rho;
    const double growth = chebyshev(degree, x);
    if (growth * growth >= static_cast<double>(op.size()) / (shy * shy) * rho / (cut - rho)) return out;
  }
  return out;
}

void complete(ShiftInvert& op, const Eigen::MatrixXd& known, const Wanted& wanted,
              const SearchSettings& settings, SearchResult& result, const Sink& sink) {
  EigenPairs& pairs = result.pairs;
  SearchSettings again = settings;
  constexpr int most_rounds = 40, widest_block = 24;
  result.clean = false;
  for (int round = 0; round < most_rounds; ++round) {
    result.cut = trim_and_cut(op, wanted, pairs);
    ++again.seed;
    const Eigen::MatrixXd found = beside(known, pairs.vector);
    const Probe seen =
        probe(op, beside(found, pairs.neighbourhood), result.cut, std::max(4, again.block), again.seed);
    if (seen.clean) {
      result.clean = true;
      return;
    }
    sink.report("further copies");
    again.block = std::min(widest_block, 2 * again.block);
    EigenPairs fresh = block_lanczos(op, found, seen.found, {.count = 0, .floor = result.cut}, again);
    if (!fresh.converged) {
      result.message = "the search for further copies of repeated eigenvalues did not converge";
      return;
    }
    pairs.neighbourhood = std::move(fresh.neighbourhood);
    merge(pairs, fresh);
  }
  result.message = "modes kept turning up at or below the last one wanted";
}

SearchResult search(ShiftInvert& op, const Eigen::MatrixXd& known, const Wanted& wanted,
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
