// SPDX-License-Identifier: BSD-3-Clause
#include "dense.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/stopwatch.hpp"
#include "dense_kernels.hpp"

namespace perimode {
namespace {

/// Positions of the wanted ones among ascending eigenvalues.
std::vector<Eigen::Index> choose(const Eigen::VectorXd& value, const EigenOptions& options) {
  std::vector<Eigen::Index> pick(value.size());
  std::iota(pick.begin(), pick.end(), 0);
  if (options.has_range) {
    const double slack = 1e-9 * std::max(std::abs(options.lower), std::abs(options.upper));
    std::erase_if(pick, [&](Eigen::Index i) {
      return value[i] < options.lower - slack || value[i] > options.upper + slack;
    });
    return pick;
  }
  if (options.has_shift && value.size() > 0) {
    // From above the spectrum the nearest are the largest; a far shift would round distances away.
    const double shift = std::min(options.shift, value[value.size() - 1]);
    std::stable_sort(pick.begin(), pick.end(), [&](Eigen::Index a, Eigen::Index b) {
      return std::abs(value[a] - shift) < std::abs(value[b] - shift);
    });
  }
  pick.resize(std::min<std::size_t>(pick.size(), std::max(options.count, 0)));
  std::sort(pick.begin(), pick.end());
  return pick;
}

}  // namespace

EigenResult solve_dense(const EigenProblem& problem, const EigenOptions& options) {
  const auto begin = Clock::now();
  const Csr& k = *problem.stiffness;
  const Eigen::VectorXd root = problem.mass->cwiseSqrt();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(k.rows, k.rows);
  for (Index i = 0; i < k.rows; ++i)
    for (Offset e = k.row_start[i]; e < k.row_start[i + 1]; ++e)
      a(i, k.column[e]) = k.value[e] / (root[i] * root[k.column[e]]);
  const Eigen::Index known = problem.known != nullptr ? problem.known->cols() : 0;
  if (known > 0) {  // lift the known null vectors above everything else
    const Eigen::MatrixXd z = root.asDiagonal() * *problem.known;
    const double top = 2.0 * a.cwiseAbs().rowwise().sum().maxCoeff() + 1.0;
    add_product(top, z, z.transpose(), a);
  }
  const Eigen::VectorXd value = symmetric_eigen(a).head(k.rows - known);
  const std::vector<Eigen::Index> pick = choose(value, options);

  EigenResult out;
  out.engine = "dense";
  out.status = EigenStatus::converged;
  out.value = value(pick);
  out.vector = root.cwiseInverse().asDiagonal() * a(Eigen::all, pick);
  out.shift = options.has_shift ? options.shift : 0.0;
  const bool asked = options.check != CompletenessCheck::none;
  out.certificate = {.asked = asked,
                     .complete = true,
                     .method = "all modes",
                     .count = k.rows,
                     .at = value.size() > 0 ? value[value.size() - 1] : 0.0};
  out.seconds_iterate = seconds_since(begin);
  return out;
}

}  // namespace perimode
