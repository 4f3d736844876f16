// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "perimode/dispersion/symbol.hpp"
#include "perimode/dispersion/wave_record.hpp"
#include "perimode/dynamics/transient.hpp"
#include "perimode/reference/wave_in_bar.hpp"
#include "support/models.hpp"

namespace perimode::test {

constexpr double time_step = 0.1;  ///< in units of spacing sqrt(rho/E)

/// A periodic lattice, its symbol and the waves of a run on it.
template <int Dim>
struct RecordedRun {
  WaveRecorder<Dim> record;
  std::function<Eigen::Matrix<double, Dim, Dim>(const Point<Dim>&)> symbol;
};

/// Let go at rest from a Gaussian exp(-r^2/(2 0.6^2)) about one particle, displaced along (1, 0.6): both
/// branches of every wave vector that matters move. 2D in plane strain. `also` sees every frame.
template <int Dim>
RecordedRun<Dim> recorded_run(const std::array<int, Dim>& cells, double ratio, int instants,
                              const std::vector<Point<Dim>>& corners,
                              const std::function<void(Eigen::Index, const Eigen::VectorXd&)>& also = {}) {
  Model model = box_model({cells.begin(), cells.end()}, 1.0, ratio);
  model.plane = Plane::strain;
  for (std::size_t a = 0; a < Dim; ++a) model.periodic[a] = true;
  Body<Dim> body = build_body<Dim>(model);
  InitialState initial;
  initial.displacement.setZero(Dim * static_cast<Eigen::Index>(body.count()));
  Point<Dim> centre, direction = Point<Dim>::Unit(0);
  for (int a = 0; a < Dim; ++a) centre[a] = cells[static_cast<std::size_t>(a)] / 2 + 0.5;
  if constexpr (Dim > 1) direction[1] = 0.6;
  for (Index i = 0; i < body.count(); ++i) {
    const double r = (body.particles.position[static_cast<std::size_t>(i)] - centre).norm();
    initial.displacement.template segment<Dim>(Dim * static_cast<Eigen::Index>(i)) =
        std::exp(-r * r / (2.0 * 0.6 * 0.6)) * direction;
  }
  TransientOptions options;
  options.dt = time_step;
  options.end = (instants - 1) * time_step;
  options.history_every = instants;
  options.fields_every = 1;
  const Grid<Dim>& grid = *body.particles.grid;
  WaveRecorder<Dim> record(grid, waves_on_path<Dim>(grid, corners), static_cast<std::size_t>(instants));
  TransientObserver<Dim> observer;
  observer.fields = [&](const TransientFrame<Dim>& frame) {
    record.add(frame.time, {frame.displacement.data(), static_cast<std::size_t>(frame.displacement.size())});
    if (also) also(static_cast<Eigen::Index>(frame.step), frame.displacement);
  };
  if (run_transient<Dim>(body, options, initial, observer).status != TransientStatus::done)
    throw Error(ErrorKind::solver_failure, "the run was unstable");

  const Medium medium = {model.material, {Dim, model.plane, 1.0}, ratio};
  const Family<Dim> family = make_family<Dim>(1.0, ratio, model.volume_correction);
  const std::vector<double> rates = bond_rates<Dim>(medium, family);
  return {std::move(record),
          [family, rates](const Point<Dim>& k) { return lattice_symbol<Dim>(family, rates, k); }};
}

/// Largest distance, in bins, of the ridges of P and S from the stepped lattice along O-M-Y-O.
struct Deviation {
  double bins = 0.0;
  int compared = 0;
};

/// A square plate. Waves below 8 bins are left out: what leaks over from -omega is more than a thousandth of
/// a bin there.
inline Deviation contour_deviation(int cells, int instants, double ratio) {
  const RecordedRun<2> run =
      recorded_run<2>({cells, cells}, ratio, instants, {{0, 0}, {1, 0}, {1, 1}, {0, 0}});
  const GridWaves<2>& waves = run.record.waves();
  std::array<std::vector<Point<2>>, 2> polarisation;
  std::array<std::vector<double>, 2> omega;
  for (std::size_t w = 0; w < waves.k.size(); ++w) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> waves_of(run.symbol(waves.k[w]));
    const int p = std::abs(waves_of.eigenvectors().col(0).dot(waves.direction[w])) >
                          std::abs(waves_of.eigenvectors().col(1).dot(waves.direction[w]))
                      ? 0
                      : 1;
    for (const int branch : {0, 1}) {
      const int column = branch == 0 ? p : 1 - p;
      polarisation[static_cast<std::size_t>(branch)].push_back(waves_of.eigenvectors().col(column));
      const double squared = std::max(0.0, waves_of.eigenvalues()[column]);
      omega[static_cast<std::size_t>(branch)].push_back(stepped_frequency(std::sqrt(squared), time_step));
    }
  }
  Deviation worst;
  for (const std::size_t branch : {0U, 1U}) {
    const Spectrum spectrum = wave_spectrum(run.record, polarisation[branch]);
    const std::vector<RidgePoint> ridge = spectrum_ridge(spectrum);
    for (std::size_t w = 0; w < ridge.size(); ++w) {
      if (omega[branch][w] < 8.0 * spectrum.resolution) continue;
      const double distance = std::abs(ridge[w].omega - omega[branch][w]) / spectrum.resolution;
      worst.bins = std::isnan(distance) ? distance : std::max(worst.bins, distance);
      ++worst.compared;
      if (std::isnan(distance)) return worst;
    }
  }
  return worst;
}

}  // namespace perimode::test
