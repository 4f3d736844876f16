// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/stopwatch.hpp"
#include "perimode/linalg/eigen.hpp"
#include "search.hpp"

namespace perimode {

/// Throws invalid_input unless sizes agree, masses are positive and the request makes sense.
void check(const EigenProblem& problem, const EigenOptions& options);

/// The lowest modes by a positive definite factor (sigma <= 0).
[[nodiscard]] EigenResult solve_lowest(const EigenProblem& problem, const EigenOptions& options,
                                       const Sink& sink);

/// All modes of a range, or the modes nearest to a shift, by indefinite factors.
[[nodiscard]] EigenResult solve_range(const EigenProblem& problem, const EigenOptions& options,
                                      const Sink& sink);
[[nodiscard]] EigenResult solve_nearest(const EigenProblem& problem, const EigenOptions& options,
                                        const Sink& sink);

/// The negative shift for a singular K: a part of the first elastic eigenvalue, which keeps the
/// elastic modes to 12 digits from -1e-6 of it on; without an estimate a millionth of
/// max K_ii / M_ii.
[[nodiscard]] double negative_shift(const EigenProblem& problem, const EigenOptions& options);

/// The lowest modes without a factor: block Lanczos on a Chebyshev polynomial of K, or on the inverse by
/// conjugate gradients.
[[nodiscard]] EigenResult solve_factor_free(const EigenProblem& problem, const EigenOptions& options,
                                            const Sink& sink);

[[nodiscard]] SearchSettings search_settings(const EigenOptions& options, Index rows);
[[nodiscard]] Method search_method(const EigenOptions& options);
[[nodiscard]] const char* method_name(const EigenOptions& options);

/// The order in which a factor eliminates the dofs.
[[nodiscard]] std::vector<Index> elimination_order(const EigenProblem& problem);

/// K of a problem as an operator, whatever it is given as.
[[nodiscard]] LinearOperator action_of(const EigenProblem& problem);

/// M^1/2 known, with no columns where nothing is known.
[[nodiscard]] Eigen::MatrixXd known_directions(const EigenProblem& problem);

/// Values and vectors of `result`: Rayleigh quotients of K and M in the span of M^-1/2 y, ascending.
void rayleigh_ritz(const EigenProblem& problem, const Eigen::MatrixXd& y, EigenResult& result);

/// Keeps modes [first, first + count).
void keep(EigenResult& result, Eigen::Index first, Eigen::Index count);

class Stopwatch {
 public:
  [[nodiscard]] double seconds() const { return seconds_since(begin_); }

 private:
  Clock::time_point begin_ = Clock::now();
};

}  // namespace perimode
