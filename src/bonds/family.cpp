// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/bonds/family.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <utility>

#include "perimode/core/error.hpp"

namespace perimode {

namespace {

constexpr double tie = 1e-9;  ///< relative; the one rule for |xi| = delta on a lattice

/// beta of a cell at distance `length`, or 0 when it is not in the family.
double share(double length, double spacing, double horizon, VolumeCorrection correction) {
  if (correction == VolumeCorrection::none) return length <= horizon * (1.0 + tie) ? 1.0 : 0.0;
  const double inside = (horizon + 0.5 * spacing - length) / spacing;
  return inside > tie ? std::min(1.0, inside) : 0.0;
}

/// Orbits from the sorted absolute offset of every member.
template <int Dim>
void number_orbits(Family<Dim>& family, const std::vector<std::array<int, Dim>>& keys) {
  const auto square = [](const std::array<int, Dim>& key) {
    return std::inner_product(key.begin(), key.end(), key.begin(), 0LL);
  };
  const auto before = [&](const std::array<int, Dim>& a, const std::array<int, Dim>& b) {
    return std::pair(square(a), a) < std::pair(square(b), b);
  };
  family.shell = keys;
  std::sort(family.shell.begin(), family.shell.end(), before);
  family.shell.erase(std::unique(family.shell.begin(), family.shell.end()), family.shell.end());
  for (const auto& key : keys) {
    const auto at = std::lower_bound(family.shell.begin(), family.shell.end(), key, before);
    family.orbit.push_back(static_cast<int>(at - family.shell.begin()));
  }
}

}  // namespace

template <int Dim>
int Family<Dim>::reach() const {
  int r = 0;
  for (const auto& o : offset) {
    for (int c : o) r = std::max(r, std::abs(c));
  }
  return r;
}

template <int Dim>
Family<Dim> make_family(double spacing, double horizon, VolumeCorrection correction, bool self_cell) {
  const double layers = horizon / spacing;
  if (!(layers > 0.0) || !(layers < 1e5)) {
    invalid_input({"a horizon between 0 and 100000 spacings",
                   fmt::format("{:.6g} spacings", layers),
                   "check body.horizon and the spacing",
                   {}});
  }
  Family<Dim> family;
  family.spacing = spacing;
  family.horizon = horizon;
  const int m = static_cast<int>(std::ceil(layers * (1.0 + tie))) + 1;
  std::vector<std::array<int, Dim>> keys;
  std::array<int, Dim> o;
  o.fill(-m);
  for (bool more = true; more;) {
    double square = 0.0;
    for (int c : o) square += static_cast<double>(c) * c;
    const double length = spacing * std::sqrt(square);
    const double beta = square > 0.0 ? share(length, spacing, horizon, correction) : 0.0;
    if (beta > 0.0) {
      std::array<int, Dim> key = o;
      for (int& c : key) c = std::abs(c);
      std::sort(key.rbegin(), key.rend());
      keys.push_back(key);
      family.offset.push_back(o);
      family.length.push_back(length);
      family.weight.push_back(beta + (self_cell && square == 1.0 ? 0.5 : 0.0));
    }
    more = false;
    for (int& c : o) {  // x runs fastest
      if (++c <= m) {
        more = true;
        break;
      }
      c = -m;
    }
  }
  if (family.offset.empty()) {
    invalid_input({"a horizon that reaches the nearest neighbour",
                   fmt::format("{:.6g} spacings", layers),
                   "give a ratio of at least 1",
                   {}});
  }
  number_orbits<Dim>(family, keys);
  return family;
}

template struct Family<1>;
template struct Family<2>;
template struct Family<3>;
template Family<1> make_family<1>(double, double, VolumeCorrection, bool);
template Family<2> make_family<2>(double, double, VolumeCorrection, bool);
template Family<3> make_family<3>(double, double, VolumeCorrection, bool);

}  // namespace perimode
