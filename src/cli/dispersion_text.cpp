// SPDX-License-Identifier: BSD-3-Clause
#include "dispersion_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <vector>

#include "dispersion_output.hpp"

namespace perimode::cli {

namespace {

using std::numbers::pi;

std::string ratio_text(double value) { return std::isfinite(value) ? fmt::format("{:.6f}", value) : "none"; }

template <int Dim>
void bands(fmt::memory_buffer& out, const Lattice<Dim>& lattice, const std::vector<CornerBand<Dim>>& list,
           double error) {
  auto to = std::back_inserter(out);
  const double unit = pi / lattice.family.spacing;
  fmt::format_to(
      to, "{:16} branch  classical [m/s]  long waves  cut-off [rad/s]  at k [pi/dx]  {:>22}  overshoot\n",
      "line to [pi/dx]", fmt::format("within {:.3g} % to k", 100.0 * error));
  for (const CornerBand<Dim>& entry : list) {
    const BranchBand& band = entry.band;
    fmt::format_to(to, "{:16} {:6}  {:15.6g}  {:>10}  {:15.6e}  {:12.4f}  {:>22}  {:>9}\n",
                   point_text<Dim>(entry.corner), entry.branch == Branch::pressure ? "P" : "S",
                   classical_speed(lattice.medium, entry.branch), ratio_text(band.long_wave_ratio),
                   band.cut_off, band.cut_off_k / unit,
                   band.band_k > 0.0 ? fmt::format("{:.4f} ({:.4e})", band.band_k / unit, band.band_frequency)
                                     : std::string("never"),
                   fmt::format("{:.2f} %", 100.0 * std::max(0.0, band.worst_overshoot)));
  }
}

template <int Dim>
void survey(fmt::memory_buffer& out, const Lattice<Dim>& lattice, const ZoneSurvey<Dim>& zone) {
  auto to = std::back_inserter(out);
  const double unit = pi / lattice.family.spacing;
  fmt::format_to(to, "omega_max        {:.9e} rad/s at {} pi/dx\n", zone.omega_max,
                 point_text<Dim>(zone.omega_max_at, unit));
  fmt::format_to(to, "stable step      {:.9e} s (central differences, 2/omega_max)\n", zone.stable_step);
  fmt::format_to(to, "least omega^2    {:.6e} 1/s2 at {} pi/dx: {}\n", zone.least_squared,
                 point_text<Dim>(zone.least_at, unit),
                 zone.least_squared < 0.0 ? "UNSTABLE, waves there grow" : "stable");
  fmt::format_to(to, "phase error      P {:.3e} rms, {:.3e} at worst", zone.phase_error[0],
                 zone.worst_phase_error[0]);
  if (Dim > 1)
    fmt::format_to(to, "; S {:.3e} rms, {:.3e} at worst", zone.phase_error[1], zone.worst_phase_error[1]);
  fmt::format_to(to, " (zone, {} points per axis)\n", zone.points_per_axis);
}

template <int Dim>
void coefficients(fmt::memory_buffer& out, const Lattice<Dim>& lattice, const std::vector<double>& alpha) {
  auto to = std::back_inserter(out);
  constexpr std::size_t most = 24;
  fmt::format_to(to, "{:14}  distance [m]            alpha\n", "orbit");
  for (std::size_t k = 0; k < std::min(most, alpha.size()); ++k) {
    Point<Dim> offset;
    for (int a = 0; a < Dim; ++a)
      offset[a] = static_cast<double>(lattice.family.shell[k][static_cast<std::size_t>(a)]);
    fmt::format_to(to, "{:14}  {:12.6g}  {:15.10f}\n", point_text<Dim>(offset),
                   lattice.family.spacing * offset.norm(), alpha[k]);
  }
  if (alpha.size() > most) fmt::format_to(to, "... {} orbits in all\n", alpha.size());
}

void errors(fmt::memory_buffer& out, const ContourError& before, const ContourError& after, int dimension) {
  auto to = std::back_inserter(out);
  const auto line = [&](const std::string& name, double original, double optimised) {
    fmt::format_to(to, "{:16} {:14.6e}  {:14.6e}  {:9.6f}\n", name, original, optimised,
                   optimised / original);
  };
  fmt::format_to(to, "contour error    {:>14}  {:>14}  {:>9}\n", "original", "optimised", "ratio");
  line(fmt::format("l1 (eq. {})", dimension == 1 ? 49 : 51), before.l1, after.l1);
  line(fmt::format("l2 ({})", dimension == 1 ? "square" : "eq. 45"), before.l2, after.l2);
}

void influence(fmt::memory_buffer& out, const InfluenceFit& fit, const ContourError& error) {
  auto to = std::back_inserter(out);
  fmt::format_to(to, "influence        {:.6g}", fit.micromodulus.a0);
  for (std::size_t j = 0; j < fit.micromodulus.a.size(); ++j) {
    fmt::format_to(to, " {} {:.6g} cos({:.6g} r/dx)", fit.micromodulus.a[j] < 0.0 ? '-' : '+',
                   std::abs(fit.micromodulus.a[j]), static_cast<double>(j + 1) * fit.micromodulus.w);
  }
  fmt::format_to(
      to,
      "\n                 off the coefficients by at most {:.3e}; least {:.4g} at {:.4g} m; stores "
      "{:.6f} of the constant kernel's energy\n",
      fit.largest_deviation, fit.least, fit.least_at, fit.energy_ratio);
  fmt::format_to(to, "                 contour error l1 {:.6e}, l2 {:.6e}\n", error.l1, error.l2);
}

std::string stretch_text(double stretch) {
  return std::isnan(stretch) ? "none (no positive energy)" : fmt::format("{:.6e}", stretch);
}

}  // namespace

template <int Dim>
std::string lattice_text(const Lattice<Dim>& lattice) {
  const Medium& medium = lattice.medium;
  const char* theory = Dim == 1                                  ? "bar"
                       : Dim == 3                                ? "solid"
                       : medium.continuum.plane == Plane::stress ? "plane stress"
                                                                 : "plane strain";
  return fmt::format(
      "lattice          {}, spacing {:.6g} m, horizon {:.6g} m: {} bonds per particle in {} orbits\n"
      "kernel           {}\n",
      theory, lattice.family.spacing, medium.horizon, lattice.family.size(), lattice.family.shell.size(),
      name(medium.material.micromodulus.kernel));
}

template <int Dim>
std::string waves_text(const Lattice<Dim>& lattice, const LatticeReport<Dim>& report,
                       const DispersionSpec& spec) {
  fmt::memory_buffer out;
  auto to = std::back_inserter(out);
  fmt::format_to(to, "{}\n", lattice_text(lattice));
  bands(out, lattice, report.bands, spec.phase_error);
  fmt::format_to(to, "\n");
  survey(out, lattice, report.survey);
  if (spec.time_step) {
    const double share = *spec.time_step / report.survey.stable_step;
    fmt::format_to(to, "time step        {:.6e} s by {}: {:.4g} of the stable step{}\n", *spec.time_step,
                   word(spec.integrator), share,
                   share > 1.0 && spec.integrator == StepIntegrator::central_difference ? ", UNSTABLE" : "");
  }
  return fmt::to_string(out);
}

template <int Dim>
std::string optimised_text(const Lattice<Dim>& lattice, const OptimisedReport<Dim>& optimised,
                           const DispersionSpec& spec, const std::filesystem::path& file) {
  fmt::memory_buffer out;
  auto to = std::back_inserter(out);
  const OptimiseOptions& o = *spec.optimise;
  const OptimisedMicromodulus& r = optimised.result;
  fmt::format_to(to, "\noptimised        {}", word(o.method));
  if (o.method == OptimiseMethod::least_squares)
    fmt::format_to(to, ", {} on the {}", word(o.norm), word(o.domain));
  if (o.lower_bound) fmt::format_to(to, ", alpha >= {:.6g}", *o.lower_bound);
  if (o.poissons_ratio) fmt::format_to(to, ", Poisson's ratio {:.6g}", *o.poissons_ratio);
  if (r.status == OptimiseStatus::infeasible) {
    fmt::format_to(to, ": infeasible\n");
    return fmt::to_string(out);
  }
  fmt::format_to(to, "; by {}\n\n", r.solver);
  if (o.poissons_ratio)
    fmt::format_to(
        to, "the speeds aimed at are those of this ratio; those below are compared with the theory's\n\n");
  coefficients(out, lattice, r.alpha);
  fmt::format_to(to, "\n");
  bands(out, lattice, optimised.report.bands, spec.phase_error);
  fmt::format_to(to, "\n");
  survey(out, lattice, optimised.report.survey);
  fmt::format_to(to, "certificate      long-wave speeds to {:.1e}, optimality to {:.1e}", r.constraint_error,
                 r.optimality);
  if (!r.active.empty())
    fmt::format_to(to, ", {} orbit{} at the bound", r.active.size(), r.active.size() > 1 ? "s" : "");
  fmt::format_to(to, "\n");
  errors(out, optimised.before, optimised.after, Dim);
  if (optimised.fit) influence(out, *optimised.fit, optimised.fitted);
  if (optimised.critical_stretch != 0.0) {
    fmt::format_to(to, "critical stretch {} original, {} optimised", stretch_text(optimised.critical_stretch),
                   stretch_text(optimised.optimised_critical_stretch));
    if (optimised.fit)
      fmt::format_to(to, ", {} influence function", stretch_text(optimised.fitted_critical_stretch));
    fmt::format_to(to, "\n");
  }
  fmt::format_to(to,
                 "next             use it in a case beside this one, with volume_correction: none and "
                 "calibration: continuum:\n"
                 "                 micromodulus: {{ kernel: shells, file: {} }}\n",
                 file.string());
  return fmt::to_string(out);
}

template <int Dim>
std::string dispersion_plan_text(const Lattice<Dim>& lattice, const DispersionSpec& spec) {
  fmt::memory_buffer out;
  auto to = std::back_inserter(out);
  fmt::format_to(to, "dispersion\n{}", lattice_text(lattice));
  const auto corners = path_corners<Dim>(spec);
  std::vector<std::string> texts(corners.size());
  for (std::size_t k = 0; k < corners.size(); ++k) texts[k] = point_text<Dim>(corners[k]);
  fmt::format_to(to, "path             {} points along {} pi/dx\n", spec.points, fmt::join(texts, " - "));
  fmt::format_to(to, "zone             {} points per axis\n", survey_points(spec, Dim));
  if (spec.polar)
    fmt::format_to(to, "polar            {} directions at {:.6g} pi/dx\n", spec.polar->directions,
                   spec.polar->wave_number);
  if (spec.optimise) {
    fmt::format_to(to, "optimise         {} coefficients, {} exact long-wave speed{}; {}\n",
                   lattice.family.shell.size(), Dim == 1 ? "an" : "two", Dim == 1 ? "" : "s",
                   word(spec.optimise->method));
  }
  return fmt::to_string(out);
}

#define PERIMODE_DISPERSION_TEXT(D)                                                                      \
  template std::string lattice_text<D>(const Lattice<D>&);                                               \
  template std::string waves_text<D>(const Lattice<D>&, const LatticeReport<D>&, const DispersionSpec&); \
  template std::string optimised_text<D>(const Lattice<D>&, const OptimisedReport<D>&,                   \
                                         const DispersionSpec&, const std::filesystem::path&);           \
  template std::string dispersion_plan_text<D>(const Lattice<D>&, const DispersionSpec&)
PERIMODE_DISPERSION_TEXT(1);
PERIMODE_DISPERSION_TEXT(2);
PERIMODE_DISPERSION_TEXT(3);
#undef PERIMODE_DISPERSION_TEXT

}  // namespace perimode::cli
