// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "perimode/assembly/body.hpp"
#include "perimode/modal/options.hpp"

namespace perimode {

/// What the cost of a modal analysis depends on.
struct ModalSize {
  int dimension = 2;
  bool grid = true;
  bool symmetric = true;
  double dofs = 0.0;                              ///< free ones
  double particles = 0.0;                         ///< with a free dof
  double bond_ends = 0.0;                         ///< alive, of those particles
  std::array<double, 3> cells = {1.0, 1.0, 1.0};  ///< box around them, in spacings
  double reach = 3.0;                             ///< horizon, in spacings
};
/// Cost O(particles * words of bits) on a grid, O(bond ends) on a cloud.
template <int Dim>
[[nodiscard]] ModalSize modal_size(const Body<Dim>& body, bool symmetric);

/// What one solver would take.
struct SolverCost {
  std::string solver;
  double seconds = 0.0;  ///< of one core of the machine the model was measured on
  double bytes = 0.0;    ///< besides the body
};

struct SolverChoice {
  ModalSolver engine = ModalSolver::automatic;
  std::string reason;                  ///< one sentence, the costs that decided in it
  std::vector<SolverCost> considered;  ///< all that could serve, cheapest first
  double edge = 0.0;                   ///< EigenOptions::edge
};

/// The solver of an analysis: what is asked for, or the cheapest by the cost model of
/// docs/theory/10_factor_free_modes.md among those that can serve the request and stay within the memory
/// limit. Counts operations, measures nothing: equal input makes equal choices. `largest` bounds the
/// spectrum, (rad/s)^2. Throws invalid_input when a solver without a factor is asked for a range, a shift, a
/// certificate by inertia or an unsymmetric body.
[[nodiscard]] SolverChoice choose_solver(const ModalSize& size, double largest, const ModalOptions& options);

/// Bytes that a solver takes besides the body by the same cost model.
[[nodiscard]] double rough_bytes(const ModalSize& size, ModalSolver engine, const ModalOptions& options);

/// Does the engine work on the assembled K?
[[nodiscard]] bool needs_matrix(ModalSolver engine);

/// Nonzeros of L and flops of a nested-dissection Cholesky factorisation of a box of cells whose bonds reach
/// so many cells: separators `reach` wide across the longest side, down to boxes as thick as a separator.
struct DissectionCost {
  double nonzeros = 0.0;
  double flops = 0.0;
};
[[nodiscard]] DissectionCost dissection_cost(const std::array<double, 3>& cells, double reach,
                                             int dofs_per_cell);

}  // namespace perimode
