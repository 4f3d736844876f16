// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/modal/plan.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "perimode/assembly/assemble.hpp"
#include "perimode/assembly/operators.hpp"
#include "perimode/bonds/connectivity.hpp"
#include "perimode/linalg/eigen.hpp"
#include "perimode/modal/modes.hpp"
#include "perimode/modal/rigid.hpp"
#include "perimode/modal/solver_choice.hpp"

namespace perimode {

namespace {

constexpr double unsymmetric_dense_limit = 1500;

template <int Dim>
void warn_of_mechanisms(const Body<Dim>& body, ModalPlan& plan) {
  if (const auto* grid = std::get_if<GridBonds<Dim>>(&body.bonds)) {
    const double m = grid->family.horizon / grid->family.spacing;
    if (Dim > 1 && m < 2.0) {
      plan.warnings.push_back(
          fmt::format("a horizon of {:.3g} spacings leaves mechanisms: below 2 a lattice can shear without "
                      "energy; use 2 or more",
                      m));
    }
  }
  if (plan.isolated > 0) {
    plan.warnings.push_back(
        fmt::format("{} particle{} without any bond: every free component of it is a mode at zero",
                    plan.isolated, plan.isolated == 1 ? " is" : "s are"));
  }
  if (plan.pieces > 1) {
    plan.warnings.push_back(fmt::format("the body is in {} separate pieces", plan.pieces));
  }
}

}  // namespace

template <int Dim>
ModalPlan plan_modes(const Body<Dim>& body, const ModalOptions& options) {
  ModalPlan plan;
  plan.particles = body.count();
  plan.ghosts = ghost_count(body.bonds);
  plan.bonds = count_bonds(body.bonds, body.count());
  plan.cut = body.cut;
  plan.dofs = body.boundary.free;
  const Pieces pieces = find_pieces(body.bonds, body.count());
  plan.pieces = pieces.count;
  plan.isolated = pieces.isolated;
  warn_of_mechanisms(body, plan);
  check_request(plan.dofs, options);

  const LinearOperator action = stiffness_operator(body);
  const Eigen::VectorXd mass = lumped_mass(body);
  const double bound = stiffness_bound(body);
  plan.asymmetry = asymmetry(action);
  const bool symmetric = plan.asymmetry <= symmetric_to_round_off;
  const SolverChoice choice = choose_solver(modal_size(body, symmetric), bound / mass.minCoeff(), options);
  plan.reason = choice.reason;
  if (symmetric) plan.rigid = static_cast<Index>(rigid_modes(body, action, mass).cols());

  const double dofs = plan.dofs;
  const double wanted = options.modes.value_or(20);
  // What is held from the start, and what the solver adds. Pages that a step leaves are taken again by the
  // next.
  double held = body_bytes(body) + operator_bytes(body);
  double solving = 0.0;
  if (needs_matrix(choice.engine)) {
    BlockCsr blocks = assemble_stiffness(body);
    const double block_bytes = static_cast<double>(blocks.blocks()) * (4.0 + 8.0 * Dim * Dim);
    const Csr k = scalar_csr(blocks, body.boundary.free_number);
    blocks = {};
    plan.nonzeros = k.nonzeros();
    // The blocks of K are freed before the factor is made, but what was theirs is rarely of use to it.
    held += block_bytes + 12.0 * static_cast<double>(plan.nonzeros) + 16.0 * dofs;
    const bool dense = choice.engine == ModalSolver::dense || (!symmetric && dofs <= unsymmetric_dense_limit);
    const auto order = [&] {
      return dissection_order(k, particle_of_free_dof(body), particle_positions(body));
    };
    if (dense) {
      plan.solver = "dense";
      solving = (symmetric ? 3.8 : 8.0) * 8.0 * dofs * dofs;
    } else if (symmetric) {
      plan.solver = choice.engine == ModalSolver::arpack  ? "arpack"
                    : choice.engine == ModalSolver::slepc ? "slepc"
                                                          : "lanczos";
      plan.fill = predict_fill_with_order(k, order());
      const double basis = choice.engine == ModalSolver::arpack
                               ? 5.0 * wanted
                               : 2.2 * std::max(100.0, 3.0 * wanted + 40.0) + 3.0 * wanted;
      solving = plan.fill.peak_bytes + 8.0 * dofs * (basis + 4.0 * plan.rigid);
    } else {
      plan.solver = "arpack";
      plan.fill = predict_fill_with_order(k, order());
      // UMFPACK keeps L and U and a working copy; its column order fills more than a symmetric one.
      solving = 4.0 * plan.fill.factor_bytes + 8.0 * dofs * (8.0 * wanted + 60.0);
    }
  } else {
    plan.solver = choice.engine == ModalSolver::chebyshev ? "chebyshev" : "inverse";
    solving = factor_free_bytes(dofs, wanted);
    if (choice.engine == ModalSolver::inverse) solving += 15.0 * 8.0 * dofs;
  }
  constexpr double program_bytes = 38e6;  // code, libraries and the work space of the BLAS
  plan.memory_bytes = held + solving + program_bytes;
  return plan;
}

template <int Dim>
double rough_memory(const Body<Dim>& body, const ModalOptions& options) {
  const ModalSize size = modal_size(body, true);
  const SolverChoice choice = choose_solver(size, 1.0, options);
  return body_bytes(body) + operator_bytes(body) + rough_bytes(size, choice.engine, options);
}

template ModalPlan plan_modes<1>(const Body<1>&, const ModalOptions&);
template ModalPlan plan_modes<2>(const Body<2>&, const ModalOptions&);
template ModalPlan plan_modes<3>(const Body<3>&, const ModalOptions&);
template double rough_memory<1>(const Body<1>&, const ModalOptions&);
template double rough_memory<2>(const Body<2>&, const ModalOptions&);
template double rough_memory<3>(const Body<3>&, const ModalOptions&);

}  // namespace perimode
