// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "block_krylov.hpp"
#include "search.hpp"

namespace perimode {
namespace {

/// The converged leading Ritz pairs and what bounds the rest, or nothing yet.
struct Verdict {
  bool done = false;
  Eigen::Index count = 0;
  double next = 0.0;
};

Verdict judge(const BlockKrylov& space, const BlockKrylov::Ritz& ritz, const SpectralTransform& op,
              const Wanted& wanted, double tolerance) {
  const Eigen::Index columns = ritz.theta.size();
  const auto size = [&](Eigen::Index i) { return std::abs(ritz.theta[i]); };
  const auto good = [&](Eigen::Index i) {
    return is_converged(op, ritz.theta[i], ritz.residual[i], size(0), tolerance);
  };
  Verdict out;
  if (wanted.floor > 0.0) {
    while (out.count < columns && size(out.count) >= wanted.floor) ++out.count;
  } else {
    out.count = std::min(wanted.count, columns);
    if (out.count < wanted.count && !space.used_up()) return out;
    while (out.count < columns && same_cluster(op, ritz.theta[out.count - 1], ritz.theta[out.count]))
      ++out.count;
  }
  for (Eigen::Index i = 0; i < out.count; ++i)
    if (!good(i)) return out;
  if (space.used_up()) {
    out.next = out.count < columns ? size(out.count) : 0.0;
    out.done = true;
    return out;
  }
  if (out.count == columns) return out;
  // The next Ritz value must be settled enough to tell it from the last wanted one (or the floor).
  const double above = wanted.floor > 0.0 ? wanted.floor : size(out.count - 1);
  const double uncertain = ritz.residual[out.count];
  out.next = size(out.count) + uncertain;
  out.done = uncertain <= 0.25 * (above - size(out.count));
  return out;
}

/// Basis size at which the iteration restarts; about what 20 to 60 modes need without a restart.
int most_columns(const Wanted& wanted, const SearchSettings& settings, int block, Eigen::Index n) {
  const Eigen::Index columns =
      settings.columns > 0 ? settings.columns : std::max<Eigen::Index>(2 * wanted.count + 10 * block, 140);
  return static_cast<int>(std::min(columns, n + 2 * block));
}

}  // namespace

bool same_cluster(const SpectralTransform& op, double theta, double other) {
  const double a = op.distance(theta), b = op.distance(other);
  return std::abs(a - b) <= 1e-6 * std::max(a, b) + 1e-9 * std::abs(op.sigma);
}

bool is_converged(const SpectralTransform& op, double theta, double residual, double largest,
                  double tolerance) {
  const double scale =
      std::max(std::abs(op.eigenvalue(theta)), 1e-3 * op.distance(theta));  // lambda near 0: a mechanism
  double wanted = tolerance * scale * op.slope(theta);
  // A rough part e of the vector is theta e in the residual, and up to top e in that of A.
  constexpr double rough = 10.0;
  if (op.top > 0.0) wanted = std::min(wanted, rough * tolerance * scale * theta / op.top);
  return residual <= std::max(wanted, op.round_off * largest);
}

EigenPairs block_lanczos(SpectralTransform& op, const Eigen::MatrixXd& deflated, const Eigen::MatrixXd& start,
                         const Wanted& wanted, const SearchSettings& settings) {
  const Eigen::Index room = op.size() - deflated.cols();
  EigenPairs out;
  if (room <= 0) {
    out.converged = true;
    out.vector = out.rest.vector = out.rest.newest = Eigen::MatrixXd(op.size(), 0);
    return out;
  }
  const int block = static_cast<int>(std::min<Eigen::Index>(settings.block, room));
  BlockKrylov space(op, deflated, start, block, most_columns(wanted, settings, block, room), settings.seed);
  for (;;) {
    const bool more = space.step();
    if (more && space.columns() < wanted.count && !space.full()) continue;
    const BlockKrylov::Ritz ritz = space.ritz();
    const Verdict verdict = judge(space, ritz, op, wanted, settings.tolerance);
    out.converged = verdict.done;
    const bool given_up = !verdict.done && settings.give_up && settings.give_up(ritz.theta);
    if (verdict.done || !more || given_up || out.restarts == settings.most_restarts) {
      const Eigen::Index count = std::min<Eigen::Index>(verdict.count, ritz.theta.size());
      out.theta = ritz.theta.head(count);
      out.vector = space.purified(ritz, count);
      out.next = verdict.next;
      out.rest = space.neighbourhood(ritz, count, ritz.theta.size() - count);
      return out;
    }
    if (space.full()) {
      // Keep the wanted ones and half of the others: they speed up what is still converging.
      const Eigen::Index kept = std::min<Eigen::Index>(space.columns() - 2 * block,
                                                       verdict.count + (space.columns() - verdict.count) / 2);
      space.restart(ritz, std::max<Eigen::Index>(kept, block));
      ++out.restarts;
    }
  }
}

}  // namespace perimode
