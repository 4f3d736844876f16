// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "perimode/dispersion/lattice.hpp"

namespace perimode {

/// The symbol on the grid k = pi/(spacing (n-1)) (x, y, z), 0 <= x, y, z < n, row by row (x runs). The sums
/// over signs of an orbit separate into products of a cosine or sine per axis, tabled, with
///   1 - cos a cos b cos c = (1 - cos a) + cos a ((1 - cos b) + cos b (1 - cos c)),
/// which loses no digits for long waves; a row costs O(reach^3), a point O(reach).
/// docs/theory/16_dispersion.md eqs. (7), (8). Lower dimensions have y = z = 0.
/// @pre rates are equal within an orbit.
template <int Dim>
class SymbolOnGrid {
 public:
  using Matrix = Eigen::Matrix<double, Dim, Dim>;

  SymbolOnGrid(const Lattice<Dim>& lattice, int points_per_axis);

  /// Factors of the rows' functions of x.
  struct Row {
    std::vector<double> versine, cosine, sine;  ///< per multiple i of x and entry of the symbol
  };
  void start_row(int y, int z, Row& row) const;
  [[nodiscard]] Matrix symbol(const Row& row, int x) const;

 private:
  static constexpr int entries = Dim * (Dim + 1) / 2;
  [[nodiscard]] std::size_t at(int i, int j, int l) const {
    return (static_cast<std::size_t>(l) * static_cast<std::size_t>(depth(1)) + static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(terms_) +
           static_cast<std::size_t>(i);
  }
  /// Multiples of an axis: 0..reach, or 0 alone where the lattice lacks it.
  [[nodiscard]] int depth(int axis) const { return axis < Dim ? terms_ : 1; }

  int terms_ = 0;                                    ///< reach + 1
  std::vector<double> cosine_, versine_, sine_;      ///< of point p and multiple i: [p * terms_ + i]
  std::vector<std::array<double, entries>> weight_;  ///< rate n_a n_b summed over signs, per |offset|
};

}  // namespace perimode
