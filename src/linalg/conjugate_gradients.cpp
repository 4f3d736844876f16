// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/linalg/conjugate_gradients.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/stopwatch.hpp"
#include "fused.hpp"
#include "perimode/core/error.hpp"

namespace perimode {
namespace {

void check(const LinearOperator& a, const Eigen::VectorXd& b, const LinearOperator& preconditioner,
           const CgOptions& options, const Eigen::VectorXd* start) {
  const auto same_size = [&](const char* what, Eigen::Index size) {
    if (size == a.size) return;
    invalid_input({fmt::format("{} of size {}, that of the operator", what, a.size),
                   fmt::format("{}", size),
                   "use one set of free dofs",
                   {}});
  };
  same_size("a right-hand side", b.size());
  if (start != nullptr) same_size("a start vector", start->size());
  if (preconditioner.apply) same_size("a preconditioner", preconditioner.size);
  if (!(options.tolerance > 0.0)) {
    invalid_input({"a tolerance > 0", fmt::format("{}", options.tolerance), "give for example 1e-8", {}});
  }
  if (options.most_iterations < 0) {
    invalid_input({"a limit of iterations >= 0",
                   fmt::format("{}", options.most_iterations),
                   "give for example 20000",
                   {}});
  }
  if (!b.allFinite() || (start != nullptr && !start->allFinite())) {
    invalid_input(
        {"a finite right-hand side and start vector", "inf or nan", "check loads and stiffnesses", {}});
  }
}

class Iteration {
 public:
  Iteration(const LinearOperator& a, const Eigen::VectorXd& b, const LinearOperator& preconditioner,
            const CgOptions& options, const Sink& sink)
      : a_(a), b_(b), preconditioner_(preconditioner), options_(options), sink_(sink), n_(a.size) {}

  CgResult run(const Eigen::VectorXd* start) {
    CgResult result;
    size_of_b_ = std::sqrt(dot(n_, b_.data(), b_.data()));
    if (start != nullptr && size_of_b_ > 0.0) {
      x_ = *start;
    } else {
      x_ = Eigen::VectorXd::Zero(n_);
    }
    if (size_of_b_ > 0.0) iterate(result);
    result.converged = result.message.empty();
    result.x = std::move(x_);
    return result;
  }

 private:
  /// r = b - A x; returns |r| / |b|.
  double true_residual() {
    a_.apply(x_.data(), r_.data());
    return std::sqrt(subtract_from(n_, b_.data(), r_.data())) / size_of_b_;
  }

  /// Runs of conjugate gradients, each from a true residual, until one ends within the tolerance, or gains
  /// less than a factor of two: then round-off, not the number of iterations, is what limits x.
  void iterate(CgResult& result) {
    r_.resize(n_);
    q_.resize(n_);
    if (preconditioner_.apply) z_.resize(n_);
    result.residual = true_residual();
    while (!(result.residual <= options_.tolerance)) {
      const std::string trouble = descend(result);
      const double before = result.residual;
      result.residual = true_residual();
      if (result.residual <= options_.tolerance) return;
      result.message = trouble;
      if (trouble.empty() && !(result.residual < 0.5 * before)) {
        result.message =
            fmt::format("stagnation: round-off holds the true residual at {:.3g}", result.residual);
      }
      if (!result.message.empty()) return;
    }
  }

  /// One run of the recurrence from the true residual in r_ until its own residual meets the tolerance.
  /// Returns what stopped it otherwise.
  std::string descend(CgResult& result) {
    double rho = 0.0;
    double beta = 0.0;
    double residual = result.residual;
    while (residual > options_.tolerance) {
      if (result.iterations >= options_.most_iterations)
        return fmt::format("limit of {} iterations reached", options_.most_iterations);
      if (preconditioner_.apply) preconditioner_.apply(r_.data(), z_.data());
      const double* z = preconditioner_.apply ? z_.data() : r_.data();
      const double next = dot(n_, r_.data(), z);
      if (!(next > 0.0)) return "the preconditioner is not positive definite";
      if (rho == 0.0) {
        p_ = Eigen::Map<const Eigen::VectorXd>(z, n_);
      } else {
        beta = next / rho;
        turn(n_, z, beta, p_.data());
      }
      rho = next;
      a_.apply(p_.data(), q_.data());
      const double curvature = dot(n_, p_.data(), q_.data());
      result.singular = !(curvature > 0.0);
      if (result.singular) return "the matrix is not positive definite, or singular and b outside its range";
      residual =
          std::sqrt(advance(n_, rho / curvature, p_.data(), q_.data(), x_.data(), r_.data())) / size_of_b_;
      ++result.iterations;
      result.singular = !std::isfinite(residual);
      if (result.singular) return "the residual is not finite";
      sink_.report("conjugate gradients",
                   std::clamp(std::log(residual) / std::log(options_.tolerance), 0.0, 1.0));
    }
    return {};
  }

  const LinearOperator& a_;
  const Eigen::VectorXd& b_;
  const LinearOperator& preconditioner_;
  const CgOptions& options_;
  const Sink& sink_;
  Index n_;
  double size_of_b_ = 0.0;
  Eigen::VectorXd x_, r_, z_, p_, q_;
};

}  // namespace

CgResult conjugate_gradients(const LinearOperator& a, const Eigen::VectorXd& b,
                             const LinearOperator& preconditioner, const CgOptions& options,
                             const Eigen::VectorXd* start, const Sink& sink) {
  check(a, b, preconditioner, options, start);
  const auto begin = Clock::now();
  CgResult result = Iteration(a, b, preconditioner, options, sink).run(start);
  result.seconds = seconds_since(begin);
  return result;
}

LinearOperator factor_preconditioner(const CholeskyFactor& factor, Index size) {
  return {size, [&factor, size](const double* x, double* y) {
            Eigen::Map<Eigen::VectorXd>(y, size) = factor.solve(Eigen::Map<const Eigen::VectorXd>(x, size));
          }};
}

}  // namespace perimode
