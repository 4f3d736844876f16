// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/dispersion/waves.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

#include "dispersion/branches.hpp"
#include "dispersion/symbol_gradient.hpp"

namespace perimode {

std::string branch_name(int branch, int dimension) {
  if (branch == 0) return "P";
  return dimension == 2 ? "S" : fmt::format("S{}", branch);
}

template <int Dim>
PlaneWaves<Dim> plane_waves(const Lattice<Dim>& lattice, const Point<Dim>& k, const Point<Dim>& direction) {
  constexpr double round_off = 1e-13;
  const double number = k.norm();
  const Point<Dim> along = number > 0.0 ? Point<Dim>(k / number) : direction;
  const bool limit = number * lattice.family.horizon < 1e-6;
  // In the limit M(k) = |k|^2 A: its speeds first, frequencies follow.
  const SymbolGradient<Dim> symbol =
      limit ? acoustic_tensor<Dim>(lattice, along) : symbol_gradient<Dim>(lattice, k);
  const Branches<Dim> branches = branches_of<Dim>(symbol.symbol, along, symbol.scale);

  PlaneWaves<Dim> waves;
  waves.k = k;
  waves.polarisation = branches.polarisation;
  for (std::size_t b = 0; b < Dim; ++b) {
    const double squared = branches.squared[b];
    const bool zero = std::abs(squared) <= round_off * symbol.scale;
    const double root = zero ? 0.0 : std::sqrt(squared);  // NaN where negative
    waves.squared[b] = limit ? squared * number * number : squared;
    waves.angular_frequency[b] = limit ? root * number : root;
    waves.phase_velocity[b] = limit ? root : root / number;
    const Point<Dim> a = branches.polarisation.col(static_cast<int>(b));
    waves.group_velocity[b] =
        zero ? Point<Dim>(Point<Dim>::Zero()) : Point<Dim>(symbol.between(a, a) / (2.0 * root));
  }
  return waves;
}

template <int Dim>
std::vector<PlaneWaves<Dim>> waves_along(const Lattice<Dim>& lattice, const ZonePath<Dim>& path) {
  const auto count = static_cast<std::ptrdiff_t>(path.k.size());
  std::vector<PlaneWaves<Dim>> waves(path.k.size());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    // The end of a path is approached against its tangent.
    const double sign = i > 0 && i + 1 == count ? -1.0 : 1.0;
    waves[at] = plane_waves<Dim>(lattice, path.k[at], sign * path.direction[at]);
  }
  return waves;
}

#define PERIMODE_WAVES(D)                                                                     \
  template PlaneWaves<D> plane_waves<D>(const Lattice<D>&, const Point<D>&, const Point<D>&); \
  template std::vector<PlaneWaves<D>> waves_along<D>(const Lattice<D>&, const ZonePath<D>&)
PERIMODE_WAVES(1);
PERIMODE_WAVES(2);
PERIMODE_WAVES(3);
#undef PERIMODE_WAVES

}  // namespace perimode
