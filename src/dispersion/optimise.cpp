// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/dispersion/optimise.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "dispersion/bounded_least_squares.hpp"
#include "dispersion/long_wave.hpp"
#include "dispersion/optimise_parts.hpp"

namespace perimode {
namespace {

template <int Dim>
void require_lattice(const Lattice<Dim>& lattice) {
  const Kernel kernel = lattice.medium.material.micromodulus.kernel;
  if (kernel != Kernel::constant && !is_lattice_kernel(kernel)) {
    invalid_input({"the constant kernel or multipliers of it (fourier, shells)", name(kernel),
                   "choose micromodulus: {kernel: constant}"});
  }
  if (std::any_of(lattice.family.weight.begin(), lattice.family.weight.end(),
                  [](double beta) { return beta != 1.0; })) {
    invalid_input({"a family without volume correction", "one with corrected volumes",
                   "choose volume_correction: none: multipliers belong to whole cells"});
  }
}

void require_options(const OptimiseOptions& options, int dimension) {
  require_weights(options.weights, dimension);
  const bool residuals = options.method != OptimiseMethod::least_squares;
  if (residuals && dimension > 1) {
    invalid_input({"the method least_squares in two and three dimensions", "a weighted residual",
                   "point_collocation, subdomain_collocation and galerkin belong to one dimension"});
  }
  if (residuals && options.norm == ErrorNorm::l1) {
    invalid_input({"the norm l1 with the method least_squares, whose error it replaces",
                   "l1 with a weighted residual", "leave the norm out"});
  }
  if (residuals && options.lower_bound) {
    invalid_input({"a lower_bound with the method least_squares",
                   fmt::format("{} with a weighted residual", *options.lower_bound),
                   "equations leave no room for a bound"});
  }
  if (options.norm == ErrorNorm::l1 && options.domain == ErrorDomain::zone && dimension > 1) {
    invalid_input({"the norm l1 on the contour", "l1 over the zone, where the branches are not linear",
                   "take l2 over the zone or l1 on the contour"});
  }
  if (options.lower_bound && !std::isfinite(*options.lower_bound)) {
    invalid_input({"a finite lower_bound", fmt::format("{}", *options.lower_bound), "leave it out for none"});
  }
  if (options.points < 0) {
    invalid_input({"quadrature points >= 0", fmt::format("{}", options.points), "0 chooses them"});
  }
}

/// The options with weights of which the largest that counts is 1: what is sought does not change, and limits
/// of the solvers mean the same.
OptimiseOptions of_unit_weight(OptimiseOptions options, int dimension) {
  const double largest =
      dimension > 1 ? std::max(options.weights[0], options.weights[1]) : options.weights[0];
  for (double& weight : options.weights) weight /= largest;
  return options;
}

/// Panels of 16 points: as asked for, or so many that their error is below round-off. Products of two
/// cosines of `order` periods in 2 pi have 2 order pi rad on a side; 16 rad a panel are enough for 1e-13.
int panels_of_side(const OptimiseOptions& options, int order) {
  if (options.points > 0) return (options.points + 15) / 16;
  return 1 + order * 2 / 5;
}

/// The multipliers nearest to 1 that fulfil the constraints.
Eigen::VectorXd nearest_to_ones(const Eigen::MatrixXd& constraints) {
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(constraints.cols());
  const Eigen::VectorXd missing = Eigen::VectorXd::Ones(constraints.rows()) - constraints * ones;
  return ones + Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(constraints).solve(missing);
}

template <int Dim>
OptimisedMicromodulus least_square_error(const Family<Dim>& family, const std::vector<double>& rates,
                                         const std::array<double, 2>& speeds, const OptimiseOptions& options,
                                         const Eigen::MatrixXd& constraints, const LargestBound& largest) {
  const bool zone = Dim > 1 && options.domain == ErrorDomain::zone;
  const ReducedObjective objective =
      zone ? zone_objective(family, rates, speeds, options.weights, panels_of_side(options, family.reach()))
           : contour_objective(sample_contour(family, rates, speeds, options.weights,
                                              panels_of_side(options, Dim * family.reach())));
  const Eigen::Index orbits = constraints.cols();
  const BoundedLeastSquares problem{objective.rows(), objective.right(), constraints,
                                    Eigen::VectorXd::Ones(constraints.rows()),
                                    options.lower_bound.value_or(-std::numeric_limits<double>::infinity())};
  // Without a bound of several minima the nearest to alpha = 1, made to fulfil the constraints, is taken.
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(orbits);
  const Eigen::VectorXd start = options.lower_bound ? largest.alpha : nearest_to_ones(constraints);
  const BoundedMinimum minimum = minimise(problem, start);
  const Eigen::VectorXd scale = problem.rows.transpose() * (problem.rows * ones - problem.right);

  OptimisedMicromodulus result;
  result.alpha.assign(minimum.x.begin(), minimum.x.end());
  result.active = minimum.active;
  result.solver = options.lower_bound ? "active set" : "null space";
  result.optimality = minimum.violation / scale.lpNorm<Eigen::Infinity>();
  return result;
}

template <int Dim>
OptimisedMicromodulus optimum(const Family<Dim>& family, const std::vector<double>& rates,
                              const std::array<double, 2>& speeds, const OptimiseOptions& options,
                              const Eigen::MatrixXd& constraints, const LargestBound& largest) {
  if constexpr (Dim == 1) {
    if (options.method != OptimiseMethod::least_squares)
      return weighted_residuals(family, rates, constraints, options.method);
  }
  if (options.norm == ErrorNorm::l2)
    return least_square_error(family, rates, speeds, options, constraints, largest);
  // Absolute errors have kinks: many points, and they count by the dozen anyhow.
  constexpr int panels_for_kinks = 64;
  const int panels = options.points > 0 ? (options.points + 15) / 16 : panels_for_kinks;
  return least_absolute_error(sample_contour(family, rates, speeds, options.weights, panels), constraints,
                              options.lower_bound.value_or(-std::numeric_limits<double>::infinity()),
                              largest.alpha);
}

}  // namespace

template <int Dim>
OptimisedMicromodulus optimise_micromodulus(const Lattice<Dim>& lattice, const OptimiseOptions& options) {
  require_lattice(lattice);
  require_options(options, Dim);
  const std::array<double, 2> speeds = target_speeds(lattice.medium.continuum, options.poissons_ratio);
  const std::vector<double> rates = constant_rates(lattice);
  const Eigen::MatrixXd constraints = long_wave_constraints(lattice.family, rates, speeds);
  const LargestBound largest = largest_bound(constraints);
  if (options.lower_bound &&
      *options.lower_bound > largest.bound + 1e-12 * std::max(1.0, std::abs(largest.bound))) {
    OptimisedMicromodulus infeasible;
    infeasible.status = OptimiseStatus::infeasible;
    infeasible.largest_feasible_bound = largest.bound;
    return infeasible;
  }
  OptimisedMicromodulus result =
      optimum(lattice.family, rates, speeds, of_unit_weight(options, Dim), constraints, largest);
  result.largest_feasible_bound = largest.bound;
  const Eigen::Map<const Eigen::VectorXd> alpha(result.alpha.data(),
                                                static_cast<Eigen::Index>(result.alpha.size()));
  result.constraint_error =
      (constraints * alpha - Eigen::VectorXd::Ones(constraints.rows())).lpNorm<Eigen::Infinity>();
  return result;
}

template <int Dim>
Lattice<Dim> with_shells(const Lattice<Dim>& lattice, const std::vector<double>& alpha) {
  if (alpha.size() != lattice.family.shell.size()) {
    invalid_input({fmt::format("a multiplier for each of the {} orbits", lattice.family.shell.size()),
                   fmt::format("{}", alpha.size()), "keep the order of the orbits"});
  }
  Lattice<Dim> changed = lattice;
  Micromodulus& micromodulus = changed.medium.material.micromodulus;
  micromodulus = {};
  micromodulus.kernel = Kernel::shells;
  micromodulus.spacing = lattice.family.spacing;
  micromodulus.shells.reserve(alpha.size());
  for (std::size_t o = 0; o < alpha.size(); ++o) {
    Shell shell{{}, alpha[o]};
    std::copy(lattice.family.shell[o].begin(), lattice.family.shell[o].end(), shell.offset.begin());
    micromodulus.shells.push_back(shell);
  }
  changed.rates = bond_rates(changed.medium, changed.family);
  return changed;
}

template OptimisedMicromodulus optimise_micromodulus<1>(const Lattice<1>&, const OptimiseOptions&);
template Lattice<1> with_shells<1>(const Lattice<1>&, const std::vector<double>&);
template OptimisedMicromodulus optimise_micromodulus<2>(const Lattice<2>&, const OptimiseOptions&);
template Lattice<2> with_shells<2>(const Lattice<2>&, const std::vector<double>&);
template OptimisedMicromodulus optimise_micromodulus<3>(const Lattice<3>&, const OptimiseOptions&);
template Lattice<3> with_shells<3>(const Lattice<3>&, const std::vector<double>&);

}  // namespace perimode
