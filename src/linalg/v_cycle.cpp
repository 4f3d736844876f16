// SPDX-License-Identifier: BSD-3-Clause
#include "v_cycle.hpp"

#include <memory>
#include <utility>

namespace perimode {
namespace {

/// x += d with d = momentum d + gain D^-1 (b - A x).
struct ChebyshevStep {
  double momentum = 0.0;
  double gain = 0.0;
};

/// The polynomial that bounds the error after a correction best without knowing where the rough modes begin:
/// Chebyshev's of the fourth kind on (0, largest] [lottes2023].
std::vector<ChebyshevStep> chebyshev(int degree, double largest) {
  std::vector<ChebyshevStep> steps;
  for (int k = 1; k <= degree; ++k) {
    const double scale = 1.0 / (2.0 * k + 1.0);
    steps.push_back({k == 1 ? 0.0 : (2.0 * k - 3.0) * scale, (8.0 * k - 4.0) * scale / largest});
  }
  return steps;
}

/// A cycle and the vectors it works on.
class Cycle {
 public:
  explicit Cycle(VCycle cycle) : cycle_(std::move(cycle)), work_(cycle_.levels.size()) {
    for (std::size_t l = 0; l < work_.size(); ++l) {
      const Index n = cycle_.levels[l].a.size;
      const bool coarsest = l + 1 == work_.size();
      if (l > 0) work_[l].b.resize(n);
      if (l > 0) work_[l].x.resize(n);
      if (coarsest && cycle_.factor) continue;
      work_[l].q.resize(n);
      work_[l].d.resize(n);
      work_[l].steps = chebyshev(cycle_.smoothing, cycle_.levels[l].largest);
    }
  }

  void run(std::size_t l, const double* b, double* x) {
    const VCycleLevel& level = cycle_.levels[l];
    Work& work = work_[l];
    const bool coarsest = l + 1 == work_.size();
    if (coarsest && cycle_.factor) {
      Eigen::Map<Eigen::VectorXd>(x, level.a.size) =
          cycle_.factor->solve(Eigen::Map<const Eigen::VectorXd>(b, level.a.size));
      return;
    }
    chebyshev_start(level.inverse, work.steps[0].gain, b, work.d.data(), x);
    for (std::size_t k = 1; k < work.steps.size(); ++k) smooth(l, work.steps[k], b, x);
    if (!coarsest) {
      level.a.apply(x, work.q.data());
      Work& next = work_[l + 1];
      level.restrict_difference(b, work.q.data(), next.b.data());
      run(l + 1, next.b.data(), next.x.data());
      level.add_prolonged(next.x.data(), x);
    }
    for (const ChebyshevStep& s : work.steps) smooth(l, s, b, x);
  }

 private:
  struct Work {
    Eigen::VectorXd b, x, q, d;
    std::vector<ChebyshevStep> steps;
  };

  void smooth(std::size_t l, const ChebyshevStep& s, const double* b, double* x) {
    const VCycleLevel& level = cycle_.levels[l];
    level.a.apply(x, work_[l].q.data());
    chebyshev_step(level.inverse, s.momentum, s.gain, b, work_[l].q.data(), work_[l].d.data(), x);
  }

  VCycle cycle_;
  std::vector<Work> work_;
};

}  // namespace

double v_cycle_bytes(const VCycle& cycle) {
  double numbers = 0.0;
  for (std::size_t l = 0; l < cycle.levels.size(); ++l)
    numbers += (l == 0 ? 2.0 : 4.0) * cycle.levels[l].a.size;
  double bytes = numbers * sizeof(double);
  for (const auto& level : cycle.levels) bytes += level.inverse.bytes();
  if (cycle.factor) bytes += cycle.factor->fill().factor_bytes;
  return bytes;
}

LinearOperator v_cycle(VCycle cycle) {
  const Index size = cycle.levels.front().a.size;
  const auto state = std::make_shared<Cycle>(std::move(cycle));
  return {size, [state](const double* b, double* x) { state->run(0, b, x); }};
}

}  // namespace perimode
