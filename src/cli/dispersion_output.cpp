// SPDX-License-Identifier: BSD-3-Clause
#include "dispersion_output.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace perimode::cli {

namespace {

using Json = nlohmann::ordered_json;

using std::numbers::pi;

Branch kind_of(int branch) { return branch == 0 ? Branch::pressure : Branch::shear; }

/// Unknown numbers become null.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

template <int Dim>
std::vector<TableCell> coordinates(const Point<Dim>& point) {
  return {point.data(), point.data() + Dim};
}

template <int Dim>
std::vector<std::string> names(const std::string& name) {
  std::vector<std::string> columns(Dim);
  for (int a = 0; a < Dim; ++a) columns[static_cast<std::size_t>(a)] = name + "xyz"[a];
  return columns;
}

template <class T>
void append(std::vector<T>& to, std::vector<T> from) {
  for (T& item : from) to.push_back(std::move(item));
}

template <int Dim>
Json array(const Point<Dim>& point) {
  return std::vector<double>(point.data(), point.data() + Dim);
}

Json error_json(const ContourError& error) { return {{"l1", error.l1}, {"l2", error.l2}}; }

}  // namespace

double stepped_frequency(double omega, const DispersionSpec& spec) {
  return spec.integrator == StepIntegrator::newmark ? newmark_frequency(omega, *spec.time_step)
                                                    : central_difference_frequency(omega, *spec.time_step);
}

template <int Dim>
Table waves_table(const Lattice<Dim>& lattice, const std::vector<PlaneWaves<Dim>>& waves,
                  const DispersionSpec& spec) {
  Table table;
  table.columns = names<Dim>("k_");
  append(table.columns, {"branch", "angular_frequency", "phase_velocity", "group_velocity",
                         "classical_angular_frequency", "continuum_angular_frequency"});
  if (spec.time_step) table.columns.emplace_back("stepped_angular_frequency");
  if (spec.finite_difference) table.columns.emplace_back("finite_difference_angular_frequency");
  table.rows.reserve(waves.size() * Dim);
  for (const PlaneWaves<Dim>& wave : waves) {
    const double k = wave.k.norm();
    double continuum[] = {0.0, 0.0};
    for (int b = 0; b < std::min(Dim, 2); ++b)
      continuum[b] = continuum_frequency(lattice.medium, kind_of(b), k);
    for (int b = 0; b < Dim; ++b) {
      const auto at = static_cast<std::size_t>(b);
      const double speed = classical_speed(lattice.medium, kind_of(b));
      const double omega = wave.angular_frequency[at];
      std::vector<TableCell> row = coordinates<Dim>(wave.k);
      append(row, {branch_name(b, Dim), omega, wave.phase_velocity[at], wave.group_velocity[at].norm(),
                   speed * k, continuum[std::min(b, 1)]});
      if (spec.time_step) row.emplace_back(stepped_frequency(omega, spec));
      if (spec.finite_difference) {
        row.emplace_back(
            finite_difference_frequency(k, speed, lattice.family.spacing, *spec.finite_difference));
      }
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

template <int Dim>
Table polar_table(const Lattice<Dim>& lattice, const DispersionSpec& spec) {
  Table table;
  table.columns = {"angle",          "branch",         "angular_frequency",
                   "phase_velocity", "group_velocity", "classical_velocity"};
  append(table.columns, names<Dim>("group_velocity_"));
  append(table.columns, names<Dim>("polarisation_"));
  const double k = spec.polar->wave_number * pi / lattice.family.spacing;
  const auto around = waves_around(lattice, k, spec.polar->directions);
  table.rows.reserve(around.size() * Dim);
  for (std::size_t n = 0; n < around.size(); ++n) {
    const PlaneWaves<Dim>& wave = around[n];
    const double angle = 2.0 * pi * static_cast<double>(n) / static_cast<double>(around.size());
    for (int b = 0; b < Dim; ++b) {
      const auto at = static_cast<std::size_t>(b);
      std::vector<TableCell> row = {angle,
                                    branch_name(b, Dim),
                                    wave.angular_frequency[at],
                                    wave.phase_velocity[at],
                                    wave.group_velocity[at].norm(),
                                    classical_speed(lattice.medium, kind_of(b))};
      append(row, coordinates<Dim>(wave.group_velocity[at]));
      append(row, coordinates<Dim>(wave.polarisation.col(b)));
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

template <int Dim>
Table zone_table(const Lattice<Dim>& lattice, int n) {
  Table table;
  table.columns = names<Dim>("k_");
  append(table.columns, {"branch", "angular_frequency", "phase_velocity", "classical_velocity"});
  const double step = pi / (lattice.family.spacing * (n - 1));
  std::size_t count = 1;
  for (int a = 0; a < Dim; ++a) count *= static_cast<std::size_t>(n);
  table.rows.reserve(count * Dim);
  for (std::size_t i = 0; i < count; ++i) {
    Point<Dim> k;
    std::size_t rest = i;
    for (int a = 0; a < Dim; ++a) {  // x runs fastest
      k[a] = step * static_cast<double>(rest % static_cast<std::size_t>(n));
      rest /= static_cast<std::size_t>(n);
    }
    const Point<Dim> direction = i == 0 ? Point<Dim>(Point<Dim>::Unit(0)) : Point<Dim>(k.normalized());
    const PlaneWaves<Dim> wave = plane_waves(lattice, k, direction);
    for (int b = 0; b < Dim; ++b) {
      const auto at = static_cast<std::size_t>(b);
      std::vector<TableCell> row = coordinates<Dim>(k);
      append(row, {branch_name(b, Dim), wave.angular_frequency[at], wave.phase_velocity[at],
                   classical_speed(lattice.medium, kind_of(b))});
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

template <int Dim>
Table bands_table(const std::vector<CornerBand<Dim>>& bands) {
  Table table;
  table.columns = names<Dim>("corner_");
  append(table.columns, {"branch", "long_wave_ratio", "crossings", "cut_off", "cut_off_k", "band_k",
                         "band_frequency", "worst_overshoot", "worst_overshoot_k"});
  table.rows.reserve(bands.size());
  for (const CornerBand<Dim>& entry : bands) {
    const BranchBand& band = entry.band;
    std::vector<TableCell> row = coordinates<Dim>(entry.corner);
    append(row, {std::string(entry.branch == Branch::pressure ? "P" : "S"), band.long_wave_ratio,
                 fmt::format("{:.17g}", fmt::join(band.crossings, ";")), band.cut_off, band.cut_off_k,
                 band.band_k, band.band_frequency, band.worst_overshoot, band.worst_overshoot_k});
    table.rows.push_back(std::move(row));
  }
  return table;
}

template <int Dim>
Table coefficients_table(const Family<Dim>& family, const std::vector<double>& alpha) {
  Table table;
  table.columns = names<Dim>("d");
  append(table.columns, {"distance", "alpha"});
  table.rows.reserve(alpha.size());
  for (std::size_t orbit = 0; orbit < alpha.size(); ++orbit) {
    std::vector<TableCell> row;
    double square = 0.0;
    for (const int d : family.shell[orbit]) {
      row.emplace_back(Offset{d});
      square += static_cast<double>(d) * d;
    }
    append(row, {family.spacing * std::sqrt(square), alpha[orbit]});
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string influence_yaml(const InfluenceFit& fit, double horizon) {
  const Micromodulus& m = fit.micromodulus;
  return fmt::format(
      "# Multiplier of the constant kernel, a0 + sum_j a_j cos(j w r/spacing), fitted for the spacing "
      "{:.17g} m\n"
      "# and the horizon {:.17g} m. Paste it into `material` of a case; it needs a grid of this spacing,\n"
      "# volume_correction: none and calibration: continuum.\n"
      "micromodulus:\n  kernel: fourier\n  a0: {:.17g}\n  a: [{:.17g}]\n  w: {:.17g}\n",
      m.spacing, horizon, m.a0, fmt::join(m.a, ", "), m.w);
}

template <int Dim>
Json bands_json(const std::vector<CornerBand<Dim>>& bands) {
  Json list = Json::array();
  for (const CornerBand<Dim>& entry : bands) {
    const BranchBand& band = entry.band;
    list.push_back({{"corner", array<Dim>(entry.corner)},
                    {"branch", entry.branch == Branch::pressure ? "P" : "S"},
                    {"long_wave_ratio", number(band.long_wave_ratio)},
                    {"crossings", band.crossings},
                    {"cut_off", number(band.cut_off)},
                    {"cut_off_k", number(band.cut_off_k)},
                    {"band_k", number(band.band_k)},
                    {"band_frequency", number(band.band_frequency)},
                    {"worst_overshoot", number(band.worst_overshoot)},
                    {"worst_overshoot_k", number(band.worst_overshoot_k)}});
  }
  return list;
}

template <int Dim>
Json survey_json(const ZoneSurvey<Dim>& survey) {
  Json json = {{"points_per_axis", survey.points_per_axis},
               {"least_squared", number(survey.least_squared)},
               {"least_at", array<Dim>(survey.least_at)},
               {"least_speed_squared", number(survey.least_speed_squared)},
               {"omega_max", number(survey.omega_max)},
               {"omega_max_at", array<Dim>(survey.omega_max_at)},
               {"stable_step", number(survey.stable_step)},
               {"phase_error", {{"P", number(survey.phase_error[0])}}},
               {"worst_phase_error", {{"P", number(survey.worst_phase_error[0])}}}};
  if (Dim > 1) {
    json["phase_error"]["S"] = number(survey.phase_error[1]);
    json["worst_phase_error"]["S"] = number(survey.worst_phase_error[1]);
  }
  return json;
}

template <int Dim>
Json certificate_json(const OptimisedReport<Dim>& optimised) {
  const OptimisedMicromodulus& r = optimised.result;
  if (r.status == OptimiseStatus::infeasible)
    return {{"feasible", false}, {"largest_feasible_bound", number(r.largest_feasible_bound)}};
  const ZoneSurvey<Dim>& survey = optimised.report.survey;
  return {{"feasible", true},
          {"constraint_error", number(r.constraint_error)},
          {"optimality", number(r.optimality)},
          {"active", r.active},
          {"stable", survey.least_squared >= 0.0},
          {"least_squared", number(survey.least_squared)},
          {"omega_max", number(survey.omega_max)},
          {"stable_step", number(survey.stable_step)},
          {"original", error_json(optimised.before)},
          {"optimised", error_json(optimised.after)},
          {"ratio",
           {{"l1", number(optimised.after.l1 / optimised.before.l1)},
            {"l2", number(optimised.after.l2 / optimised.before.l2)}}}};
}

template <int Dim>
Json optimised_json(const OptimisedReport<Dim>& optimised, const DispersionSpec& spec) {
  const OptimiseOptions& o = *spec.optimise;
  Json json = {{"method", word(o.method)},
               {"norm", word(o.norm)},
               {"domain", word(o.domain)},
               {"lower_bound", o.lower_bound ? Json(*o.lower_bound) : Json()},
               {"poissons_ratio", o.poissons_ratio ? Json(*o.poissons_ratio) : Json("theory")},
               {"weights", o.weights},
               {"solver", optimised.result.solver}};
  if (optimised.result.status == OptimiseStatus::infeasible) return json;
  json["alpha"] = optimised.result.alpha;
  json["bands"] = bands_json(optimised.report.bands);
  json["zone"] = survey_json(optimised.report.survey);
  if (optimised.critical_stretch != 0.0) {
    json["critical_stretch"] = {{"original", number(optimised.critical_stretch)},
                                {"optimised", number(optimised.optimised_critical_stretch)}};
    if (optimised.fit) json["critical_stretch"]["fitted"] = number(optimised.fitted_critical_stretch);
  }
  if (!optimised.fit) return json;
  const InfluenceFit& fit = *optimised.fit;
  json["fit"] = {{"a0", fit.micromodulus.a0},
                 {"a", fit.micromodulus.a},
                 {"w", fit.micromodulus.w},
                 {"largest_deviation", number(fit.largest_deviation)},
                 {"energy_ratio", number(fit.energy_ratio)},
                 {"least", number(fit.least)},
                 {"least_at", number(fit.least_at)},
                 {"error", error_json(optimised.fitted)},
                 {"least_squared", number(optimised.fitted_survey.least_squared)},
                 {"stable_step", number(optimised.fitted_survey.stable_step)}};
  return json;
}

const char* word(OptimiseMethod method) {
  switch (method) {
    case OptimiseMethod::least_squares:
      return "least_squares";
    case OptimiseMethod::point_collocation:
      return "point_collocation";
    case OptimiseMethod::subdomain_collocation:
      return "subdomain_collocation";
    case OptimiseMethod::galerkin:
      break;
  }
  return "galerkin";
}

const char* word(ErrorNorm norm) { return norm == ErrorNorm::l1 ? "l1" : "l2"; }

const char* word(ErrorDomain domain) { return domain == ErrorDomain::zone ? "zone" : "contour"; }

const char* word(StepIntegrator integrator) {
  return integrator == StepIntegrator::newmark ? "newmark" : "central_difference";
}

template <int Dim>
std::string point_text(const Point<Dim>& point, double unit) {
  const std::vector<double> numbers(point.data(), point.data() + Dim);
  std::vector<std::string> texts(numbers.size());
  for (std::size_t a = 0; a < numbers.size(); ++a) {
    const double value = numbers[a] / unit;
    texts[a] = fmt::format("{:.4g}", std::abs(value) < 1e-12 ? 0.0 : value);
  }
  return fmt::format("({})", fmt::join(texts, ", "));
}

#define PERIMODE_DISPERSION_OUTPUT(D)                                                 \
  template Table waves_table<D>(const Lattice<D>&, const std::vector<PlaneWaves<D>>&, \
                                const DispersionSpec&);                               \
  template Table polar_table<D>(const Lattice<D>&, const DispersionSpec&);            \
  template Table zone_table<D>(const Lattice<D>&, int);                               \
  template Table bands_table<D>(const std::vector<CornerBand<D>>&);                   \
  template Table coefficients_table<D>(const Family<D>&, const std::vector<double>&); \
  template Json bands_json<D>(const std::vector<CornerBand<D>>&);                     \
  template Json survey_json<D>(const ZoneSurvey<D>&);                                 \
  template Json certificate_json<D>(const OptimisedReport<D>&);                       \
  template Json optimised_json<D>(const OptimisedReport<D>&, const DispersionSpec&);  \
  template std::string point_text<D>(const Point<D>&, double)
PERIMODE_DISPERSION_OUTPUT(1);
PERIMODE_DISPERSION_OUTPUT(2);
PERIMODE_DISPERSION_OUTPUT(3);
#undef PERIMODE_DISPERSION_OUTPUT

}  // namespace perimode::cli
