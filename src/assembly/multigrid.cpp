// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/assembly/multigrid.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "core/stopwatch.hpp"
#include "linalg/v_cycle.hpp"
#include "perimode/assembly/assemble.hpp"
#include "perimode/assembly/operators.hpp"
#include "perimode/core/error.hpp"
#include "perimode/linalg/threads.hpp"
#include "transfer.hpp"

namespace perimode {

namespace {

constexpr Index fewest_layers = 4;       // of cells along every axis of a body that is coarsened
constexpr Index most_factored = 200000;  // dofs of a coarsest level that is factored

template <int Dim>
bool can_be_coarsened(const Body<Dim>& body) {
  const auto& cells = body.particles.grid->cells;
  return std::all_of(cells.begin(), cells.end(), [](Index n) { return n >= fewest_layers; });
}

/// One thread while it lives: the dense kernels beneath a factorisation round differently for each number of
/// threads.
class OneThread {
 public:
  OneThread() { set_threads(1); }
  ~OneThread() { set_threads(before_); }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  int before_ = threads();
};

/// K of the coarsest level, made definite where rigid motions are free: shifted by 1e-8 of its largest
/// diagonal entry.
template <int Dim>
CholeskyFactor factored(const Body<Dim>& body) {
  const Csr matrix = scalar_csr(assemble_stiffness(body), body.boundary.free_number);
  CholeskyFactor factor = CholeskyFactor::with_order(
      matrix, dissection_order(matrix, particle_of_free_dof(body), particle_positions(body)));
  const OneThread guard;
  double shift = 0.0;
  for (int attempt = 0; attempt < 6; ++attempt) {
    if (factor.factorize(matrix, -shift, Eigen::VectorXd::Ones(matrix.rows)) == FactorStatus::done)
      return factor;
    shift = shift == 0.0 ? 1e-8 * norm_inf(matrix) : 100.0 * shift;
    if (shift == 0.0) shift = 1.0;
  }
  throw Error(ErrorKind::solver_failure, "the coarsest matrix of multigrid is not positive definite");
}

/// Coarse bodies and transfers, which the operators of the cycle point into.
template <int Dim>
struct Hierarchy {
  std::vector<std::unique_ptr<const Body<Dim>>> bodies;
  std::vector<std::unique_ptr<Transfer<Dim>>> transfers;
  LinearOperator cycle;
};

}  // namespace

template <int Dim>
Multigrid multigrid(const Body<Dim>& body, const LinearOperator& stiffness, const MultigridOptions& options) {
  if (!std::holds_alternative<GridBonds<Dim>>(body.bonds)) {
    invalid_input(
        {"a grid for multigrid", "a cloud", "use block Jacobi or a Cholesky factor for clouds", {}});
  }
  if (stiffness.size != body.boundary.free) {
    invalid_input({"the stiffness operator of the body, size " + std::to_string(body.boundary.free),
                   std::to_string(stiffness.size),
                   "make it with stiffness_operator(body)",
                   {}});
  }
  if (options.smoothing < 1) {
    invalid_input({"a smoother of degree >= 1", std::to_string(options.smoothing), "give 2", {}});
  }
  const auto begin = Clock::now();
  Multigrid out;
  const auto hierarchy = std::make_shared<Hierarchy<Dim>>();
  VCycle cycle;
  cycle.smoothing = options.smoothing;
  const Body<Dim>* fine = &body;
  for (;;) {
    VCycleLevel level;
    level.a = fine == &body ? stiffness : stiffness_operator(*fine);
    out.dofs.push_back(level.a.size);
    const bool last = level.a.size <= options.coarsest_dofs || !can_be_coarsened(*fine);
    if (last && level.a.size <= std::max(options.coarsest_dofs, most_factored)) {
      cycle.factor = factored(*fine);
      cycle.levels.push_back(std::move(level));
      break;
    }
    level.inverse = invert_blocks(absolute_blocks(*fine), Dim, fine->boundary.free_number);
    if (last) {
      cycle.levels.push_back(std::move(level));
      break;
    }
    hierarchy->bodies.push_back(std::make_unique<const Body<Dim>>(coarsen(*fine)));
    const Body<Dim>& coarse = *hierarchy->bodies.back();
    out.bytes += body_bytes(coarse) + operator_bytes(coarse);
    hierarchy->transfers.push_back(std::make_unique<Transfer<Dim>>(*fine, coarse));
    Transfer<Dim>* transfer = hierarchy->transfers.back().get();
    out.bytes += transfer->bytes();
    level.restrict_difference = [transfer](const double* b, const double* q, double* to) {
      transfer->restrict_difference(b, q, to);
    };
    level.add_prolonged = [transfer](const double* from, double* x) { transfer->add_prolonged(from, x); };
    cycle.levels.push_back(std::move(level));
    fine = &coarse;
  }
  out.bytes += v_cycle_bytes(cycle);
  hierarchy->cycle = v_cycle(std::move(cycle));
  out.preconditioner = {stiffness.size,
                        [hierarchy](const double* b, double* x) { hierarchy->cycle.apply(b, x); }};
  out.seconds = seconds_since(begin);
  return out;
}

template Multigrid multigrid<1>(const Body<1>&, const LinearOperator&, const MultigridOptions&);
template Multigrid multigrid<2>(const Body<2>&, const LinearOperator&, const MultigridOptions&);
template Multigrid multigrid<3>(const Body<3>&, const LinearOperator&, const MultigridOptions&);

}  // namespace perimode
