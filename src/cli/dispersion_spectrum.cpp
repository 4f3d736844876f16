// SPDX-License-Identifier: BSD-3-Clause
#include "dispersion_spectrum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "dispersion_output.hpp"
#include "machine.hpp"
#include "perimode/dispersion/waves.hpp"
#include "perimode/io/run_fields.hpp"
#include "perimode/io/table.hpp"

namespace perimode::cli {

namespace {

/// Beside the loudest branch a wave below this is silent.
constexpr double silent = 1e-6;

struct Heard {
  int waves = 0;
  double largest_deviation = 0.0;  ///< of the ridge from the curve, rad/s
};

template <int Dim>
void add_ridge(Table& table, Heard& all, const GridWaves<Dim>& waves,
               const std::vector<PlaneWaves<Dim>>& exact, int branch, const std::vector<RidgePoint>& ridge,
               double loudest, const DispersionSpec& spec) {
  for (std::size_t w = 0; w < waves.k.size(); ++w) {
    std::vector<TableCell> row(waves.k[w].data(), waves.k[w].data() + Dim);
    const double omega = exact[w].angular_frequency[static_cast<std::size_t>(branch)];
    const bool heard = ridge[w].amplitude >= silent * loudest;
    row.emplace_back(waves.length[w]);
    row.emplace_back(branch_name(branch, Dim));
    row.emplace_back(heard ? ridge[w].omega : std::numeric_limits<double>::quiet_NaN());
    row.emplace_back(ridge[w].amplitude);
    row.emplace_back(omega);
    const double expected = spec.time_step ? stepped_frequency(omega, spec) : omega;
    if (spec.time_step) row.emplace_back(expected);
    if (heard && waves.k[w].norm() > 0.0) {
      ++all.waves;
      all.largest_deviation = std::max(all.largest_deviation, std::abs(ridge[w].omega - expected));
    }
    table.rows.push_back(std::move(row));
  }
}

void add_spectrum(Table& table, const std::string& branch, const Spectrum& spectrum) {
  for (std::size_t w = 0; w < spectrum.k.size(); ++w) {
    for (std::size_t s = 0; s < spectrum.omega.size(); ++s) {
      table.rows.push_back({branch, spectrum.k[w], spectrum.omega[s],
                            spectrum.amplitude(static_cast<Eigen::Index>(w), static_cast<Eigen::Index>(s))});
    }
  }
}

}  // namespace

template <int Dim>
nlohmann::ordered_json write_spectrum(const std::filesystem::path& folder, const Lattice<Dim>& lattice,
                                      const Case& input) {
  const DispersionSpec& spec = *input.dispersion;
  const WaveRecorder<Dim> record =
      record_run<Dim>(spec.spectrum->run, input.model, path_corners<Dim>(spec), spec.spectrum->where);
  const GridWaves<Dim>& waves = record.waves();
  std::vector<PlaneWaves<Dim>> exact;
  exact.reserve(waves.k.size());
  for (std::size_t w = 0; w < waves.k.size(); ++w)
    exact.push_back(plane_waves(lattice, waves.k[w], waves.direction[w]));

  std::vector<Spectrum> spectra;
  double loudest = 0.0;
  for (int b = 0; b < Dim; ++b) {
    std::vector<Point<Dim>> along(exact.size());
    std::transform(exact.begin(), exact.end(), along.begin(),
                   [b](const PlaneWaves<Dim>& wave) { return Point<Dim>(wave.polarisation.col(b)); });
    spectra.push_back(wave_spectrum(record, along));
    loudest = std::max(loudest, spectra.back().amplitude.maxCoeff());
  }
  constexpr double bytes_per_row = 300.0;
  refuse_if_too_large(bytes_per_row * Dim * static_cast<double>(spectra.front().amplitude.size()),
                      "spectrum.csv");

  Table ridges;
  for (int a = 0; a < Dim; ++a) ridges.columns.push_back(std::string("k_") + "xyz"[a]);
  for (const char* name :
       {"path_length", "branch", "angular_frequency", "amplitude", "symbol_angular_frequency"})
    ridges.columns.emplace_back(name);
  if (spec.time_step) ridges.columns.emplace_back("stepped_angular_frequency");
  Heard heard;
  Table map;
  map.columns = {"branch", "path_length", "angular_frequency", "amplitude"};
  for (int b = 0; b < Dim; ++b) {
    const Spectrum& spectrum = spectra[static_cast<std::size_t>(b)];
    add_ridge(ridges, heard, waves, exact, b, spectrum_ridge(spectrum), loudest, spec);
    add_spectrum(map, branch_name(b, Dim), spectrum);
  }
  write_csv(folder / "ridge.csv", ridges);
  write_csv(folder / "spectrum.csv", map);
  const Spectrum& any = spectra.front();
  return {{"waves", waves.k.size()},
          {"instants", any.instants},
          {"time_step", any.time_step},
          {"resolution", any.resolution},
          {"nyquist", any.nyquist},
          {"heard", heard.waves},
          {"largest_deviation", heard.largest_deviation}};
}

std::string spectrum_text(const nlohmann::ordered_json& spectrum) {
  return fmt::format(
      "spectrum         {} waves of the run on the path, {} instants of {:.6g} s, resolution {:.4g} rad/s\n"
      "                 {} ridges heard, off the curve by at most {:.4g} rad/s\n",
      spectrum["waves"].get<int>(), spectrum["instants"].get<int>(), spectrum["time_step"].get<double>(),
      spectrum["resolution"].get<double>(), spectrum["heard"].get<int>(),
      spectrum["largest_deviation"].get<double>());
}

template nlohmann::ordered_json write_spectrum<1>(const std::filesystem::path&, const Lattice<1>&,
                                                  const Case&);
template nlohmann::ordered_json write_spectrum<2>(const std::filesystem::path&, const Lattice<2>&,
                                                  const Case&);
template nlohmann::ordered_json write_spectrum<3>(const std::filesystem::path&, const Lattice<3>&,
                                                  const Case&);

}  // namespace perimode::cli
