// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "perimode/core/error.hpp"
#include "perimode/dispersion/optimise.hpp"
#include "perimode/geometry/region.hpp"

namespace perimode {

/// What steps through time and so shifts the frequency of a wave.
enum class StepIntegrator { central_difference, newmark };

/// Waves of all directions at one wave number.
struct PolarSpec {
  double wave_number = 0.0;  ///< in pi/spacing; 0: long waves
  int directions = 360;
};

/// A transient run whose waves are drawn under the curves.
struct SpectrumSpec {
  std::filesystem::path run;  ///< folder of its results, which holds fields.exo
  Where where = {};
};

/// The section analysis.dispersion of a case file, its lists checked against the body.
struct DispersionSpec {
  std::vector<Coordinates> path = {};  ///< corners in pi/spacing; empty: the irreducible contour
  int points = 300;
  std::optional<int> zone = {};          ///< points per axis of the survey, and zone.csv
  std::optional<double> time_step = {};  ///< s
  StepIntegrator integrator = StepIntegrator::central_difference;
  double phase_error = 0.05;  ///< of the bands
  std::optional<PolarSpec> polar = {};
  std::optional<double> finite_difference = {};  ///< Courant number; 1D
  std::optional<OptimiseOptions> optimise = {};
  Where optimise_where = {};
  std::optional<int> fit = {};  ///< cosines of the influence function
  Where fit_where = {};
  std::optional<SpectrumSpec> spectrum = {};
  std::optional<int> waves = {};  ///< clouds: wave lengths in the body, from 1
  Where where = {};
};

}  // namespace perimode
