// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "perimode/dispersion/spectrum.hpp"
#include "perimode/io/table.hpp"

namespace perimode::studies {

/// What one figure shows: curves by panel and name, and the spectra of simulations under them.
struct Figure {
  Table curves = {{"panel", "curve", "x", "y"}, {}};
  Table map = {{"panel", "x", "y", "level_dB"}, {}};
};

void add_point(Figure& figure, const std::string& panel, const std::string& curve, double x, double y);

/// The spectrum up to omega = `highest` as decibels below the largest amplitude of all ("whole") or of each
/// k; every `skip`-th k, the largest of every `pool` bins.
enum class Reference { whole, each_k };
void add_map(Figure& figure, const std::string& panel, const Spectrum& spectrum, Reference reference,
             double highest, int skip, int pool);

/// Writes folder/name.csv and, where there are spectra, folder/name_map.csv.
void write_figure(const std::filesystem::path& folder, const std::string& name, const Figure& figure);

}  // namespace perimode::studies
