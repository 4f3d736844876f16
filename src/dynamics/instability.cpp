// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/instability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "perimode/core/error.hpp"

namespace perimode {

namespace {

using Complex = std::complex<double>;

/// exp(-i pi q x / n) for x = 0 .. n - 1
std::vector<Complex> wave(Index q, Index n) {
  std::vector<Complex> w(static_cast<std::size_t>(n));
  for (Index x = 0; x < n; ++x) w[x] = std::polar(1.0, -std::numbers::pi * q * x / n);
  return w;
}

}  // namespace

template <int Dim>
std::array<double, Dim> wave_vector(const Body<Dim>& body, const Eigen::VectorXd& q) {
  const Grid<Dim>& grid = *body.particles.grid;
  // Field of Dim components per cell, zero where there is no particle or it does not move freely.
  std::vector<Complex> field(static_cast<std::size_t>(grid.count()) * Dim);
  for (Index i = 0; i < body.count(); ++i) {
    for (int a = 0; a < Dim; ++a) {
      const Index number = body.boundary.free_number[static_cast<std::size_t>(i) * Dim + a];
      if (number >= 0) field[static_cast<std::size_t>(body.particles.cell[i]) * Dim + a] = q[number];
    }
  }
  std::array<double, Dim> result = {};
  for (int axis = 0; axis < Dim; ++axis) {
    const Index n = grid.cells[axis];
    const std::size_t lines = field.size() / Dim / n;
    // The axis left is the fastest: cell (x, line) is at (x + n line) Dim.
    double most = -1.0;
    std::vector<Complex> kept;
    for (Index k = 0; k <= n; ++k) {
      const std::vector<Complex> w = wave(k, n);
      std::vector<Complex> sum(lines * Dim);
      double power = 0.0;
      for (std::size_t line = 0; line < lines; ++line) {
        for (int a = 0; a < Dim; ++a) {
          Complex s = 0.0;
          for (Index x = 0; x < n; ++x) s += w[x] * field[(x + n * line) * Dim + a];
          sum[line * Dim + a] = s;
          power += std::norm(s);
        }
      }
      if (power <= most * (1.0 + 1e-9)) continue;
      most = power;
      kept = std::move(sum);
      result[axis] = static_cast<double>(k) / n;
    }
    field = std::move(kept);
  }
  return result;
}

template <int Dim>
void refuse_instability(const Body<Dim>& body, const Eigen::VectorXd& q, Complex lambda) {
  // exp(s t) with s^2 = -lambda.
  const double rate = std::abs(std::sqrt(-lambda).real());
  std::string motion = "a motion";
  if (body.particles.grid) {
    const std::array<double, Dim> k = wave_vector(body, q);
    motion = "waves of wave vector (";
    for (int a = 0; a < Dim; ++a) motion += fmt::format("{}{:.4g}", a > 0 ? ", " : "", k[a]);
    motion += ") pi/spacing";
  }
  invalid_input({"a material that resists every motion",
                 fmt::format("{} that grow{} at a rate of {:.4g} 1/s (lambda = {:.4g}{:+.2g}i 1/s^2)", motion,
                             body.particles.grid ? "" : "s", rate, lambda.real(), lambda.imag()),
                 "take a micromodulus without negative parts, periodic axes instead of free surfaces, or "
                 "walls that keep "
                 "the equations symmetric",
                 {}});
}

#define PERIMODE_INSTABILITY(D)                                                          \
  template std::array<double, D> wave_vector<D>(const Body<D>&, const Eigen::VectorXd&); \
  template void refuse_instability<D>(const Body<D>&, const Eigen::VectorXd&, Complex)
PERIMODE_INSTABILITY(1);
PERIMODE_INSTABILITY(2);
PERIMODE_INSTABILITY(3);
#undef PERIMODE_INSTABILITY

}  // namespace perimode
