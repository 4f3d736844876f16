// SPDX-License-Identifier: BSD-3-Clause
#include "lattices.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "perimode/assembly/fields.hpp"
#include "perimode/dispersion/symbol.hpp"
#include "pulse.hpp"
#include "studies/common/models.hpp"
#include "studies/common/release.hpp"

namespace perimode::studies {
namespace {

constexpr double bulk_modulus = 1.0;

/// All families within reach of the middle one are complete, and so are theirs.
template <int Dim>
double middle_energy(int squared_ratio, Calibration calibration, double stretch) {
  const int reach = static_cast<int>(std::sqrt(squared_ratio) + 1e-9);
  const std::vector<int> cells(Dim, 4 * reach + 1);
  const Body<Dim> body = build_body<Dim>(pmb_lattice(cells, 1.0, squared_ratio, calibration));
  Eigen::VectorXd u(Dim * static_cast<Eigen::Index>(body.count()));
  for (Index i = 0; i < body.count(); ++i)
    u.segment<Dim>(Dim * static_cast<Eigen::Index>(i)) =
        stretch * body.particles.position[static_cast<std::size_t>(i)];
  return energy_density(body, u)[body.count() / 2];
}

/// (u - exact)/max|u| is no measure of a peak: the place of the top is.
double top_of(const std::vector<double>& x, const std::function<double(std::size_t)>& u) {
  std::size_t top = 1;
  for (std::size_t i = 1; i + 1 < x.size(); ++i)
    if (u(i) > u(top)) top = i;
  const double a = u(top - 1), b = u(top), c = u(top + 1);
  return x[top] + 0.5 * (a - c) / (a - 2.0 * b + c) * (x[1] - x[0]);
}

}  // namespace

const char* name_of(Calibration calibration) {
  return calibration == Calibration::continuum ? "original" : "normalised";
}

void add_energy_error(int dimension, int squared_ratio, Calibration calibration, Results& results) {
  constexpr double stretch = 0.05;
  const bool solid = dimension == 3;
  const double energy = solid ? middle_energy<3>(squared_ratio, calibration, stretch)
                              : middle_energy<2>(squared_ratio, calibration, stretch);
  const double exact = (solid ? 4.5 : 2.4) * bulk_modulus * stretch * stretch;
  results[{"energy_error", fmt::format("{}{}", name_of(calibration), solid ? "" : " 2D"), 0.0, squared_ratio,
           0.0}] = energy / exact - 1.0;
}

void add_energy_scan(Table& profiles) {
  const Model model = pmb_lattice({1, 1, 1}, 1.0, 4, Calibration::continuum);
  for (int i = 0; i <= 1600; ++i) {
    const double horizon = 2.0 + i / 400.0;
    const Medium medium = {model.material, {3, Plane::strain, 1.0}, horizon};
    const double factor = calibration_factor<3>(medium, make_family<3>(1.0, horizon, VolumeCorrection::none));
    profiles.rows.push_back({std::string("energy original"), 0.0, horizon, 1.0 / factor - 1.0});
  }
}

void add_speed(int squared_ratio, Calibration calibration, bool in_time, Results& results) {
  constexpr int cells = 400;
  const Model model = pmb_row(cells, squared_ratio, calibration, true);
  const double long_wave = 1e-5 * cells;
  results[{"speed", name_of(calibration), 0.0, squared_ratio, 0.0}] =
      lattice_relation(model)(long_wave) / long_wave / pmb_speed();
  if (!in_time) return;

  // u = cos(k x) cos(omega t) with k = 2 pi: one and a quarter classical periods after its start the lattice
  // is ahead by the phase -asin(u/u0), unless it is faster or slower by more than 20 %.
  const double k = 2.0 * std::numbers::pi, turns = 1.25, t = turns / pmb_speed();
  Body<3> body = build_body<3>(model);
  const Eigen::VectorXd u0 = along_x(body, [&](double x) { return std::cos(k * x); });
  const Eigen::VectorXd u = release(body, u0, t / 4000, {t}).front();
  const double ahead = -std::asin(u.dot(u0) / u0.squaredNorm());
  results[{"signal_speed", name_of(calibration), 0.0, squared_ratio, 0.0}] =
      1.0 + ahead / (2.0 * std::numbers::pi * turns);
}

void add_peak(int cells, int squared_ratio, Calibration calibration, int steps, Results& results,
              Table& profiles) {
  const Model model = pmb_row(cells, squared_ratio, calibration);
  Body<3> row = build_body<3>(model);
  const auto pulse = [](double x) { return end_pulse(x, 0.03); };
  const Eigen::VectorXd u0 = along_x(row, pulse);
  const double t = pulse_travel / pmb_speed();
  const Eigen::VectorXd u = release(row, u0, t / steps, {t}).front();

  std::vector<double> x, start;
  for (Index i = 0; i < row.count(); ++i) {
    x.push_back(row.particles.position[static_cast<std::size_t>(i)][0]);
    start.push_back(u0[3 * static_cast<Eigen::Index>(i)]);
  }
  const auto found = [&](std::size_t i) { return u[3 * static_cast<Eigen::Index>(i)]; };
  const auto waves = released_lattice(Ends::antimirror, 1.0, start, stepped_relation(model, t / steps));
  const double peak = top_of(x, found);
  const Key key = {"peak", name_of(calibration), 0.0, squared_ratio, static_cast<double>(cells)};
  results[key] = peak;
  double most = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i)
    most = std::max(most, std::abs(found(i) - displacement(waves, x[i], t)));
  results[{"discrete_error", key.body, 0.0, squared_ratio, key.at}] = most;
  const std::string curve = fmt::format("{} {} {}", key.body, squared_ratio, cells);
  for (std::size_t i = 0; i < x.size(); ++i) profiles.rows.push_back({curve, t, x[i], found(i)});
}

}  // namespace perimode::studies
