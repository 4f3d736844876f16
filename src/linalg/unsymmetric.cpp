// SPDX-License-Identifier: BSD-3-Clause
#include <lapacke.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>
#include <string>
#include <vector>

#include "arnoldi.hpp"
#include "perimode/core/error.hpp"
#include "perimode/linalg/factor.hpp"
#include "sparse_engine.hpp"

namespace perimode {
namespace {

using Complex = std::complex<double>;

/// Eigenvalues closer than this, relative to the larger of the two, count as copies: the round-off
/// of a dense solution of a few thousand unknowns stays below it.
constexpr double same = 1e-7;

/// Turns u so that u^* v = 1 within each cluster of equal eigenvalues (v has unit columns). False
/// if a cluster is defective: it has no biorthonormal basis.
bool make_biorthonormal(const Eigen::VectorXcd& value, const Eigen::MatrixXcd& v, Eigen::MatrixXcd& u) {
  bool fine = true;
  const Eigen::Index n = value.size();
  for (Eigen::Index first = 0, end; first < n; first = end) {
    end = first + 1;
    // Copies need not be neighbours where conjugate pairs with one real part interleave.
    while (end < n && std::abs(value[end].real() - value[end - 1].real()) <= same * std::abs(value[end]))
      ++end;
    const Eigen::Index width = end - first;
    const Eigen::MatrixXcd gram = u.middleCols(first, width).adjoint() * v.middleCols(first, width);
    const Eigen::FullPivLU<Eigen::MatrixXcd> lu(gram);
    constexpr double defective = 1e-10;
    if (lu.rcond() < defective) {
      fine = false;
      continue;
    }
    u.middleCols(first, width) = (u.middleCols(first, width) * lu.inverse().adjoint()).eval();
  }
  return fine;
}

std::vector<Eigen::Index> ascending(const Eigen::VectorXcd& value) {
  std::vector<Eigen::Index> rank(value.size());
  std::iota(rank.begin(), rank.end(), 0);
  std::stable_sort(rank.begin(), rank.end(), [&](Eigen::Index a, Eigen::Index b) {
    return std::pair(value[a].real(), value[a].imag()) < std::pair(value[b].real(), value[b].imag());
  });
  return rank;
}

/// Positions of the wanted ones among ascending values.
std::vector<Eigen::Index> choose(const Eigen::VectorXcd& value, const EigenOptions& options) {
  std::vector<Eigen::Index> pick(value.size());
  std::iota(pick.begin(), pick.end(), 0);
  if (options.has_range) {
    std::erase_if(pick, [&](Eigen::Index i) {
      return value[i].real() < options.lower || value[i].real() > options.upper;
    });
    return pick;
  }
  if (options.has_shift)
    std::stable_sort(pick.begin(), pick.end(), [&](Eigen::Index a, Eigen::Index b) {
      return std::abs(value[a] - options.shift) < std::abs(value[b] - options.shift);
    });
  pick.resize(std::min<std::size_t>(pick.size(), options.count));
  std::sort(pick.begin(), pick.end());
  return pick;
}

/// Fills values and vectors from unit right vectors v and left vectors u of M^-1/2 K M^-1/2.
void deliver(const EigenProblem& problem, const EigenOptions& options, const Eigen::VectorXcd& value,
             const Eigen::MatrixXcd& v, Eigen::MatrixXcd u, UnsymmetricEigenResult& out) {
  const bool fine = make_biorthonormal(value, v, u);
  const std::vector<Eigen::Index> pick = choose(value, options);
  const Eigen::VectorXcd scale = problem.mass->cwiseSqrt().cwiseInverse().cast<Complex>();
  out.value = value(pick);
  out.right = scale.asDiagonal() * v(Eigen::all, pick);
  out.left = scale.asDiagonal() * u(Eigen::all, pick);
  const double top = out.value.size() > 0 ? out.value.cwiseAbs().maxCoeff() : 0.0;
  out.imaginary = top > 0.0 ? out.value.imag().cwiseAbs().maxCoeff() / top : 0.0;
  out.status = EigenStatus::converged;
  if (!fine) out.message = "some repeated eigenvalues are defective: their left vectors are not normalised";
}

UnsymmetricEigenResult solve_dense_unsymmetric(const EigenProblem& problem, const EigenOptions& options) {
  const Stopwatch watch;
  const Csr& k = *problem.stiffness;
  const auto n = static_cast<lapack_int>(k.rows);
  const Eigen::VectorXd root = problem.mass->cwiseSqrt();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n), left(n, n), right(n, n);
  for (Index i = 0; i < n; ++i)
    for (Offset e = k.row_start[i]; e < k.row_start[i + 1]; ++e)
      a(i, k.column[e]) = k.value[e] / (root[i] * root[k.column[e]]);
  Eigen::VectorXd real(n), imaginary(n);
  const lapack_int info = LAPACKE_dgeev(LAPACK_COL_MAJOR, 'V', 'V', n, a.data(), n, real.data(),
                                        imaginary.data(), left.data(), n, right.data(), n);
  if (info != 0)
    throw Error(ErrorKind::solver_failure,
                "dense eigenvalues: LAPACK dgeev failed with code " + std::to_string(info));
  Eigen::VectorXcd value(n);
  Eigen::MatrixXcd u(n, n), v(n, n);
  for (Index j = 0; j < n; ++j) {
    value[j] = {real[j], imaginary[j]};
    if (imaginary[j] == 0.0) {
      u.col(j) = left.col(j).cast<Complex>();
      v.col(j) = right.col(j).cast<Complex>();
      continue;
    }
    const Complex i(0.0, 1.0);
    u.col(j) = left.col(j) + i * left.col(j + 1);
    v.col(j) = right.col(j) + i * right.col(j + 1);
    u.col(j + 1) = u.col(j).conjugate();
    v.col(j + 1) = v.col(j).conjugate();
    value[j + 1] = std::conj(value[j]);
    ++j;
  }
  const std::vector<Eigen::Index> rank = ascending(value);
  UnsymmetricEigenResult out;
  out.engine = "dense";
  deliver(problem, options, value(rank), v(Eigen::all, rank), u(Eigen::all, rank), out);
  out.largest = value.cwiseAbs().maxCoeff();
  out.certificate = {.asked = options.check != CompletenessCheck::none,
                     .complete = true,
                     .method = "all modes",
                     .count = n,
                     .at = value.real().maxCoeff()};
  out.seconds_iterate = watch.seconds();
  return out;
}

/// x - Re(a (b^* x)): removes what the pairs found (biorthonormal, closed under conjugation) span.
Eigen::VectorXd without(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b, const Eigen::VectorXd& x) {
  if (a.cols() == 0) return x;
  return x - (a * (b.adjoint() * x)).real();
}

/// u <- u (v^* u)^-1: u^* v = 1 over the whole set.
void biorthonormalise(const Eigen::MatrixXcd& v, Eigen::MatrixXcd& u) {
  const Eigen::MatrixXcd gram = u.adjoint() * v;
  u = (u * gram.inverse().adjoint()).eval();
}

void append(Eigen::MatrixXcd& all, const Eigen::MatrixXcd& more) {
  Eigen::MatrixXcd joined(all.rows(), all.cols() + more.cols());
  joined << all, more;
  all = std::move(joined);
}

/// How many leading thetas to take: `count` and the rest of the last cluster (a conjugate pair is one).
Eigen::Index whole_clusters(const Eigen::VectorXcd& theta, Eigen::Index count) {
  Eigen::Index end = std::min(count, theta.size());
  while (end > 0 && end < theta.size() &&
         std::abs(theta[end - 1]) - std::abs(theta[end]) <= same * std::abs(theta[end]))
    ++end;
  return end;
}

UnsymmetricEigenResult solve_sparse_unsymmetric(const EigenProblem& problem, const EigenOptions& options,
                                                const Sink& sink) {
  UnsymmetricEigenResult out;
  out.engine = "arpack";
  const Eigen::VectorXd root = problem.mass->cwiseSqrt();
  const Eigen::Index n = root.size();
  double sigma = std::isnan(options.negative_shift) ? 0.0 : options.negative_shift;
  if (options.has_shift) sigma = options.shift;
  if (options.has_range) sigma = 0.5 * (options.lower + options.upper);
  sink.report("factorisation");
  const Stopwatch factorisation;
  const LuFactor factor(*problem.stiffness, sigma, *problem.mass);
  out.seconds_factor = factorisation.seconds();

  const Stopwatch iteration;
  sink.report("modes");
  Eigen::MatrixXcd v(n, 0), u(n, 0);  // found so far, biorthonormal
  const auto op = [&](const Eigen::VectorXd& x) {
    ++out.solves;
    return without(v, u, root.cwiseProduct(factor.solve(root.cwiseProduct(x))));
  };
  const auto transposed = [&](const Eigen::VectorXd& x) {
    ++out.solves;
    return without(u, v, root.cwiseProduct(factor.solve_transposed(root.cwiseProduct(x))));
  };
  const auto standard = [&](const Eigen::VectorXd& x) {
    const Eigen::MatrixXd image = multiply(*problem.stiffness, Eigen::MatrixXd(x.cwiseQuotient(root)));
    return Eigen::VectorXd(image.col(0).cwiseQuotient(root));
  };

  constexpr int spare = 3, most_rounds = 6;
  const Eigen::Index wanted = std::min<Eigen::Index>(options.count, n - spare - 2);
  double cut = 0.0;
  out.certificate = {.asked = options.check != CompletenessCheck::none, .method = "restart"};
  for (int round = 0; round < most_rounds; ++round) {
    // The first round finds; the next ones, deflated and from other start vectors, look for copies.
    const int count = round == 0 ? static_cast<int>(wanted) + spare : spare;
    const Stopwatch certifying;
    const int before = out.solves;
    const ArnoldiPairs right = arnoldi(op, n, count, 0.0, options.seed + round);
    if (right.theta.size() == 0) {
      out.message = "the iteration did not converge";
      return out;
    }
    Eigen::Index take = 0;
    if (round == 0) {
      take = whole_clusters(right.theta, wanted);
      const double next = take < right.theta.size() ? std::abs(right.theta[take]) : 0.0;
      cut = 0.5 * (std::abs(right.theta[take - 1]) + next);
    } else {
      while (take < right.theta.size() && std::abs(right.theta[take]) >= cut) ++take;
      out.certificate.solves = out.solves - before;
      out.certificate.seconds = certifying.seconds();
    }
    if (take == 0) {
      out.certificate.complete = true;
      break;
    }
    const ArnoldiPairs left = arnoldi(transposed, n, count, 0.0, options.seed + 100 + round);
    Eigen::Index matched = 0;
    while (matched < left.theta.size() && std::abs(left.theta[matched]) >= cut) ++matched;
    if (matched != take) {
      out.message = "right and left iterations disagree about the modes near the last one wanted";
      out.status = EigenStatus::not_certified;
      return out;
    }
    append(v, right.vector.leftCols(take));
    append(u, left.vector.leftCols(take).conjugate());  // Op^T y = theta y: y^T Op = theta y^T
    biorthonormalise(v, u);
  }

  // lambda as the two-sided Rayleigh quotient of K: its error is the product of both vectors' errors.
  Eigen::VectorXcd value(v.cols());
  for (Eigen::Index j = 0; j < v.cols(); ++j) {
    const Eigen::VectorXd real = v.col(j).real(), imaginary = v.col(j).imag();
    value[j] = u.col(j).dot(standard(real) + Complex(0.0, 1.0) * standard(imaginary));
  }
  const std::vector<Eigen::Index> rank = ascending(value);
  deliver(problem, options, value(rank), v(Eigen::all, rank), u(Eigen::all, rank), out);
  out.certificate.count = v.cols();
  out.certificate.at = sigma + 1.0 / cut;
  if (out.certificate.asked && !out.certificate.complete) {
    out.status = EigenStatus::not_certified;
    out.message = "copies of repeated eigenvalues kept turning up";
  }
  constexpr double rough = 1e-3;
  const ArnoldiPairs top = arnoldi(standard, n, 2, rough, options.seed);
  if (top.theta.size() > 0) out.largest = std::abs(top.theta[0]);
  out.seconds_iterate = iteration.seconds();
  return out;
}

}  // namespace

UnsymmetricEigenResult solve_unsymmetric(const EigenProblem& problem, const EigenOptions& options,
                                         const Sink& sink) {
  check(problem, options);
  constexpr Index dense_rows = 1500;
  const bool dense = options.engine == EigenEngine::dense ||
                     (options.engine == EigenEngine::automatic && problem.stiffness->rows <= dense_rows) ||
                     problem.stiffness->rows < 10;
  return dense ? solve_dense_unsymmetric(problem, options) : solve_sparse_unsymmetric(problem, options, sink);
}

}  // namespace perimode
