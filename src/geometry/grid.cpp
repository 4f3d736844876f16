// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/geometry/grid.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace perimode {

template <int Dim>
Offset Grid<Dim>::count() const {
  Offset n = 1;
  for (Index c : cells) n *= c;
  return n;
}

template <int Dim>
Point<Dim> Grid<Dim>::upper() const {
  Point<Dim> p = lower;
  for (int a = 0; a < Dim; ++a) p[a] += cells[a] * spacing;
  return p;
}

template <int Dim>
std::array<Index, Dim> Grid<Dim>::cell(Index number) const {
  std::array<Index, Dim> c = {};
  for (int a = 0; a < Dim; ++a) {
    c[a] = number % cells[a];
    number /= cells[a];
  }
  return c;
}

template <int Dim>
Point<Dim> Grid<Dim>::centre(const std::array<Index, Dim>& cell) const {
  Point<Dim> p = lower;
  for (int a = 0; a < Dim; ++a) p[a] += (cell[a] + 0.5) * spacing;
  return p;
}

template <int Dim>
Point<Dim> to_point(const Coordinates& coordinates, const char* what, const Where& where) {
  bool good = coordinates.size() == static_cast<std::size_t>(Dim);
  for (double c : coordinates) good = good && std::isfinite(c);
  if (!good) {
    invalid_input({fmt::format("{} with {} finite coordinate{}", what, Dim, Dim == 1 ? "" : "s"),
                   fmt::format("[{}]", fmt::join(coordinates, ", ")),
                   fmt::format("the body has dimension {}", Dim), where});
  }
  return Eigen::Map<const Point<Dim>>(coordinates.data());
}

template <int Dim>
Grid<Dim> make_grid(const Coordinates& lower, const Coordinates& upper, double spacing, const Where& where) {
  Grid<Dim> grid;
  grid.lower = to_point<Dim>(lower, "lower", where);
  const Point<Dim> top = to_point<Dim>(upper, "upper", where);
  if (!(spacing > 0.0) || !std::isfinite(spacing)) {
    invalid_input(
        {"a grid spacing > 0", fmt::format("{}", spacing), "give the distance of particles in m", where});
  }
  grid.spacing = spacing;
  double total = 1.0;
  for (int a = 0; a < Dim; ++a) {
    const double cells = (top[a] - grid.lower[a]) / spacing;
    const double whole = std::round(cells);
    if (whole < 1.0 || std::abs(cells - whole) > 1e-9 * std::max(1.0, whole)) {
      invalid_input({"a box that holds a whole number of cells along every axis",
                     fmt::format("{:.12g} cells of {:.12g} m along {}", cells, spacing, "xyz"[a]),
                     "change the spacing or the box", where});
    }
    total *= whole;
    if (total >= static_cast<double>(std::numeric_limits<Index>::max())) {
      invalid_input(
          {"fewer than 2^31 particles", fmt::format("{:.3g}", total), "use a larger spacing", where});
    }
    grid.cells[a] = static_cast<Index>(whole);
  }
  return grid;
}

template struct Grid<1>;
template struct Grid<2>;
template struct Grid<3>;
template Grid<1> make_grid<1>(const Coordinates&, const Coordinates&, double, const Where&);
template Grid<2> make_grid<2>(const Coordinates&, const Coordinates&, double, const Where&);
template Grid<3> make_grid<3>(const Coordinates&, const Coordinates&, double, const Where&);
template Point<1> to_point<1>(const Coordinates&, const char*, const Where&);
template Point<2> to_point<2>(const Coordinates&, const char*, const Where&);
template Point<3> to_point<3>(const Coordinates&, const char*, const Where&);

}  // namespace perimode
