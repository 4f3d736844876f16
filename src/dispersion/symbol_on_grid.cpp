// SPDX-License-Identifier: BSD-3-Clause
#include "dispersion/symbol_on_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace perimode {

template <int Dim>
SymbolOnGrid<Dim>::SymbolOnGrid(const Lattice<Dim>& lattice, int points_per_axis)
    : terms_(lattice.family.reach() + 1) {
  const auto table = static_cast<std::size_t>(points_per_axis) * static_cast<std::size_t>(terms_);
  cosine_.resize(table);
  versine_.resize(table);
  sine_.resize(table);
  // Angles pi q/(n-1) are reduced to one turn exactly, as whole numbers.
  const long long turn = 2LL * (points_per_axis - 1);
  for (int p = 0; p < points_per_axis; ++p) {
    for (int i = 0; i < terms_; ++i) {
      const auto cell =
          static_cast<std::size_t>(p) * static_cast<std::size_t>(terms_) + static_cast<std::size_t>(i);
      const double angle =
          2.0 * std::numbers::pi * static_cast<double>((1LL * p * i) % turn) / static_cast<double>(turn);
      const double half = std::sin(0.5 * angle);
      cosine_[cell] = std::cos(angle);
      versine_[cell] = 2.0 * half * half;
      sine_[cell] = std::sin(angle);
    }
  }

  weight_.assign(at(0, 0, depth(2)), {});
  const Family<Dim>& family = lattice.family;
  for (std::size_t j = 0; j < family.offset.size(); ++j) {
    const auto& o = family.offset[j];
    if (std::any_of(o.begin(), o.end(), [](int c) { return c < 0; })) continue;
    double signs = 1.0;
    std::array<int, 3> place = {};
    for (std::size_t a = 0; a < Dim; ++a) {
      if (o[a] != 0) signs *= 2.0;
      place[a] = o[a];
    }
    auto& weight = weight_[at(place[0], place[1], place[2])];
    const double rate = signs * lattice.rates[j] * std::pow(family.spacing / family.length[j], 2);
    std::size_t entry = 0;
    for (std::size_t a = 0; a < Dim; ++a) {
      for (std::size_t b = 0; b <= a; ++b) weight[entry++] += rate * o[a] * o[b];
    }
  }
}

template <int Dim>
void SymbolOnGrid<Dim>::start_row(int y, int z, Row& row) const {
  const auto size = static_cast<std::size_t>(terms_) * entries;
  row.versine.assign(size, 0.0);
  row.cosine.assign(size, 0.0);
  row.sine.assign(size, 0.0);
  const std::size_t of_y = static_cast<std::size_t>(y) * static_cast<std::size_t>(terms_);
  const std::size_t of_z = static_cast<std::size_t>(z) * static_cast<std::size_t>(terms_);
  for (int l = 0; l < depth(2); ++l) {
    const std::size_t zl = of_z + static_cast<std::size_t>(l);
    for (int j = 0; j < depth(1); ++j) {
      const std::size_t yj = of_y + static_cast<std::size_t>(j);
      const double versine = versine_[yj] + cosine_[yj] * versine_[zl];
      for (int i = 0; i < terms_; ++i) {
        const auto& weight = weight_[at(i, j, l)];
        const std::size_t first = static_cast<std::size_t>(i) * entries;
        // Entries in the order xx, yx, yy, zx, zy, zz.
        for (std::size_t e : {0U, 2U, 5U}) {
          if (e >= entries) break;
          row.versine[first + e] += weight[e];
          row.cosine[first + e] += weight[e] * versine;
        }
        if constexpr (Dim > 1) row.sine[first + 1] += weight[1] * sine_[yj] * cosine_[zl];
        if constexpr (Dim > 2) {
          row.sine[first + 3] += weight[3] * cosine_[yj] * sine_[zl];
          row.cosine[first + 4] += weight[4] * sine_[yj] * sine_[zl];
        }
      }
    }
  }
}

template <int Dim>
typename SymbolOnGrid<Dim>::Matrix SymbolOnGrid<Dim>::symbol(const Row& row, int x) const {
  std::array<double, entries> m = {};
  const std::size_t of_x = static_cast<std::size_t>(x) * static_cast<std::size_t>(terms_);
  for (int i = 0; i < terms_; ++i) {
    const std::size_t xi = of_x + static_cast<std::size_t>(i);
    const std::size_t first = static_cast<std::size_t>(i) * entries;
    for (std::size_t e = 0; e < entries; ++e)
      m[e] += versine_[xi] * row.versine[first + e] + cosine_[xi] * row.cosine[first + e] +
              sine_[xi] * row.sine[first + e];
  }
  Matrix result;
  std::size_t entry = 0;
  for (int a = 0; a < Dim; ++a) {
    for (int b = 0; b <= a; ++b) {
      result(a, b) = m[entry];
      result(b, a) = m[entry++];
    }
  }
  return result;
}

template class SymbolOnGrid<1>;
template class SymbolOnGrid<2>;
template class SymbolOnGrid<3>;

}  // namespace perimode
