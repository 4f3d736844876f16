// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/modal/solver_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "perimode/core/error.hpp"

namespace perimode {

namespace {

/// Flops and nonzeros of eliminating a box that touches `border` dofs outside itself.
void dissect(std::array<double, 3> cells, double border, double reach, double dofs, DissectionCost& cost,
             double weight) {
  std::sort(cells.begin(), cells.end());
  const double volume = cells[0] * cells[1] * cells[2];
  const double cut = reach * cells[0] * cells[1];
  const bool leaf = cells[2] <= 2.0 * reach + 1.0 || volume <= 2.0 * cut;
  const double own = dofs * (leaf ? volume : cut);
  cost.nonzeros += weight * (0.5 * own * own + own * border);
  cost.flops += weight * (own * own * own / 3.0 + own * own * border + own * border * border);
  if (leaf) return;
  cells[2] = 0.5 * (cells[2] - reach);
  // Half of what the box touched, and the separator.
  dissect(cells, 0.5 * border + own, reach, dofs, cost, 2.0 * weight);
}

/// An eigenvalue somewhat above the `count` lowest of an elastic body: Weyl's law for a lattice whose top is
/// about (3/m)^2 c_p^2/dx^2, shear waves at c_p/sqrt(3).
double weyl_edge(const ModalSize& size, double largest, double count) {
  constexpr double pi = std::numbers::pi;
  constexpr double bound_over_top = 1.8;  // of the row-sum bound
  const double top = largest / bound_over_top * std::pow(size.reach / 3.0, 2);
  const int d = size.dimension;
  const double ball = d == 1 ? 2.0 : d == 2 ? pi : 4.0 / 3.0 * pi;
  const double waves = 1.0 + (d - 1) * std::pow(3.0, 0.5 * d);
  constexpr double more = 5.0;  // a filter may well let in a few that are not wanted
  const double wave_number = 2.0 * pi * std::pow((count + more) / (ball * waves * size.particles), 1.0 / d);
  return 3.0 * top * wave_number * wave_number;
}

/// Seconds of one product with K and what goes with it.
double product_seconds(const ModalSize& size) {
  const double per_end = size.grid ? (size.dimension == 3 ? 0.30e-9 : 0.18e-9) : 1.2e-9;
  constexpr double per_dof = 1.6e-9;
  return size.bond_ends * per_end + size.dofs * per_dof;
}

double wanted_modes(const ModalOptions& options) { return options.modes.value_or(20); }

SolverCost factor_cost(const ModalSize& size, const ModalOptions& options, const char* name) {
  const DissectionCost fill = dissection_cost(size.cells, size.reach, size.dimension);
  constexpr double flops_per_second = 2.7e10;
  constexpr double bytes_per_second = 1.2e10;
  const double columns = 70.0 + 2.5 * wanted_modes(options) + 30.0;  // search and certificate
  const double k_bytes = 12.0 * size.dimension * size.dimension * size.bond_ends;
  SolverCost cost;
  cost.solver = name;
  cost.seconds = fill.flops / flops_per_second + 4e-6 * size.dofs +
                 8.0 * fill.nonzeros * columns / 4.0 / bytes_per_second + 2e-9 * k_bytes;
  cost.bytes = 8.0 * fill.nonzeros * 1.25 + 2.5 * k_bytes + 8.0 * size.dofs * 250.0;
  return cost;
}

SolverCost chebyshev_cost(const ModalSize& size, double largest, const ModalOptions& options) {
  const double modes = wanted_modes(options);
  const double edge = weyl_edge(size, largest, modes);
  const double degree = std::max(1.0, 2.2 * std::sqrt(0.55 * largest / edge));
  const double columns = 60.0 + 3.0 * modes;
  SolverCost cost;
  cost.solver = "chebyshev";
  cost.seconds = columns * (degree * product_seconds(size) + 4e-10 * size.dofs * columns);
  cost.bytes = factor_free_bytes(size.dofs, modes);
  return cost;
}

SolverCost inverse_cost(const ModalSize& size, const ModalOptions& options) {
  const double modes = wanted_modes(options);
  constexpr double iterations = 20.0;  // of conjugate gradients with V-cycles, at any size
  constexpr double products = 9.0;     // that one such iteration costs as much as
  SolverCost cost;
  cost.solver = "inverse";
  cost.seconds = (80.0 + 3.0 * modes) * iterations * products * product_seconds(size);
  cost.bytes = factor_free_bytes(size.dofs, modes) + 8.0 * size.dofs * 15.0;
  return cost;
}

std::string costs(const SolverCost& cost) {
  const double gigabytes = cost.bytes * 1e-9;
  return fmt::format(
      "{} s and {} GB",
      cost.seconds < 10.0 ? fmt::format("{:.2g}", cost.seconds) : fmt::format("{:.0f}", cost.seconds),
      gigabytes < 10.0 ? fmt::format("{:.2g}", gigabytes) : fmt::format("{:.0f}", gigabytes));
}

}  // namespace

DissectionCost dissection_cost(const std::array<double, 3>& cells, double reach, int dofs_per_cell) {
  DissectionCost cost;
  dissect(cells, 0.0, reach, dofs_per_cell, cost, 1.0);
  return cost;
}

template <int Dim>
ModalSize modal_size(const Body<Dim>& body, bool symmetric) {
  ModalSize size;
  size.dimension = Dim;
  size.symmetric = symmetric;
  size.dofs = body.boundary.free;
  Point<Dim> low = Point<Dim>::Constant(1e300);
  Point<Dim> high = -low;
  const auto* grid = std::get_if<GridBonds<Dim>>(&body.bonds);
  size.grid = grid != nullptr;
  double horizon = 0.0;
  for (Index i = 0; i < body.count(); ++i) {
    bool free = false;
    for (int a = 0; a < Dim; ++a)
      free = free || body.boundary.free_number[static_cast<std::size_t>(i) * Dim + a] >= 0;
    if (!free) continue;
    size.particles += 1.0;
    low = low.cwiseMin(body.particles.position[i]);
    high = high.cwiseMax(body.particles.position[i]);
    if (grid != nullptr) {
      for (int w = 0; w < grid->words; ++w)
        size.bond_ends += std::popcount(grid->alive[static_cast<std::size_t>(i) * grid->words + w]);
    } else {
      const auto& cloud = std::get<CloudBonds<Dim>>(body.bonds);
      size.bond_ends += static_cast<double>(cloud.start[i + 1] - cloud.start[i]);
      if (cloud.start[i + 1] > cloud.start[i]) horizon += cloud.horizon[cloud.start[i]];
    }
  }
  if (size.particles == 0.0) return size;
  const double spacing = typical_spacing(body.particles, body.section);
  size.reach = grid != nullptr ? grid->reach : horizon / size.particles / spacing;
  for (int a = 0; a < Dim; ++a) size.cells[a] = std::max(1.0, (high[a] - low[a]) / spacing + 1.0);
  return size;
}

bool needs_matrix(ModalSolver engine) {
  return engine != ModalSolver::chebyshev && engine != ModalSolver::inverse;
}

double rough_bytes(const ModalSize& size, ModalSolver engine, const ModalOptions& options) {
  if (engine == ModalSolver::dense) return 24.0 * size.dofs * size.dofs;
  if (needs_matrix(engine)) return factor_cost(size, options, "lanczos").bytes;
  return factor_free_bytes(size.dofs, wanted_modes(options));
}

SolverChoice choose_solver(const ModalSize& size, double largest, const ModalOptions& options) {
  SolverChoice choice;
  choice.engine = options.solver;
  choice.edge = weyl_edge(size, largest, wanted_modes(options));
  const bool lowest = !options.range && !options.shift;
  if (!needs_matrix(options.solver) && !(lowest && size.symmetric)) {
    invalid_input({size.symmetric ? "the lowest modes (`modes`) of a solver without a factor"
                                  : "a symmetric stiffness for a solver without a factor",
                   size.symmetric ? "a range or a shift" : "an unsymmetric one (the boundary makes it so)",
                   "use solver: auto",
                   {}});
  }
  if (!needs_matrix(options.solver) && options.certificate == CertificateMethod::inertia) {
    invalid_input({"certificate auto, restart or none for a solver without a factor",
                   "inertia",
                   "inertia is counted in a factor: use solver: auto or lanczos",
                   {}});
  }
  if (options.solver != ModalSolver::automatic) {
    choice.reason = "asked for";
    return choice;
  }
  if (!size.symmetric) {
    choice.reason =
        "K is not symmetric under this boundary: all modes by LAPACK, or LU factor and Arnoldi iteration";
    return choice;
  }
  constexpr double few = 600;
  if (size.dofs <= few) {
    choice.engine = ModalSolver::dense;
    choice.reason = fmt::format("{:.0f} dofs are few: all modes by LAPACK", size.dofs);
    return choice;
  }
  if (!lowest) {
    choice.engine = ModalSolver::lanczos;
    choice.reason = "modes inside the spectrum need a factor and its inertia";
    return choice;
  }
  constexpr double counted = 5000;  // dofs up to which the certificate of a factor is always inertia
  if (size.dofs <= counted) {
    choice.engine = ModalSolver::lanczos;
    choice.reason = fmt::format(
        "{:.0f} dofs: a factor is cheap, and its inertia proves that no mode is missing", size.dofs);
    return choice;
  }
  choice.considered = {factor_cost(size, options, "lanczos"), chebyshev_cost(size, largest, options)};
  if (size.grid && size.dimension > 1) choice.considered.push_back(inverse_cost(size, options));
  if (options.certificate == CertificateMethod::inertia) choice.considered.resize(1);
  std::stable_sort(choice.considered.begin(), choice.considered.end(), [&](const auto& a, const auto& b) {
    const bool fits_a = options.memory_limit <= 0.0 || a.bytes <= options.memory_limit;
    const bool fits_b = options.memory_limit <= 0.0 || b.bytes <= options.memory_limit;
    return fits_a != fits_b ? fits_a : a.seconds < b.seconds;
  });
  const SolverCost& best = choice.considered.front();
  choice.engine = best.solver == "lanczos"     ? ModalSolver::lanczos
                  : best.solver == "chebyshev" ? ModalSolver::chebyshev
                                               : ModalSolver::inverse;
  choice.reason = "predicted " + costs(best);
  for (std::size_t k = 1; k < choice.considered.size(); ++k)
    choice.reason += ", " + choice.considered[k].solver + " " + costs(choice.considered[k]);
  return choice;
}

template ModalSize modal_size<1>(const Body<1>&, bool);
template ModalSize modal_size<2>(const Body<2>&, bool);
template ModalSize modal_size<3>(const Body<3>&, bool);

}  // namespace perimode
