// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "perimode/core/error.hpp"
#include "perimode/material/critical_stretch.hpp"

namespace perimode::cli {

namespace {

using std::numbers::pi;

/// Corners other than k = 0, the farthest of each direction.
template <int Dim>
std::vector<Point<Dim>> lines_to(const std::vector<Point<Dim>>& corners) {
  std::vector<Point<Dim>> lines;
  for (const Point<Dim>& corner : corners) {
    if (corner.norm() == 0.0) continue;
    const auto same = std::find_if(lines.begin(), lines.end(), [&](const Point<Dim>& line) {
      return (line.normalized() - corner.normalized()).norm() < 1e-12;
    });
    if (same == lines.end()) {
      lines.push_back(corner);
    } else if (corner.norm() > same->norm()) {
      *same = corner;
    }
  }
  return lines;
}

/// What `compute` returns; its complaints about the input point at a place of the case.
template <class Compute>
auto at_place(const Where& where, const Compute& compute) {
  try {
    return compute();
  } catch (const Error& error) {
    throw error.kind() == ErrorKind::invalid_input ? at(error, where) : error;
  }
}

/// Critical stretch of a lattice's kernel: by its function of distance, or by the bonds of its table.
template <int Dim>
double critical_stretch_of(const Lattice<Dim>& lattice) {
  const Medium& medium = lattice.medium;
  const Material& m = medium.material;
  if (!m.fracture_energy) return 0.0;
  const double energy =
      m.micromodulus.kernel == Kernel::shells
          ? lattice_fracture_energy(m.micromodulus, m.youngs_modulus, 1.0, lattice.family, medium.continuum)
          : fracture_energy(m.micromodulus, m.youngs_modulus, 1.0, medium.horizon, medium.continuum);
  return energy > 0.0 ? stretch_of(*m.fracture_energy, energy) : std::numeric_limits<double>::quiet_NaN();
}

/// The lattice with the fitted function's bonds.
template <int Dim>
Lattice<Dim> with_function(const Lattice<Dim>& lattice, const Micromodulus& function) {
  Lattice<Dim> fitted = lattice;
  fitted.medium.material.micromodulus = function;
  fitted.rates = bond_rates(fitted.medium, fitted.family);
  return fitted;
}

}  // namespace

template <int Dim>
std::vector<Point<Dim>> path_corners(const DispersionSpec& spec) {
  if (spec.path.empty()) return irreducible_contour<Dim>();
  std::vector<Point<Dim>> corners(spec.path.size());
  for (std::size_t k = 0; k < corners.size(); ++k)
    corners[k] = Eigen::Map<const Point<Dim>>(spec.path[k].data());
  return corners;
}

int survey_points(const DispersionSpec& spec, int dimension) {
  constexpr int usual[] = {1001, 101, 33};
  return spec.zone.value_or(usual[dimension - 1]);
}

template <int Dim>
LatticeReport<Dim> report_lattice(const Lattice<Dim>& lattice, const ZonePath<Dim>& path,
                                  const DispersionSpec& spec) {
  LatticeReport<Dim> report;
  report.waves = waves_along(lattice, path);
  const double unit = pi / lattice.family.spacing;
  for (const Point<Dim>& corner : lines_to(path_corners<Dim>(spec))) {
    for (const Branch branch : {Branch::pressure, Branch::shear}) {
      if (Dim == 1 && branch == Branch::shear) continue;
      report.bands.push_back({corner, branch,
                              branch_band(lattice, branch, Point<Dim>(corner.normalized()),
                                          corner.norm() * unit, spec.phase_error)});
    }
  }
  report.survey = survey_zone(lattice, survey_points(spec, Dim));
  return report;
}

template <int Dim>
OptimisedReport<Dim> report_optimised(const Lattice<Dim>& lattice, const ZonePath<Dim>& path,
                                      const DispersionSpec& spec) {
  const OptimiseOptions& options = *spec.optimise;
  OptimisedReport<Dim> optimised;
  optimised.result = at_place(spec.optimise_where, [&] { return optimise_micromodulus(lattice, options); });
  optimised.before = contour_error(lattice, options.poissons_ratio, options.weights);
  optimised.critical_stretch = critical_stretch_of(lattice);
  if (optimised.result.status == OptimiseStatus::infeasible) return optimised;
  optimised.lattice = with_shells(lattice, optimised.result.alpha);
  optimised.report = report_lattice(*optimised.lattice, path, spec);
  optimised.after = contour_error(*optimised.lattice, options.poissons_ratio, options.weights);
  optimised.optimised_critical_stretch = critical_stretch_of(*optimised.lattice);
  if (!spec.fit) return optimised;
  optimised.fit =
      at_place(spec.fit_where, [&] { return fit_influence(lattice, optimised.result.alpha, *spec.fit); });
  const Lattice<Dim> fitted = with_function(lattice, optimised.fit->micromodulus);
  optimised.fitted = contour_error(fitted, options.poissons_ratio, options.weights);
  optimised.fitted_survey = survey_zone(fitted, survey_points(spec, Dim));
  optimised.fitted_critical_stretch = critical_stretch_of(fitted);
  return optimised;
}

#define PERIMODE_LATTICE_REPORT(D)                                                                           \
  template std::vector<Point<D>> path_corners<D>(const DispersionSpec&);                                     \
  template LatticeReport<D> report_lattice<D>(const Lattice<D>&, const ZonePath<D>&, const DispersionSpec&); \
  template OptimisedReport<D> report_optimised<D>(const Lattice<D>&, const ZonePath<D>&,                     \
                                                  const DispersionSpec&)
PERIMODE_LATTICE_REPORT(1);
PERIMODE_LATTICE_REPORT(2);
PERIMODE_LATTICE_REPORT(3);
#undef PERIMODE_LATTICE_REPORT

}  // namespace perimode::cli
