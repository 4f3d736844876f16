// SPDX-License-Identifier: BSD-3-Clause
#include "block_krylov.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace perimode {

Eigen::MatrixXd random_columns(Eigen::Index rows, Eigen::Index count, std::mt19937_64& random) {
  // Box-Muller on the generator's own bits: the same numbers with every standard library.
  const auto uniform = [&] { return (static_cast<double>(random() >> 11) + 0.5) * 0x1.0p-53; };
  Eigen::MatrixXd out(rows, count);
  constexpr double two_pi = 6.283185307179586;
  for (Eigen::Index k = 0; k < out.size(); ++k)
    out.data()[k] = std::sqrt(-2.0 * std::log(uniform())) * std::cos(two_pi * uniform());
  return out;
}

BlockKrylov::BlockKrylov(SpectralTransform& op, const Eigen::MatrixXd& deflated, const Eigen::MatrixXd& start,
                         int block, int most_columns, std::uint64_t seed)
    : op_(op),
      deflated_(deflated),
      block_(block),
      most_columns_(std::max(most_columns, 4 * block)),
      random_(seed),
      basis_(op.size(), most_columns_ + block) {
  Eigen::MatrixXd first(op.size(), block);
  const Eigen::Index given = std::min<Eigen::Index>(start.cols(), block);
  if (given > 0) first.leftCols(given) = start.leftCols(given);
  first.rightCols(block - given) = random_columns(op.size(), block - given, random_);
  for (int pass = 0; pass < 2; ++pass) {
    first.colwise().normalize();
    project_out(first, 0);
  }
  (void)take_in(first, 0, 1.0);
}

BlockKrylov::BlockKrylov(SpectralTransform& op, const Eigen::MatrixXd& deflated, const Neighbourhood& held,
                         int extra, int more_columns, std::uint64_t seed)
    : op_(op),
      deflated_(deflated),
      block_(static_cast<int>(held.newest.cols()) + extra),
      most_columns_(static_cast<int>(held.theta.size()) + std::max(more_columns, 4 * block_)),
      random_(seed),
      basis_(op.size(), most_columns_ + block_),
      h_(held.theta.asDiagonal()),
      known_(held.theta.size()) {
  if (known_ > 0) basis_.leftCols(known_) = held.vector;
  Eigen::MatrixXd first(op.size(), block_);
  if (held.newest.cols() > 0) first.leftCols(held.newest.cols()) = held.newest;
  first.rightCols(extra) = random_columns(op.size(), extra, random_);
  for (int pass = 0; pass < 2; ++pass) {
    first.colwise().normalize();
    project_out(first, known_);
  }
  const Eigen::MatrixXd factor = take_in(first, known_, 1.0);
  tail_ = Eigen::MatrixXd::Zero(next_, known_);
  if (held.tail.size() > 0) tail_ = product(factor.leftCols(held.newest.cols()), held.tail);
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): a Ref is a view, and fresh is written through it
void BlockKrylov::project_out(Eigen::Ref<Eigen::MatrixXd> fresh, Eigen::Index used) const {
  add_product(-1.0, deflated_, transposed_product(deflated_, fresh), fresh);
  add_product(-1.0, basis_.leftCols(used), transposed_product(basis_.leftCols(used), fresh), fresh);
}

Eigen::MatrixXd BlockKrylov::take_in(const Eigen::MatrixXd& fresh, Eigen::Index used, double scale) {
  const Eigen::Index room = std::min<Eigen::Index>(op_.size() - deflated_.cols() - used, block_);
  const Eigen::Index width = fresh.cols();
  Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(std::max<Eigen::Index>(room, 0), width);
  constexpr double dependent = 1e-13;  // of |Op|: round-off of the products behind `fresh`
  constexpr double cancelled = 0.1;    // lost a digit or more: orthogonalise once again
  next_ = 0;
  for (Eigen::Index j = 0; j < width && next_ < room; ++j) {
    Eigen::VectorXd column = fresh.col(j);
    double length = column.norm();
    for (int pass = 0; pass < 4 && length > dependent * scale; ++pass) {
      const double before = length;
      const auto done = basis_.middleCols(used, next_);
      const Eigen::VectorXd part = done.transpose() * column;
      column.noalias() -= done * part;
      factor.col(j).head(next_) += part;
      length = column.norm();
      if (length > cancelled * before) break;
      project_out(column, used);
      length = column.norm();
    }
    if (length <= dependent * scale) continue;
    factor(next_, j) = length;
    basis_.col(used + next_++) = column / length;
  }
  // A dependent block means an invariant subspace: go on from random directions.
  constexpr int most_trials = 20;
  for (int trial = 0; next_ < room && trial < most_trials; ++trial) {
    Eigen::MatrixXd column = random_columns(op_.size(), 1, random_).normalized();
    for (int pass = 0; pass < 3; ++pass) project_out(column, used + next_);
    const double length = column.norm();
    // What is left of a random unit vector in a space of few remaining dimensions is about
    // sqrt(remaining / n), far above round-off.
    if (length <= 1e-10) continue;
    column /= length;
    project_out(column, used + next_);
    basis_.col(used + next_++) = column / column.norm();
  }
  return factor.topRows(next_);
}

bool BlockKrylov::step() {
  if (next_ == 0) return false;
  const Eigen::Index width = next_, used = known_ + width;
  Eigen::MatrixXd fresh = op_.apply(newest());
  Eigen::MatrixXd h = Eigen::MatrixXd::Zero(used, used);
  h.topLeftCorner(known_, known_) = h_;
  // Op is symmetric: apart from round-off the image reaches only the columns that the last step coupled, the
  // previous block as a rule. Those are taken out first, so that one pass over everything then suffices.
  for (const Eigen::Index first : {coupled_, Eigen::Index{0}}) {
    const auto columns = basis_.middleCols(first, used - first);
    const Eigen::MatrixXd part = transposed_product(columns, fresh);
    add_product(-1.0, columns, part, fresh);
    h.rightCols(width).bottomRows(used - first) += part;
  }
  add_product(-1.0, deflated_, transposed_product(deflated_, fresh), fresh);
  h.bottomLeftCorner(width, known_) = h.topRightCorner(known_, width).transpose();
  const Eigen::MatrixXd corner = h.bottomRightCorner(width, width);
  h.bottomRightCorner(width, width) = 0.5 * (corner + corner.transpose());
  h_ = std::move(h);
  known_ = used;
  coupled_ = used - width;
  const Eigen::MatrixXd factor = take_in(fresh, used, h_.cwiseAbs().maxCoeff());
  tail_ = Eigen::MatrixXd::Zero(next_, known_);
  tail_.rightCols(width) = factor;
  return next_ > 0;
}

BlockKrylov::Ritz BlockKrylov::ritz() const {
  Eigen::MatrixXd vector = h_;
  const Eigen::VectorXd value = symmetric_eigen(vector);
  std::vector<Eigen::Index> rank(value.size());
  std::iota(rank.begin(), rank.end(), 0);
  std::stable_sort(rank.begin(), rank.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return std::abs(value[a]) > std::abs(value[b]); });
  Ritz out;
  out.theta = value(rank);
  out.coefficient = vector(Eigen::all, rank);
  out.residual = Eigen::VectorXd::Zero(value.size());
  if (next_ > 0) out.residual = product(tail_, out.coefficient).colwise().norm();
  return out;
}

double BlockKrylov::radius_beyond(Eigen::Index first) const {
  const Eigen::Index count = known_ - first;
  if (count == 0) return 0.0;
  Eigen::MatrixXd part = h_.bottomRightCorner(count, count);
  return symmetric_eigen(part).cwiseAbs().maxCoeff();
}

Neighbourhood BlockKrylov::neighbourhood(const Ritz& ritz, Eigen::Index first, Eigen::Index count) const {
  return {.vector = vectors(ritz, first, count),
          .theta = ritz.theta.segment(first, count),
          .newest = newest(),
          .tail = product(tail_, ritz.coefficient.middleCols(first, count))};
}

Eigen::MatrixXd BlockKrylov::vectors(const Ritz& ritz, Eigen::Index first, Eigen::Index count) const {
  return product(basis_.leftCols(known_), ritz.coefficient.middleCols(first, count));
}

Eigen::MatrixXd BlockKrylov::purified(const Ritz& ritz, Eigen::Index count) const {
  Eigen::MatrixXd out = vectors(ritz, 0, count);
  if (next_ == 0) return out;
  const Eigen::MatrixXd scaled =
      product(tail_, ritz.coefficient.leftCols(count)) * ritz.theta.head(count).cwiseInverse().asDiagonal();
  add_product(1.0, newest(), scaled, out);
  return out;
}

void BlockKrylov::restart(const Ritz& ritz, Eigen::Index count) {
  const Eigen::MatrixXd kept = vectors(ritz, 0, count);
  const Eigen::MatrixXd residual = newest();
  basis_.leftCols(count) = kept;
  basis_.middleCols(count, next_) = residual;
  h_ = ritz.theta.head(count).asDiagonal();
  tail_ = product(tail_, ritz.coefficient.leftCols(count));
  known_ = count;
  coupled_ = 0;
}

}  // namespace perimode
