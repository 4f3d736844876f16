// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/linalg/operator.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "block_krylov.hpp"

namespace perimode {

LinearOperator as_operator(const Csr& matrix) {
  return {matrix.rows, [&matrix](const double* x, double* y) {
            multiply(matrix, {x, static_cast<std::size_t>(matrix.cols)},
                     {y, static_cast<std::size_t>(matrix.rows)});
          }};
}

Eigen::VectorXd multiply(const LinearOperator& a, const Eigen::VectorXd& x) {
  Eigen::VectorXd y(a.size);
  a.apply(x.data(), y.data());
  return y;
}

Eigen::MatrixXd multiply(const LinearOperator& a, const Eigen::MatrixXd& x) {
  Eigen::MatrixXd y(a.size, x.cols());
  for (Eigen::Index j = 0; j < x.cols(); ++j) a.apply(x.col(j).data(), y.col(j).data());
  return y;
}

double asymmetry(const LinearOperator& a, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  double worst = 0.0;
  for (int trial = 0; trial < 3 && a.size > 0; ++trial) {
    const Eigen::MatrixXd x = random_columns(a.size, 2, random);
    const Eigen::MatrixXd ax = multiply(a, x);
    const double difference = std::abs(x.col(1).dot(ax.col(0)) - x.col(0).dot(ax.col(1)));
    const double scale = ax.col(0).norm() * x.col(1).norm() + ax.col(1).norm() * x.col(0).norm();
    if (scale > 0.0) worst = std::max(worst, difference / scale);
  }
  return worst;
}

}  // namespace perimode
