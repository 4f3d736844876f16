// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "perimode/dispersion/lattice.hpp"

namespace perimode {

/// How the multipliers alpha of a lattice's orbits are chosen. 1D has all four [alebrahim2021] sect. 6; 2D
/// and 3D have least_squares (docs/theory/17_optimised_micromoduli.md).
enum class OptimiseMethod { least_squares, point_collocation, subdomain_collocation, galerkin };
/// l2: a convex quadratic programme. l1: a linear programme, [alebrahim2021] eqs. (43), (49), (51), which
/// needs Clp (PERIMODE_WITH_CLP).
enum class ErrorNorm { l2, l1 };
/// Where omega^2 is compared with the classical c^2 k^2: the branches on the irreducible contour, or the
/// whole symbol over the whole zone (l2 only). In 1D they are the same.
enum class ErrorDomain { contour, zone };

struct OptimiseOptions {
  OptimiseMethod method = OptimiseMethod::least_squares;
  ErrorNorm norm = ErrorNorm::l2;
  ErrorDomain domain = ErrorDomain::contour;
  std::optional<double> lower_bound = {};      ///< of every alpha (least_squares); absent: none
  std::optional<double> poissons_ratio = {};   ///< of the target speeds; absent: that of the theory
  std::array<double, 2> weights = {1.0, 1.0};  ///< e_P, e_S: factors of the branches' errors
  /// Quadrature points per side (contour) or axis (zone), rounded up to multiples of 16. 0: enough for
  /// round-off (l2), 1024 a side (l1).
  int points = 0;
};

enum class OptimiseStatus { optimal, infeasible };

struct OptimisedMicromodulus {
  OptimiseStatus status = OptimiseStatus::optimal;
  std::vector<double> alpha;  ///< one per orbit, in the order of Family::shell; empty where infeasible
  std::string solver;         ///< "null space", "active set", "clp", "equations"
  /// The largest lower bound that the constraints admit (exact; whatever the status).
  double largest_feasible_bound = 0.0;
  double constraint_error = 0.0;  ///< largest |long-wave speed^2 / target - 1| of the constrained branches
  /// l2: largest component of the Lagrangian's gradient (of alpha at the bound: its negative part), relative
  /// to that of the objective at alpha = 1; l1: relative duality gap; collocation and Galerkin: largest
  /// equation residual relative to its right side.
  double optimality = 0.0;
  std::vector<int> active;  ///< orbits at the lower bound, whose alpha is the bound exactly
};

/// Multipliers that make the lattice's waves those of classical elasticity as nearly as `options` ask, with
/// the long-wave speeds along an axis exact (C11 and C44, two linear constraints; in 1D one). At the theory's
/// Poisson's ratio C11 = 3 C44, so they are exact in every direction; for another they hold along the axes
/// alone (Cauchy's relation C12 = C44). Of several minima without a bound the one nearest to alpha = 1 (made
/// to fulfil the constraints) is taken. The lattice has the constant kernel without volume correction, or
/// multipliers of it, which are replaced.
/// Throws invalid_input: a method the dimension lacks, l1 or a bound with another method, l1 over the zone, a
/// Poisson's ratio in 1D or outside (-1, 1/2), contradictory constraints (a family along the axes alone has
/// no shear stiffness), weights < 0 or all 0, another kernel, a volume correction; environment: l1 without
/// Clp. Bounds that cannot be met are a status. Cost O(points orbits^2) and a dense problem of orbits; over
/// the zone O(points^Dim/Dim! (family + orbits^2)).
template <int Dim>
[[nodiscard]] OptimisedMicromodulus optimise_micromodulus(const Lattice<Dim>& lattice,
                                                          const OptimiseOptions& options = {});

/// The lattice with the constant kernel's bonds multiplied by alpha (Family::shell order): its micromodulus
/// is the table (kernel shells). Throws invalid_input for another number of alpha than orbits.
template <int Dim>
[[nodiscard]] Lattice<Dim> with_shells(const Lattice<Dim>& lattice, const std::vector<double>& alpha);

/// Errors of a lattice (any kernel) on the irreducible contour against classical waves of `poissons_ratio`,
/// in the paper's units (spacing = 1, E/rho = 1: omega^2 spacing^2 rho/E): l1 = sum over branches of the arc
/// integral of e |omega^2 - c^2 k^2|, [alebrahim2021] eqs. (49), (51), split at sign changes; l2 = that of
/// e^2 times the square, eq. (45). Branches by polarisation; 3D has two S, each counted. Relative error <
/// 1e-9. Throws invalid_input as optimise_micromodulus for the ratio and the weights e. Cost O(family +
/// reach^2).
struct ContourError {
  double l1 = 0.0;
  double l2 = 0.0;
};
template <int Dim>
[[nodiscard]] ContourError contour_error(const Lattice<Dim>& lattice,
                                         std::optional<double> poissons_ratio = {},
                                         const std::array<double, 2>& weights = {1.0, 1.0});

}  // namespace perimode
