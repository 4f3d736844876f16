// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>

#include "perimode/dispersion/waves.hpp"

namespace perimode {
namespace {

/// How many of `total` steps each side takes: one at least, the rest by length, largest remainders first.
std::vector<int> steps_of_sides(const std::vector<double>& side, int total) {
  const double length = std::accumulate(side.begin(), side.end(), 0.0);
  const int rest = total - static_cast<int>(side.size());
  std::vector<int> steps(side.size(), 1);
  std::vector<double> remainder(side.size());
  int left = rest;
  for (std::size_t i = 0; i < side.size(); ++i) {
    const double share = std::max(0.0, total * side[i] / length - 1.0);
    const int whole = std::min(left, static_cast<int>(share));
    steps[i] += whole;
    left -= whole;
    remainder[i] = share - whole;
  }
  for (; left > 0; --left) {
    const auto at = std::max_element(remainder.begin(), remainder.end());
    ++steps[static_cast<std::size_t>(at - remainder.begin())];
    *at -= 1.0;
  }
  return steps;
}

}  // namespace

template <int Dim>
ZonePath<Dim> zone_path(const std::vector<Point<Dim>>& corners, double spacing, int points) {
  if (corners.size() < 2) {
    invalid_input({"a path of at least two points", fmt::format("{}", corners.size()),
                   "give the corners in pi/spacing, or leave the path away for the irreducible contour"});
  }
  if (points < static_cast<int>(corners.size())) {
    invalid_input({fmt::format("at least {} points, one for every corner of the path", corners.size()),
                   fmt::format("{}", points), "200 draw a smooth curve"});
  }
  const std::size_t sides = corners.size() - 1;
  const double scale = std::numbers::pi / spacing;
  std::vector<double> side(sides);
  for (std::size_t i = 0; i < sides; ++i) {
    side[i] = scale * (corners[i + 1] - corners[i]).norm();
    if (!(side[i] > 0.0) || !std::isfinite(side[i])) {
      invalid_input({"corners of a path that differ from the one before, a finite distance apart",
                     fmt::format("a side of {} rad/m from corner {} to {}", side[i], i + 1, i + 2),
                     "remove or correct one of them"});
    }
  }
  const std::vector<int> steps = steps_of_sides(side, points - 1);

  ZonePath<Dim> path;
  path.k.reserve(static_cast<std::size_t>(points));
  path.direction.reserve(static_cast<std::size_t>(points));
  path.length.reserve(static_cast<std::size_t>(points));
  path.corner.reserve(corners.size());
  double before = 0.0;
  Point<Dim> tangent;
  for (std::size_t i = 0; i < sides; ++i) {
    tangent = (corners[i + 1] - corners[i]).normalized();
    path.corner.push_back(static_cast<int>(path.k.size()));
    for (int s = 0; s < steps[i]; ++s) {
      const double t = static_cast<double>(s) / steps[i];
      path.k.push_back(scale * ((1.0 - t) * corners[i] + t * corners[i + 1]));
      path.direction.push_back(tangent);
      path.length.push_back(before + t * side[i]);
    }
    before += side[i];
  }
  path.corner.push_back(static_cast<int>(path.k.size()));
  path.k.push_back(scale * corners.back());
  path.direction.push_back(tangent);
  path.length.push_back(before);
  return path;
}

template <int Dim>
std::vector<Point<Dim>> irreducible_contour() {
  if constexpr (Dim == 1) {
    return {Point<1>(0.0), Point<1>(1.0)};
  } else if constexpr (Dim == 2) {
    return {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 0.0}};
  } else {
    return {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {1.0, 1.0, 1.0}, {0.0, 0.0, 0.0}};
  }
}

template ZonePath<1> zone_path<1>(const std::vector<Point<1>>&, double, int);
template ZonePath<2> zone_path<2>(const std::vector<Point<2>>&, double, int);
template ZonePath<3> zone_path<3>(const std::vector<Point<3>>&, double, int);

template std::vector<Point<1>> irreducible_contour<1>();
template std::vector<Point<2>> irreducible_contour<2>();
template std::vector<Point<3>> irreducible_contour<3>();

}  // namespace perimode
