// SPDX-License-Identifier: BSD-3-Clause
#include "figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace perimode::studies {

void add_point(Figure& figure, const std::string& panel, const std::string& curve, double x, double y) {
  figure.curves.rows.push_back({panel, curve, x, y});
}

void add_map(Figure& figure, const std::string& panel, const Spectrum& spectrum, Reference reference,
             double highest, int skip, int pool) {
  constexpr double floor = 1e-9;  // -180 dB
  const double largest = spectrum.amplitude.maxCoeff();
  for (std::size_t q = 0; q < spectrum.k.size(); q += static_cast<std::size_t>(skip)) {
    const auto row = spectrum.amplitude.row(static_cast<Eigen::Index>(q));
    const double unit = reference == Reference::whole ? largest : std::max(row.maxCoeff(), floor * largest);
    for (std::size_t s = 0; s < spectrum.omega.size() && spectrum.omega[s] <= highest;
         s += static_cast<std::size_t>(pool)) {
      const auto bins = std::min<Eigen::Index>(pool, row.size() - static_cast<Eigen::Index>(s));
      const double top = row.segment(static_cast<Eigen::Index>(s), bins).maxCoeff() / unit;
      figure.map.rows.push_back(
          {panel, spectrum.k[q],
           spectrum.omega[s] + 0.5 * spectrum.resolution * static_cast<double>(bins - 1),
           fmt::format("{:.1f}", 20.0 * std::log10(std::max(top, floor)))});
    }
  }
}

void write_figure(const std::filesystem::path& folder, const std::string& name, const Figure& figure) {
  write_csv(folder / (name + ".csv"), figure.curves);
  if (!figure.map.rows.empty()) write_csv(folder / (name + "_map.csv"), figure.map);
}

}  // namespace perimode::studies
