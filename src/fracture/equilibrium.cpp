// SPDX-License-Identifier: BSD-3-Clause
#include "fracture/equilibrium.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "perimode/assembly/assemble.hpp"
#include "perimode/assembly/multigrid.hpp"
#include "perimode/assembly/operators.hpp"
#include "perimode/linalg/conjugate_gradients.hpp"

namespace perimode {

namespace {

constexpr double most_factor_bytes = 8e9;
/// Above so many dofs not even the ordering is tried, by dimension.
constexpr double most_dofs_to_order[] = {1e12, 4e6, 4e5};
/// Solutions that share the making of a factor; its arithmetic counts a byte an operation.
constexpr double solutions_of_a_run = 1000.0;

/// Bytes per dof that a solution by conjugate gradients moves: as many iterations as the body is long in
/// horizons, as for statics; vectors, preconditioner, operator and, where that stores next to nothing, its
/// arithmetic at half a byte a multiplication.
template <int Dim>
double iterated_bytes(const Body<Dim>& body, double tolerance) {
  const double dofs = body.boundary.free;
  const double family = 2.0 * static_cast<double>(count_bonds(body.bonds, body.count())) / body.count();
  const double iterations = 0.7 * std::max(1.0, horizons_long(body)) * std::log(2.0 / tolerance);
  return iterations * (8.0 * 16.0 + operator_bytes(body) / dofs + 0.5 * Dim * family);
}

template <int Dim>
Csr free_matrix(const Body<Dim>& body, const std::vector<Pin>& pins) {
  Csr k = scalar_csr(assemble_stiffness(body), body.boundary.free_number, Zeros::keep);
  for (const Pin& pin : pins) {
    const auto first = k.column.begin() + k.row_start[pin.dof];
    const auto last = k.column.begin() + k.row_start[pin.dof + 1];
    k.value[static_cast<std::size_t>(std::lower_bound(first, last, pin.dof) - k.column.begin())] +=
        pin.stiffness;
  }
  return k;
}

template <int Dim>
std::vector<Index> elimination_order(const Body<Dim>& body, const Csr& k) {
  return dissection_order(k, particle_of_free_dof(body), particle_positions(body));
}

}  // namespace

template <int Dim>
std::vector<double> intact_springs(const Body<Dim>& body) {
  const std::vector<double> blocks = diagonal_blocks(body);
  std::vector<double> d(static_cast<std::size_t>(body.boundary.free));
  double sum = 0.0;
  for (std::size_t dof = 0; dof < body.boundary.free_number.size(); ++dof) {
    const Index number = body.boundary.free_number[dof];
    if (number >= 0) sum += d[static_cast<std::size_t>(number)] = blocks[dof * Dim + dof % Dim];
  }
  const double mean = std::abs(sum) / static_cast<double>(std::max<std::size_t>(1, d.size()));
  for (double& x : d) x = x > 1e-6 * mean ? x : mean;
  return d;
}

template <int Dim>
EquilibriumChoice choose_equilibrium(const Body<Dim>& body, const UpdatedSolverOptions& options,
                                     bool matrix_free) {
  if (matrix_free || options.only == SolveWay::iterate) return {true, "asked for", {}, 0.0};
  const double dofs = body.boundary.free;
  const double moved = iterated_bytes(body, options.tolerance);
  if (Dim > 1 && !options.only && dofs > most_dofs_to_order[Dim - 1])
    return {true, fmt::format("{:.0f} dofs are too many for a factor", dofs), {}, 0.0};
  EquilibriumChoice choice;
  const Csr k = scalar_csr(assemble_stiffness(body), body.boundary.free_number, Zeros::keep);
  choice.fill = predict_fill_with_order(k, elimination_order(body, k));
  choice.matrix_bytes = 12.0 * static_cast<double>(k.nonzeros());
  const double factor = (2.5 * choice.fill.factor_bytes + choice.fill.flops / solutions_of_a_run) / dofs;
  choice.reason = fmt::format(
      "a solution moves {:.1f} kB per dof through a factor of {:.3g} MB, about {:.1f} kB in iterations",
      1e-3 * factor, 1e-6 * choice.fill.factor_bytes, 1e-3 * moved);
  if (!options.only)
    choice.matrix_free = Dim > 1 && (factor > moved || choice.fill.peak_bytes > most_factor_bytes);
  return choice;
}

template <int Dim>
Equilibrium<Dim>::Equilibrium(Body<Dim>& body, const UpdatedSolverOptions& options, bool matrix_free,
                              std::vector<double> spring, const std::vector<Index>& pins)
    : body_(&body),
      options_(options),
      matrix_free_(matrix_free),
      spring_(std::move(spring)),
      pins_(std::make_shared<std::vector<Pin>>()),
      pinned_(spring_.size(), false) {
  for (const Index dof : pins) {
    pinned_[static_cast<std::size_t>(dof)] = true;
    pins_->push_back({dof, spring_[static_cast<std::size_t>(dof)]});
  }
  rebuild();
}

template <int Dim>
void Equilibrium<Dim>::rebuild() {
  if (solver_) earlier_ = totals();
  solver_.reset();
  stiffness_ = std::make_unique<BreakableStiffness<Dim>>(*body_);
  product_ = {body_->boundary.free, [k = stiffness_->product(), pins = pins_](const double* x, double* y) {
                k.apply(x, y);
                for (const Pin& pin : *pins) y[pin.dof] += pin.stiffness * x[pin.dof];
              }};
  if (matrix_free_) {
    solver_ = std::make_unique<UpdatedSolver>(
        product_, [this] { return preconditioner(); }, options_);
    return;
  }
  Csr k = free_matrix(*body_, *pins_);
  std::vector<Index> order = elimination_order(*body_, k);
  solver_ = std::make_unique<UpdatedSolver>(product_, std::move(k), std::move(order), options_);
}

template <int Dim>
Index Equilibrium<Dim>::mechanism_dof() const {
  if (body_->boundary.free > most_dofs_to_order[Dim - 1]) return -1;
  Csr k = free_matrix(*body_, *pins_);
  std::vector<Index> order = elimination_order(*body_, k);
  if (predict_fill_with_order(k, order).peak_bytes > most_factor_bytes) return -1;
  UpdatedSolverOptions options;
  options.only = SolveWay::refactor;
  UpdatedSolver solver(product_, std::move(k), std::move(order), options);
  Eigen::MatrixXd push = Eigen::MatrixXd::Ones(body_->boundary.free, 1), motion;
  return solver.solve(push, motion).dof;
}

template <int Dim>
LinearOperator Equilibrium<Dim>::preconditioner() const {
  if (Dim == 2 && body_->particles.grid && pins_->empty()) return multigrid(*body_, product_).preconditioner;
  std::vector<double> blocks = absolute_blocks(*body_);
  for (std::size_t d = 0; d < body_->boundary.free_number.size(); ++d) {
    const Index number = body_->boundary.free_number[d];
    if (number >= 0 && pinned(number)) blocks[d * Dim + d % Dim] += spring(number);
  }
  return block_jacobi(blocks, Dim, body_->boundary.free_number);
}

template <int Dim>
SolveOutcome Equilibrium<Dim>::solve(const Eigen::MatrixXd& b, Eigen::MatrixXd& q) {
  return solver_->solve(b, q);
}

template <int Dim>
void Equilibrium<Dim>::break_bonds(std::span<const BondRef> bonds) {
  const BondColumns lost = bond_columns(*body_, bonds);
  stiffness_->break_bonds(bonds);
  solver_->change(lost.negative, lost.positive);
}

template <int Dim>
void Equilibrium<Dim>::pin(const std::vector<Index>& dofs) {
  SparseColumns added, none;
  added.rows = none.rows = body_->boundary.free;
  for (const Index dof : dofs) {
    if (pinned(dof)) continue;
    pinned_[static_cast<std::size_t>(dof)] = true;
    pins_->push_back({dof, spring(dof)});
    added.row.push_back(dof);
    added.value.push_back(std::sqrt(spring(dof)));
    added.start.push_back(static_cast<Offset>(added.row.size()));
  }
  if (added.count() > 0) solver_->change(added, none);
}

template <int Dim>
std::array<WayTotals, solve_ways> Equilibrium<Dim>::totals() const {
  std::array<WayTotals, solve_ways> sum = earlier_;
  for (std::size_t w = 0; w < sum.size(); ++w) {
    const WayTotals& more = solver_->totals()[w];
    sum[w].solves += more.solves;
    sum[w].columns += more.columns;
    sum[w].iterations += more.iterations;
    sum[w].seconds += more.seconds;
  }
  return sum;
}

#define PERIMODE_EQUILIBRIUM(D)                                                                        \
  template std::vector<double> intact_springs<D>(const Body<D>&);                                      \
  template EquilibriumChoice choose_equilibrium<D>(const Body<D>&, const UpdatedSolverOptions&, bool); \
  template class Equilibrium<D>
PERIMODE_EQUILIBRIUM(1);
PERIMODE_EQUILIBRIUM(2);
PERIMODE_EQUILIBRIUM(3);
#undef PERIMODE_EQUILIBRIUM

}  // namespace perimode
