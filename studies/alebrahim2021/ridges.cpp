// SPDX-License-Identifier: BSD-3-Clause
#include "ridges.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "perimode/assembly/body.hpp"
#include "perimode/dispersion/wave_record.hpp"
#include "perimode/dispersion/zone.hpp"
#include "perimode/dynamics/transient.hpp"

namespace perimode::studies {
namespace {

using std::numbers::pi;
constexpr double dt = 0.1, width = 0.6;
constexpr std::size_t first_k = 6;  // the slowest waves have less than a few periods in the record
constexpr double highest = 4.2;     // rad/s, top of the figures

/// Lets the body go from a Gaussian around its middle particle, `direction` times 1, and hands over every
/// step's displacements.
template <int Dim>
void let_go(const RidgeRun& run, const Point<Dim>& direction,
            const std::function<void(const TransientFrame<Dim>&)>& frame) {
  Body<Dim> body = build_body<Dim>(periodic_model<Dim>(run.n, run.alpha, run.cells));
  InitialState initial;
  initial.displacement = Eigen::VectorXd::Zero(Dim * static_cast<Eigen::Index>(body.count()));
  const Index half = run.cells / 2;
  const Point<Dim> middle = Point<Dim>::Constant(static_cast<double>(half) + 0.5);
  for (Index i = 0; i < body.count(); ++i) {
    const double squared = (body.particles.position[static_cast<std::size_t>(i)] - middle).squaredNorm();
    initial.displacement.segment<Dim>(Dim * static_cast<Eigen::Index>(i)) =
        std::exp(-0.5 * squared / (width * width)) * direction;
  }
  TransientOptions options;
  options.dt = dt;
  options.end = (run.instants - 1) * dt;
  options.history_every = std::numeric_limits<int>::max();
  options.fields_every = 1;
  TransientObserver<Dim> observer;
  observer.fields = frame;
  const TransientResult result = run_transient<Dim>(body, options, initial, observer);
  if (result.status != TransientStatus::done) throw Error(ErrorKind::solver_failure, result.message);
}

/// Largest differences of a ridge from the lattice's omega and from what the integrator makes of it.
struct Misses {
  double lattice = 0.0;
  double stepped = 0.0;
  double shift = 0.0;  // what the time step alone makes of omega
  void add(double found, double omega) {
    lattice = std::max(lattice, std::abs(found - omega));
    stepped = std::max(stepped, std::abs(found - central_difference_frequency(omega, dt)));
    shift = std::max(shift, central_difference_frequency(omega, dt) - omega);
  }
};

void add_misses(const std::string& body, int n, const Misses& misses, double bin, Results& results) {
  results[key("ridge_error", body, n)] = misses.lattice;
  results[key("ridge_bins", body, n)] = misses.stepped / bin;
  results[key("time_step_shift", body, n)] = misses.shift;
}

/// A frequency at which waves of one kx and all k_y gather, and where it lies.
struct Gathering {
  double omega = 0.0;
  const char* place = "";
};

/// Local extrema over k_y of both branches, without waves whose u_x is nothing there.
std::vector<Gathering> gathering_frequencies(const Lattice<2>& plate, double kx) {
  constexpr int steps = 200;
  std::array<std::vector<double>, 2> omega, along_x;
  for (int i = -1; i <= steps + 1; ++i) {  // one beyond either end: both ends are extrema by symmetry
    const PlaneWaves<2> waves = plane_waves<2>(plate, {kx, pi * i / steps}, Point<2>::UnitX());
    // By size: smooth in k_y where P and S change their names.
    const int lower = waves.angular_frequency[0] < waves.angular_frequency[1] ? 0 : 1;
    for (const int b : {0, 1}) {
      const int branch = b == 0 ? lower : 1 - lower;
      omega[static_cast<std::size_t>(b)].push_back(waves.angular_frequency[static_cast<std::size_t>(branch)]);
      along_x[static_cast<std::size_t>(b)].push_back(std::abs(waves.polarisation(0, branch)));
    }
  }
  std::vector<Gathering> found;
  for (std::size_t b = 0; b < 2; ++b)
    for (std::size_t i = 1; i + 1 < omega[b].size(); ++i)
      if ((omega[b][i] - omega[b][i - 1]) * (omega[b][i + 1] - omega[b][i]) <= 0.0 && along_x[b][i] > 1e-6)
        found.push_back({omega[b][i], i == 1 ? "k_y=0" : (i == steps + 1 ? "k_y=pi" : "between")});
  return found;
}

/// One row of nodes: spectrum, its peaks and where they should be.
void add_row(const RidgeRun& run, const Lattice<2>& plate, const SpaceTime& row, Results& results,
             Figure* figure) {
  const Spectrum spectrum = space_time_spectrum(row);
  const std::vector<RidgePoint> peaks = spectrum_peaks(spectrum, 0.1);
  int near = 0, count = 0;
  double at = -1.0;
  std::vector<Gathering> gathering;
  for (const RidgePoint& peak : peaks) {
    if (peak.k < spectrum.k[first_k]) continue;
    if (peak.k != at) gathering = gathering_frequencies(plate, peak.k);
    at = peak.k;
    ++count;
    near += std::any_of(gathering.begin(), gathering.end(), [&](const Gathering& wave) {
      return std::abs(central_difference_frequency(wave.omega, dt) - peak.omega) <= spectrum.resolution;
    });
  }
  results[key("row_peaks", "plate " + run.body, run.n)] = count;
  results[key("row_ghost", "plate " + run.body, run.n)] = static_cast<double>(near) / count;
  if (figure == nullptr) return;
  add_map(*figure, run.row_panel, spectrum, Reference::whole, highest, 1, 1);
  for (const double k : spectrum.k)
    for (const Gathering& wave : gathering_frequencies(plate, k))
      add_point(*figure, run.row_panel, wave.place, k, wave.omega);
}

}  // namespace

void run_bar_ridge(const RidgeRun& run, Results& results, Figure* figure) {
  SpaceTime field = {1.0, dt, Eigen::MatrixXd(run.cells, run.instants)};
  let_go<1>(run, Point<1>(1.0), [&](const TransientFrame<1>& frame) {
    field.values.col(static_cast<Eigen::Index>(frame.step)) = frame.displacement;
  });
  const Lattice<1> bar = modified_lattice<1>(run.n, run.alpha);
  const Spectrum spectrum = space_time_spectrum(field);
  const std::vector<RidgePoint> ridge = spectrum_ridge(spectrum);
  Misses misses;
  for (std::size_t q = first_k; q < ridge.size(); ++q)
    misses.add(ridge[q].omega, bar_frequency(bar, ridge[q].k));
  add_misses("bar " + run.body, run.n, misses, spectrum.resolution, results);
  if (figure == nullptr) return;
  add_map(*figure, run.panel, spectrum, Reference::each_k, highest, 2, 2);
  for (std::size_t q = 0; q < ridge.size(); ++q) {
    add_point(*figure, run.panel, "local", ridge[q].k, ridge[q].k);
    add_point(*figure, run.panel, "lattice", ridge[q].k, bar_frequency(bar, ridge[q].k));
    if (q >= first_k) add_point(*figure, run.panel, "ridge", ridge[q].k, ridge[q].omega);
  }
}

void run_plate_ridge(const RidgeRun& run, Results& results, Figure* figure) {
  const Body<2> body = build_body<2>(periodic_model<2>(run.n, run.alpha, run.cells));
  WaveRecorder<2> record(*body.particles.grid,
                         waves_on_path<2>(*body.particles.grid, irreducible_contour<2>()),
                         static_cast<std::size_t>(run.instants));
  // A row shows gathering waves before they come round the periodic grid; later it shows single ones.
  const auto row_instants = std::min<Eigen::Index>(run.instants, static_cast<Eigen::Index>(run.cells / dt));
  SpaceTime row = {1.0, dt, Eigen::MatrixXd(run.cells, row_instants)};
  let_go<2>(run, Point<2>(1.0, 0.4), [&](const TransientFrame<2>& frame) {
    record.add(frame.time, {frame.displacement.data(), static_cast<std::size_t>(frame.displacement.size())});
    const Eigen::Index first = 2 * static_cast<Eigen::Index>(run.cells) * (run.cells / 2);
    if (frame.step < row_instants)
      for (Eigen::Index i = 0; i < run.cells; ++i)
        row.values(i, static_cast<Eigen::Index>(frame.step)) = frame.displacement[first + 2 * i];
  });
  const Lattice<2> plate = modified_lattice<2>(run.n, run.alpha);
  const GridWaves<2>& waves = record.waves();
  Misses misses;
  double bin = 0.0;
  for (int branch = 0; branch < 2; ++branch) {
    std::vector<Point<2>> polarisation;
    std::vector<double> omega;
    polarisation.reserve(waves.k.size());
    omega.reserve(waves.k.size());
    for (std::size_t q = 0; q < waves.k.size(); ++q) {
      const PlaneWaves<2> wave = plane_waves<2>(plate, waves.k[q], waves.direction[q]);
      polarisation.emplace_back(wave.polarisation.col(branch));
      omega.push_back(wave.angular_frequency[static_cast<std::size_t>(branch)]);
    }
    const Spectrum spectrum = wave_spectrum<2>(record, polarisation);
    bin = spectrum.resolution;
    const std::vector<RidgePoint> ridge = spectrum_ridge(spectrum);
    const std::string& panel = branch == 0 ? run.panel : run.shear_panel;
    const double speed = classical_speed(plate.medium, branch == 0 ? Branch::pressure : Branch::shear);
    if (figure != nullptr) add_map(*figure, panel, spectrum, Reference::each_k, highest, 1, 1);
    for (std::size_t q = 0; q < ridge.size(); ++q) {
      const double periods = omega[q] * run.instants * dt / (2.0 * pi);
      if (periods >= first_k) misses.add(ridge[q].omega, omega[q]);
      if (figure == nullptr) continue;
      add_point(*figure, panel, "local", waves.length[q], speed * waves.k[q].norm());
      add_point(*figure, panel, "lattice", waves.length[q], omega[q]);
      if (periods >= first_k) add_point(*figure, panel, "ridge", waves.length[q], ridge[q].omega);
    }
  }
  add_misses("plate " + run.body, run.n, misses, bin, results);
  if (!run.row_panel.empty()) add_row(run, plate, row, results, figure);
}

}  // namespace perimode::studies
