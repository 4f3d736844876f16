// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "perimode/dispersion/influence.hpp"
#include "perimode/dispersion/optimise.hpp"
#include "perimode/dispersion/waves.hpp"
#include "perimode/dispersion/zone.hpp"
#include "perimode/io/dispersion_spec.hpp"

namespace perimode::cli {

/// The band of a branch along the line from k = 0 to a corner of the path.
template <int Dim>
struct CornerBand {
  Point<Dim> corner = Point<Dim>::Zero();  ///< in pi/spacing
  Branch branch = Branch::pressure;
  BranchBand band;
};

/// What there is to say of a lattice's waves.
template <int Dim>
struct LatticeReport {
  std::vector<PlaneWaves<Dim>> waves;  ///< along the path
  std::vector<CornerBand<Dim>> bands;
  ZoneSurvey<Dim> survey;
};

/// The better micromodulus and how much better it is.
template <int Dim>
struct OptimisedReport {
  OptimisedMicromodulus result;
  std::optional<Lattice<Dim>> lattice;  ///< with it; none where infeasible
  LatticeReport<Dim> report;
  ContourError before, after;
  std::optional<InfluenceFit> fit;
  ContourError fitted;            ///< of the lattice with the fitted function
  ZoneSurvey<Dim> fitted_survey;  ///< likewise
  /// Of the case's kernel, of the table of coefficients, of the fitted function ([alebrahim2021] eq. (52)) at
  /// the case's fracture energy; 0: there is none, NaN: bonds across a crack hold no positive energy.
  double critical_stretch = 0.0, optimised_critical_stretch = 0.0, fitted_critical_stretch = 0.0;
};

/// Corners of the path that the case gives, or of the irreducible contour; pi/spacing.
template <int Dim>
[[nodiscard]] std::vector<Point<Dim>> path_corners(const DispersionSpec& spec);

/// Points per axis of the survey where the case gives none.
[[nodiscard]] int survey_points(const DispersionSpec& spec, int dimension);

template <int Dim>
[[nodiscard]] LatticeReport<Dim> report_lattice(const Lattice<Dim>& lattice, const ZonePath<Dim>& path,
                                                const DispersionSpec& spec);

/// @pre spec.optimise. Errors point at the section or key that asks.
template <int Dim>
[[nodiscard]] OptimisedReport<Dim> report_optimised(const Lattice<Dim>& lattice, const ZonePath<Dim>& path,
                                                    const DispersionSpec& spec);

}  // namespace perimode::cli
