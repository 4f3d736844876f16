// SPDX-License-Identifier: BSD-3-Clause
#include "chebyshev.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "block_krylov.hpp"
#include "fused.hpp"
#include "vector_kernels.hpp"

namespace perimode {
namespace {

/// next = a x - w kx - before, where `next` is `before`'s place.
PERIMODE_EVERY_PROCESSOR
void recurrence(Index n, double a, const double* __restrict w, const double* __restrict x,
                const double* __restrict kx, double* __restrict before) {
  for (Index i = 0; i < n; ++i) before[i] = (a * x[i] - w[i] * kx[i]) - before[i];
}

/// next = (a x - w kx) / 2
PERIMODE_EVERY_PROCESSOR
void first_step(Index n, double a, const double* __restrict w, const double* __restrict x,
                const double* __restrict kx, double* __restrict next) {
  for (Index i = 0; i < n; ++i) next[i] = 0.5 * (a * x[i] - w[i] * kx[i]);
}

struct Filter {
  const LinearOperator* stiffness = nullptr;
  Eigen::VectorXd root;   ///< M^1/2
  Eigen::VectorXd twice;  ///< 2 beta M^-1 with z = alpha - beta lambda
  double alpha = 0.0;
  int degree = 1;
  double scale = 1.0;  ///< 1 / (T_d(z(0)) + 1)

  /// One column: x = M^-1/2 y, then the recurrence t_{k+1} = 2 z(M^-1 K) t_k - t_{k-1}.
  void apply(const double* y, double* out, std::vector<Eigen::VectorXd>& work) const {
    const auto n = static_cast<Index>(root.size());
    double* before = work[0].data();
    double* now = work[1].data();
    double* image = work[2].data();
    const double* w = twice.data();
    for_each_chunk(n, [&](Index i, Index count) {
      for (Index k = i; k < i + count; ++k) before[k] = y[k] / root[k];
    });
    stiffness->apply(before, image);
    for_each_chunk(n, [&](Index i, Index count) {
      first_step(count, 2.0 * alpha, w + i, before + i, image + i, now + i);
    });
    for (int k = 1; k < degree; ++k) {
      stiffness->apply(now, image);
      for_each_chunk(n, [&](Index i, Index count) {
        recurrence(count, 2.0 * alpha, w + i, now + i, image + i, before + i);
      });
      std::swap(before, now);
    }
    for_each_chunk(n, [&](Index i, Index count) {
      for (Index k = i; k < i + count; ++k) out[k] = scale * (root[k] * now[k] + y[k]);
    });
  }
};

}  // namespace

double spectrum_top(const LinearOperator& stiffness, const Eigen::VectorXd& mass, std::uint64_t seed,
                    int steps) {
  const Eigen::VectorXd root = mass.cwiseSqrt();
  SpectralTransform op;
  op.rows = mass.size();
  op.image = [&](const MatrixView& y) -> Eigen::MatrixXd {
    const Eigen::MatrixXd x = root.cwiseInverse().asDiagonal() * y;
    return root.cwiseInverse().asDiagonal() * multiply(stiffness, x);
  };
  const Eigen::MatrixXd nothing(op.size(), 0);
  BlockKrylov space(op, nothing, nothing, 1, steps + 2, seed);
  for (int step = 0; step < steps && space.step(); ++step) continue;
  const BlockKrylov::Ritz ritz = space.ritz();
  return ritz.theta[0] + ritz.residual.maxCoeff();
}

int filter_degree(double edge, double top) {
  // z(0) = (1 + q) / (1 - q), q = edge / top, and T_d(z(0)) = cosh(d acosh(z(0))).
  const double q = std::min(edge / top, 0.5);
  const double growth = std::acosh((1.0 + q) / (1.0 - q));
  constexpr double lift = 40.0;
  return std::max(1, static_cast<int>(std::ceil(std::acosh(lift) / growth)));
}

SpectralTransform chebyshev_filter(const LinearOperator& stiffness, const Eigen::VectorXd& mass, double edge,
                                   double top, int degree) {
  const double beta = 2.0 / (top - edge);
  Filter filter;
  filter.stiffness = &stiffness;
  filter.root = mass.cwiseSqrt();
  filter.twice = 2.0 * beta * mass.cwiseInverse();
  filter.alpha = (top + edge) / (top - edge);
  filter.degree = degree;
  const double d = degree;
  filter.scale = 1.0 / (std::cosh(d * std::acosh(filter.alpha)) + 1.0);

  SpectralTransform op;
  op.rows = mass.size();
  op.sigma = -0.1 * edge;
  op.positive = true;
  op.round_off = 2e-16 * (20.0 + d);
  op.top = top;
  const double scale = filter.scale;
  const double alpha = filter.alpha;
  const auto argument =
      [=](double theta) {  // z with T_d(z) = theta / scale - 1, continued monotonously below 1
        const double t = theta / scale - 1.0;
        return t > 1.0 ? std::cosh(std::acosh(t) / d) : t;
      };
  op.to_eigenvalue = [=](double theta) { return (alpha - argument(theta)) / beta; };
  op.slope = [=](double theta) {
    const double z = argument(theta);
    if (z <= 1.0) return scale * beta;
    return scale * beta * d * std::sinh(d * std::acosh(z)) / std::sqrt(z * z - 1.0);
  };
  op.image = [filter = std::move(filter)](const MatrixView& y) -> Eigen::MatrixXd {
    Eigen::MatrixXd out(y.rows(), y.cols());
    std::vector<Eigen::VectorXd> work(3, Eigen::VectorXd(y.rows()));
    for (Eigen::Index j = 0; j < y.cols(); ++j) filter.apply(y.col(j).data(), out.col(j).data(), work);
    return out;
  };
  return op;
}

}  // namespace perimode
