// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Cholesky>
#include <cmath>

#include "sparse_engine.hpp"

namespace perimode {

SearchSettings search_settings(const EigenOptions& options, Index rows) {
  // A large factor streams from memory, and a pass over it for eight vectors costs little more than for four.
  constexpr Index streams_from = 20'000;
  const int block = rows < streams_from ? 4 : 8;
  return {.block = options.block_size > 0 ? options.block_size : block,
          .tolerance = options.tolerance,
          .seed = options.seed};
}

Method search_method(const EigenOptions& options) {
  return options.engine == EigenEngine::arpack ? arpack : block_lanczos;
}

const char* method_name(const EigenOptions& options) {
  return options.engine == EigenEngine::arpack ? "arpack" : "lanczos";
}

Eigen::MatrixXd known_directions(const EigenProblem& problem) {
  if (problem.known == nullptr) return {problem.mass->size(), 0};
  return problem.mass->cwiseSqrt().asDiagonal() * *problem.known;
}

void rayleigh_ritz(const EigenProblem& problem, const Eigen::MatrixXd& y, EigenResult& result) {
  const Eigen::MatrixXd x = problem.mass->cwiseSqrt().cwiseInverse().asDiagonal() * y;
  const Eigen::LLT<Eigen::MatrixXd> root(transposed_product(y, y));
  Eigen::MatrixXd h = transposed_product(x, multiply(action_of(problem), x));
  root.matrixL().solveInPlace(h);
  h = root.matrixL().solve(h.transpose()).eval();
  h = 0.5 * (h + h.transpose()).eval();
  result.value = symmetric_eigen(h);
  root.matrixU().solveInPlace(h);
  result.vector = product(x, h);
  for (Eigen::Index j = 0; j < result.vector.cols(); ++j)
    result.vector.col(j) /= std::sqrt(result.vector.col(j).cwiseAbs2().dot(*problem.mass));
}

void keep(EigenResult& result, Eigen::Index first, Eigen::Index count) {
  result.value = result.value.segment(first, count).eval();
  result.vector = result.vector.middleCols(first, count).eval();
}

}  // namespace perimode
