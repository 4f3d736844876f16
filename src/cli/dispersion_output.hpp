// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lattice_report.hpp"
#include "perimode/io/table.hpp"

namespace perimode::cli {

/// What the case's integrator and step make of a frequency. @pre spec.time_step.
[[nodiscard]] double stepped_frequency(double omega, const DispersionSpec& spec);

/// dispersion.csv: a row per wave vector and branch, with the columns that `spec` asks for.
template <int Dim>
[[nodiscard]] Table waves_table(const Lattice<Dim>& lattice, const std::vector<PlaneWaves<Dim>>& waves,
                                const DispersionSpec& spec);

/// polar.csv. @pre spec.polar.
template <int Dim>
[[nodiscard]] Table polar_table(const Lattice<Dim>& lattice, const DispersionSpec& spec);

/// zone.csv: a row per point of the survey's grid and branch.
template <int Dim>
[[nodiscard]] Table zone_table(const Lattice<Dim>& lattice, int points_per_axis);

/// bands.csv: a row per direction and branch.
template <int Dim>
[[nodiscard]] Table bands_table(const std::vector<CornerBand<Dim>>& bands);

/// coefficients.csv, as the kernel shells reads it.
template <int Dim>
[[nodiscard]] Table coefficients_table(const Family<Dim>& family, const std::vector<double>& alpha);

/// influence.yaml: a fitted function as `micromodulus` of a case.
[[nodiscard]] std::string influence_yaml(const InfluenceFit& fit, double horizon);

template <int Dim>
[[nodiscard]] nlohmann::ordered_json bands_json(const std::vector<CornerBand<Dim>>& bands);
template <int Dim>
[[nodiscard]] nlohmann::ordered_json survey_json(const ZoneSurvey<Dim>& survey);
/// certificate of summary.json; @pre spec.optimise.
template <int Dim>
[[nodiscard]] nlohmann::ordered_json certificate_json(const OptimisedReport<Dim>& optimised);
/// optimised of summary.json.
template <int Dim>
[[nodiscard]] nlohmann::ordered_json optimised_json(const OptimisedReport<Dim>& optimised,
                                                    const DispersionSpec& spec);

/// Names of the choices as a case writes them.
[[nodiscard]] const char* word(OptimiseMethod method);
[[nodiscard]] const char* word(ErrorNorm norm);
[[nodiscard]] const char* word(ErrorDomain domain);
[[nodiscard]] const char* word(StepIntegrator integrator);

/// "(1, 0)".
template <int Dim>
[[nodiscard]] std::string point_text(const Point<Dim>& point, double unit = 1.0);

}  // namespace perimode::cli
