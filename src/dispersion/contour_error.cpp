// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "core/quadrature.hpp"
#include "dispersion/contour.hpp"
#include "perimode/dispersion/optimise.hpp"

namespace perimode {
namespace {

using std::numbers::pi;

/// f(s) = sum_m [even_m (1 - cos ms) + odd_m (1 + cos ms)] - c^2 |k(s)|^2 on a side, 0 <= s <= pi: what a
/// branch makes of omega^2 less what it should. A bond whose phase at the start is an odd multiple of pi
/// counts as odd.
struct BranchError {
  std::vector<double> even, odd;
  double at_start = 0.0, linear = 0.0, quadratic = 0.0;  ///< of c^2 |k|^2

  [[nodiscard]] int order() const { return static_cast<int>(even.size()) - 1; }
  [[nodiscard]] double value(double s) const {
    double sum = -(at_start + s * (linear + s * quadratic));
    for (std::size_t m = 0; m < even.size(); ++m) {
      const double half = 0.5 * static_cast<double>(m) * s;
      const double sine = std::sin(half), cosine = std::cos(half);
      sum += 2.0 * (even[m] * sine * sine + odd[m] * cosine * cosine);
    }
    return sum;
  }
  [[nodiscard]] double slope(double s) const {
    double sum = -(linear + 2.0 * s * quadratic);
    for (std::size_t m = 1; m < even.size(); ++m)
      sum += (even[m] - odd[m]) * static_cast<double>(m) * std::sin(static_cast<double>(m) * s);
    return sum;
  }
};

template <int Dim>
BranchError branch_error(const Family<Dim>& family, const std::vector<double>& rates,
                         const ContourBranch<Dim>& side, double speed_squared) {
  BranchError error;
  error.even.assign(static_cast<std::size_t>(Dim * family.reach()) + 1, 0.0);
  error.odd = error.even;
  for (std::size_t j = 0; j < rates.size(); ++j) {
    int frequency = 0, phase = 0, squared = 0;
    double along = 0.0;
    for (std::size_t a = 0; a < Dim; ++a) {
      const int x = family.offset[j][a];
      frequency += x * side.step[a];
      phase += x * side.start[a];
      squared += x * x;
      along += x * side.polarisation[static_cast<Eigen::Index>(a)];
    }
    std::vector<double>& part = phase % 2 == 0 ? error.even : error.odd;
    part[static_cast<std::size_t>(std::abs(frequency))] += rates[j] * along * along / squared;
  }
  for (std::size_t a = 0; a < Dim; ++a) {
    error.at_start += speed_squared * pi * pi * side.start[a] * side.start[a];
    error.linear += speed_squared * 2.0 * pi * side.start[a] * side.step[a];
    error.quadratic += speed_squared * side.step[a] * side.step[a];
  }
  return error;
}

/// A zero of f between a and b, where f has opposite signs, to the last bit.
template <class Function>
double bisect(double a, double b, Function f) {
  const bool rising = f(a) < 0.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (a + b);
    ((f(middle) < 0.0) == rising ? a : b) = middle;
  }
  return 0.5 * (a + b);
}

/// 0, the places where f changes its sign, pi. Between neighbours of 32 samples per period also a pair of
/// changes is seen, by the extremum between them.
std::vector<double> sign_changes(const BranchError& f) {
  const auto value = [&f](double s) { return f.value(s); };
  const auto slope = [&f](double s) { return f.slope(s); };
  const int intervals = 16 * (f.order() + 1);
  std::vector<double> places = {0.0};
  double a = 0.0, value_a = value(a), slope_a = slope(a);
  for (int i = 1; i <= intervals; ++i) {
    const double b = pi * i / intervals, value_b = value(b), slope_b = slope(b);
    if (value_a * value_b < 0.0) {
      places.push_back(bisect(a, b, value));
    } else if (value_a * slope_a < 0.0 && value_b * slope_b > 0.0) {
      const double top = bisect(a, b, slope);
      if (value_a * value(top) < 0.0) {
        places.push_back(bisect(a, top, value));
        places.push_back(bisect(top, b, value));
      }
    }
    a = b;
    value_a = value_b;
    slope_a = slope_b;
  }
  places.push_back(pi);
  return places;
}

}  // namespace

template <int Dim>
ContourError contour_error(const Lattice<Dim>& lattice, std::optional<double> poissons_ratio,
                           const std::array<double, 2>& weights) {
  require_weights(weights, Dim);
  const std::array<double, 2> speeds = target_speeds(lattice.medium.continuum, poissons_ratio);
  const std::vector<double> rates = unit_rates(lattice);
  ContourError total;
  for (const ContourBranch<Dim>& side : contour_branches<Dim>()) {
    const std::size_t which = side.branch == Branch::pressure ? 0 : 1;
    const BranchError f = branch_error(lattice.family, rates, side, speeds[which]);
    const double measure = side.count * step_length(side), e = weights[which];
    const int panels = 1 + f.order();
    const std::vector<double> places = sign_changes(f);
    for (std::size_t i = 1; i < places.size(); ++i) {
      const auto fine = 1 + static_cast<int>(panels * (places[i] - places[i - 1]) / pi);
      total.l1 += measure * e *
                  std::abs(integrate(places[i - 1], places[i], fine, [&](double s) { return f.value(s); }));
    }
    total.l2 += measure * e * e * integrate(0.0, pi, panels, [&](double s) {
                  const double value = f.value(s);
                  return value * value;
                });
  }
  return total;
}

template ContourError contour_error<1>(const Lattice<1>&, std::optional<double>,
                                       const std::array<double, 2>&);
template ContourError contour_error<2>(const Lattice<2>&, std::optional<double>,
                                       const std::array<double, 2>&);
template ContourError contour_error<3>(const Lattice<3>&, std::optional<double>,
                                       const std::array<double, 2>&);

}  // namespace perimode
