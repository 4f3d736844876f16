// SPDX-License-Identifier: BSD-3-Clause
#include "certificate.hpp"

#include <algorithm>

#include "core/stopwatch.hpp"
#include "perimode/linalg/factor.hpp"

namespace perimode {
namespace {

/// Does a probe find nothing? It may need more than one attempt to decide.
bool clean(SpectralTransform& op, const Eigen::MatrixXd& deflated, Neighbourhood& held, double cut, int block,
           std::uint64_t seed) {
  constexpr int most_attempts = 10;
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    const Probe seen = probe(op, deflated, held, cut, block, seed + attempt);
    if (seen.clean || seen.found.cols() > 0) return seen.clean;
  }
  return false;
}

}  // namespace

Offset count_below(const EigenProblem& problem, double sigma, std::span<const Index> order) {
  return IndefiniteFactor(*problem.stiffness, sigma, *problem.mass, order).negative_pivots();
}

Certificate certify_by_inertia(const EigenProblem& problem, double at, Offset expected,
                               std::span<const Index> order) {
  const auto begin = Clock::now();
  Certificate out{.method = "inertia", .count = count_below(problem, at, order), .at = at};
  out.complete = out.count == expected;
  out.seconds = seconds_since(begin);
  return out;
}

Certificate certify_by_restart(SpectralTransform& op, const Eigen::MatrixXd& deflated, Neighbourhood held,
                               double cut, int block, int rounds, std::uint64_t seed) {
  const auto begin = Clock::now();
  const Offset applied = op.applied;
  Certificate out{.complete = true, .method = "restart", .at = op.eigenvalue(cut)};
  for (int round = 0; round < rounds && out.complete; ++round)
    out.complete = clean(op, deflated, held, cut, block, seed + 131 * round);
  out.solves = static_cast<int>(op.applied - applied);
  out.seconds = seconds_since(begin);
  return out;
}

bool inertia_is_cheap(Index rows, Offset factor_nonzeros, double factor_flops) {
  // Measured on one core: MUMPS 2e10 flops/s + 5 us a row; a restart certificate takes about 30
  // solves of 4e-10 s per nonzero of L. Counted, not timed, so that equal input takes equal paths.
  constexpr Index always = 5000;
  const double inertia = factor_flops / 2e10 + 5e-6 * rows;
  const double restart = 30 * 4e-10 * static_cast<double>(factor_nonzeros);
  return rows <= always || 2.0 * inertia <= restart;
}

}  // namespace perimode
