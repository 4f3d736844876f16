// SPDX-License-Identifier: BSD-3-Clause
#include <arpack/arpack.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "block_krylov.hpp"
#include "perimode/core/error.hpp"
#include "search.hpp"

namespace perimode {
namespace {

// NOLINTNEXTLINE(performance-unnecessary-value-param): a Ref is a view, and x is written through it
void project_out(const Eigen::MatrixXd& deflated, Eigen::Ref<Eigen::MatrixXd> x) {
  for (int pass = 0; pass < 2; ++pass) add_product(-1.0, deflated, transposed_product(deflated, x), x);
}

/// Implicitly restarted Lanczos for the `count` largest |theta| of P Op P, P = I - deflated deflated^T,
/// to machine precision. Columns in the order ARPACK returns them; fewer if it stopped early.
Eigen::MatrixXd largest_vectors(SpectralTransform& op, const Eigen::MatrixXd& deflated, int count,
                                const SearchSettings& settings) {
  const auto n = static_cast<a_int>(op.size());
  const a_int columns = std::min<a_int>(n, std::max(2 * count + 1, 60));
  std::mt19937_64 random(settings.seed);
  Eigen::MatrixXd residual = random_columns(n, 1, random);
  project_out(deflated, residual);
  Eigen::MatrixXd basis(n, columns);
  std::vector<double> work(3 * static_cast<std::size_t>(n));
  std::vector<double> small(static_cast<std::size_t>(columns) * (columns + 8));
  a_int parameter[11] = {1, 0, settings.most_restarts, 1, 0, 0, 1, 0, 0, 0, 0};
  a_int pointer[14] = {};
  a_int ido = 0, info = 1;       // info = 1: start from our residual
  const double tolerance = 0.0;  // machine precision
  for (;;) {
    dsaupd_c(&ido, "I", n, "LM", count, tolerance, residual.data(), columns, basis.data(), n, parameter,
             pointer, work.data(), small.data(), static_cast<a_int>(small.size()), &info);
    if (ido != 1 && ido != -1) break;
    Eigen::MatrixXd y = op.apply(Eigen::Map<const Eigen::MatrixXd>(&work[pointer[0] - 1], n, 1));
    project_out(deflated, y);
    std::copy_n(y.data(), n, &work[pointer[1] - 1]);
  }
  if (info < 0)
    throw Error(ErrorKind::solver_failure, "ARPACK dsaupd failed with code " + std::to_string(info));
  if (parameter[4] < count) return {n, 0};
  std::vector<a_int> select(columns);
  Eigen::VectorXd theta(count);
  Eigen::MatrixXd vector(n, count);
  dseupd_c(1, "A", select.data(), theta.data(), vector.data(), n, 0.0, "I", n, "LM", count, tolerance,
           residual.data(), columns, basis.data(), n, parameter, pointer, work.data(), small.data(),
           static_cast<a_int>(small.size()), &info);
  if (info != 0)
    throw Error(ErrorKind::solver_failure, "ARPACK dseupd failed with code " + std::to_string(info));
  return vector;
}

/// The `count` largest pairs, whether or not a gap follows them, and the Ritz vectors beyond `wanted`
/// and its cluster.
EigenPairs largest_pairs(SpectralTransform& op, const Eigen::MatrixXd& deflated, int count,
                         Eigen::Index wanted, const SearchSettings& settings) {
  EigenPairs out;
  const Eigen::MatrixXd vector = largest_vectors(op, deflated, count, settings);
  out.vector = Eigen::MatrixXd(op.size(), 0);
  out.rest.vector = out.rest.newest = out.vector;
  if (vector.cols() == 0) return out;
  // One more inverse iteration for all vectors at once, then the pairs of their span.
  Eigen::MatrixXd image = op.apply(vector);
  project_out(deflated, image);
  Eigen::MatrixXd h = transposed_product(vector, image);
  h = 0.5 * (h + h.transpose()).eval();
  const Eigen::VectorXd theta = symmetric_eigen(h);
  std::vector<Eigen::Index> rank(theta.size());
  std::iota(rank.begin(), rank.end(), 0);
  std::stable_sort(rank.begin(), rank.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return std::abs(theta[a]) > std::abs(theta[b]); });
  const Eigen::VectorXd sorted = theta(rank);
  const Eigen::MatrixXd rotation = h(Eigen::all, rank);
  const Eigen::MatrixXd ritz = product(vector, rotation);
  image = product(image, rotation);
  const Eigen::VectorXd residual = (image - ritz * sorted.asDiagonal()).colwise().norm();
  Eigen::Index end = wanted;
  while (end < count && same_cluster(op, sorted[end - 1], sorted[end])) ++end;
  out.converged = true;
  for (Eigen::Index i = 0; i < end; ++i)
    out.converged =
        out.converged && is_converged(op, sorted[i], residual[i], std::abs(sorted[0]), settings.tolerance);
  out.theta = sorted.head(end);
  out.vector = (image * sorted.cwiseInverse().asDiagonal()).leftCols(end);
  out.next = end < count ? std::abs(sorted[end]) + residual[end] : std::abs(sorted[end - 1]);
  // Converged as far as round-off goes, so coupled to nothing.
  out.rest = {.vector = ritz.rightCols(count - end),
              .theta = sorted.tail(count - end),
              .newest = Eigen::MatrixXd(op.size(), 0),
              .tail = Eigen::MatrixXd(0, count - end)};
  return out;
}

}  // namespace

EigenPairs arpack(SpectralTransform& op, const Eigen::MatrixXd& deflated, const Eigen::MatrixXd& start,
                  const Wanted& wanted, const SearchSettings& settings) {
  const Eigen::Index room = op.size() - deflated.cols();
  // A few more than wanted, until the gap behind the last cluster comes into sight.
  for (Eigen::Index spare = 2;; spare *= 2) {
    const Eigen::Index count = wanted.count + spare;
    if (wanted.floor > 0.0 || count >= room)  // not what ARPACK can be asked for
      return block_lanczos(op, deflated, start, wanted, settings);
    EigenPairs out = largest_pairs(op, deflated, static_cast<int>(count), wanted.count, settings);
    if (!out.converged || out.theta.size() < count) return out;
  }
}

}  // namespace perimode
