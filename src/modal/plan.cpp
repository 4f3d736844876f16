// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/modal/plan.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "perimode/assembly/assemble.hpp"
#include "perimode/bonds/connectivity.hpp"
#include "perimode/linalg/eigen.hpp"
#include "perimode/modal/modes.hpp"
#include "perimode/modal/rigid.hpp"

namespace perimode {

namespace {

constexpr double unsymmetric_dense_limit = 1500;

template <int Dim>
double body_bytes(const Body<Dim>& body) {
  double bytes = static_cast<double>(body.count()) * (Dim * (8.0 + 8.0 + 4.0) + 8.0 + 4.0 + 4.0);
  if (const auto* grid = std::get_if<GridBonds<Dim>>(&body.bonds)) {
    bytes += 4.0 * static_cast<double>(grid->occupant.size()) + 8.0 * static_cast<double>(grid->alive.size());
  } else {
    const auto& cloud = std::get<CloudBonds<Dim>>(body.bonds);
    bytes += static_cast<double>(cloud.neighbour.size()) * (4.0 + 8.0 * (Dim + 3));
  }
  return bytes;
}

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

  BlockCsr blocks = assemble_stiffness(body);
  const double block_bytes = static_cast<double>(blocks.blocks()) * (4.0 + 8.0 * Dim * Dim);
  const Csr k = scalar_csr(blocks, body.boundary.free_number);
  blocks = {};
  const Eigen::VectorXd mass = lumped_mass(body);
  plan.nonzeros = k.nonzeros();
  plan.asymmetry = asymmetry(k);
  const double csr_bytes = 12.0 * static_cast<double>(plan.nonzeros) + 16.0 * plan.dofs;
  const double dofs = plan.dofs;
  const double wanted = options.modes.value_or(20);
  const double assembling = body_bytes(body) + block_bytes + csr_bytes;
  double solving = 0.0;
  const bool symmetric = plan.asymmetry <= 1e-12;
  if (symmetric) plan.rigid = static_cast<Index>(rigid_modes(body, as_operator(k), norm_inf(k), mass).cols());

  const bool small = dofs <= (symmetric ? EigenOptions{}.dense_limit : unsymmetric_dense_limit);
  if (options.solver == ModalSolver::dense || (options.solver == ModalSolver::automatic && small)) {
    plan.solver = "dense";
    plan.reason = options.solver == ModalSolver::dense
                      ? "asked for"
                      : fmt::format("{} dofs are few: all modes by LAPACK", plan.dofs);
    solving = (symmetric ? 3.0 : 8.0) * 8.0 * dofs * dofs;
  } else if (symmetric) {
    plan.solver = options.solver == ModalSolver::arpack  ? "arpack"
                  : options.solver == ModalSolver::slepc ? "slepc"
                                                         : "lanczos";
    plan.reason = options.solver == ModalSolver::automatic
                      ? "K is symmetric: one supernodal Cholesky factor serves all modes asked for"
                      : "asked for";
    plan.fill = predict_fill(k, particle_of_free_dof(body));
    const double basis = std::max(100.0, 3.0 * wanted + 40.0) + 2.0 * plan.rigid;
    solving = plan.fill.peak_bytes + 8.0 * dofs * (2.2 * basis + 3.0 * wanted);
  } else {
    plan.solver = "arpack";
    plan.reason = "K is not symmetric under this boundary: LU factor and Arnoldi iteration";
    plan.fill = predict_fill(k, particle_of_free_dof(body));
    // UMFPACK keeps L and U and a working copy; its column order fills more than a symmetric one.
    solving = 4.0 * plan.fill.factor_bytes + 8.0 * dofs * (8.0 * wanted + 60.0);
  }
  // The blocks of K are freed before the factor is made, but what was theirs is rarely of use to it.
  constexpr double program_bytes = 80e6;  // code, libraries and the work space of the BLAS
  plan.memory_bytes = assembling + solving + program_bytes;
  return plan;
}

double least_memory(const Model& model) {
  const BodySize size = estimate_size(model);
  const double d = model.dimension;
  return size.particles * (40.0 + 20.0 * d + size.family * (0.2 + 4.0 + 8.0 * d * d));
}

template ModalPlan plan_modes<1>(const Body<1>&, const ModalOptions&);
template ModalPlan plan_modes<2>(const Body<2>&, const ModalOptions&);
template ModalPlan plan_modes<3>(const Body<3>&, const ModalOptions&);

}  // namespace perimode
