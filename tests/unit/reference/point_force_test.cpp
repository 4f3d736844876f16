// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/reference/point_force.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <numbers>

#include "perimode/boundary/time_function.hpp"
#include "perimode/core/error.hpp"

namespace perimode {
namespace {

const PointForce source{1.3, 1.7, 0.9, {0.4, -0.2, 1.0}, 0.5};

using Field = std::function<Point<3>(const Point<3>&)>;

/// Second derivatives d^2 u_c / dx_a dx_b by fourth-order differences: of (a, b) at [3 a + b].
std::array<Point<3>, 9> second_derivatives(const Field& u, const Point<3>& x, double h) {
  constexpr std::array<double, 5> first = {1.0 / 12, -8.0 / 12, 0.0, 8.0 / 12, -1.0 / 12};
  constexpr std::array<double, 5> second = {-1.0 / 12, 16.0 / 12, -30.0 / 12, 16.0 / 12, -1.0 / 12};
  std::array<Point<3>, 9> d;
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      Point<3> sum = Point<3>::Zero();
      for (int i = 0; i < 5; ++i) {
        if (a == b) {
          sum += second[static_cast<std::size_t>(i)] * u(x + (i - 2) * h * Point<3>::Unit(a));
          continue;
        }
        for (int j = 0; j < 5; ++j)
          sum += first[static_cast<std::size_t>(i)] * first[static_cast<std::size_t>(j)] *
                 u(x + (i - 2) * h * Point<3>::Unit(a) + (j - 2) * h * Point<3>::Unit(b));
      }
      d[static_cast<std::size_t>(3 * a + b)] = sum / (h * h);
    }
  }
  return d;
}

TEST(PointForce, SolvesTheEquationOfMotion) {
  // u'' = alpha^2 grad div u - beta^2 curl curl u = (alpha^2 - beta^2) grad div u + beta^2 laplace u
  const double h = 2e-3;
  for (const double t : {2.0, 3.1, 4.4}) {
    for (const Point<3>& x : {Point<3>(0.7, 0.3, -0.4), Point<3>(1.9, -0.8, 0.5), Point<3>(0.0, 0.0, 1.2)}) {
      const auto d =
          second_derivatives([&](const Point<3>& y) { return displacement_of_force(source, y, t); }, x, h);
      const Point<3> laplace = d[0] + d[4] + d[8];
      Point<3> grad_div;
      for (int a = 0; a < 3; ++a)
        grad_div[a] = d[static_cast<std::size_t>(3 * a)][0] + d[static_cast<std::size_t>(3 * a + 1)][1] +
                      d[static_cast<std::size_t>(3 * a + 2)][2];
      const double alpha2 = 1.7 * 1.7, beta2 = 0.9 * 0.9;
      const Point<3> force = (alpha2 - beta2) * grad_div + beta2 * laplace;
      const auto u = [&](double s) { return displacement_of_force(source, x, s); };
      const Point<3> acceleration =
          (-u(t - 2 * h) + 16.0 * u(t - h) - 30.0 * u(t) + 16.0 * u(t + h) - u(t + 2 * h)) / (12.0 * h * h);
      // round-off of second differences: 1e-16 |u|/h^2, |u| about 0.1
      EXPECT_LT((acceleration - force).norm(), 1e-8 + 1e-7 * force.norm()) << t << " " << x.transpose();
    }
  }
}

TEST(PointForce, CarriesTheForceThroughASmallSphere) {
  // Near the force inertia is negligible: the displacement is Kelvin's, of the force at this instant.
  const double t = 3.0;  // the peak of the wavelet
  const double alpha2 = 1.7 * 1.7, beta2 = 0.9 * 0.9, rho = 1.3;
  const Point<3> x = 1e-3 * Point<3>(1.0, 2.0, -1.0);
  const double r = x.norm();
  const Point<3> g = x / r, f = source.force;
  // u = 1/(8 pi rho r) [(1/beta^2 + 1/alpha^2) F + (1/beta^2 - 1/alpha^2) g g.F]
  const Point<3> kelvin = ((1 / beta2 + 1 / alpha2) * f + (1 / beta2 - 1 / alpha2) * g * g.dot(f)) /
                          (8.0 * std::numbers::pi * rho * r);
  // What inertia adds is even in r/wavelength = 1e-3: its square, and a term in its cube over r, is 1e-5.
  EXPECT_LT((displacement_of_force(source, x, t) - kelvin).norm(), 1e-4 * kelvin.norm());
  EXPECT_LT((displacement_of_force(source, 0.1 * x, t) - 10.0 * kelvin).norm(), 1e-5 * kelvin.norm());
}

TEST(PointForce, FarAwayArrivesAsTheWaveletOfTheLoads) {
  TimeFunction ricker;
  ricker.kind = TimeFunction::Kind::ricker;
  ricker.a = source.frequency;
  const double r = 500.0;
  const Point<3> x(0.0, 0.0, r);
  const double t = r / 0.9 + 3.3;
  const Point<3> u = displacement_of_force(source, x, t);
  const double expected = 0.4 * value_at(ricker, 3.3) / (4.0 * std::numbers::pi * 1.3 * 0.9 * 0.9 * r);
  EXPECT_NEAR(u[0], expected, 1e-2 * std::abs(expected));  // the near field is 1/r weaker
}

TEST(PointForce, NeedsAPlaceOfItsOwn) {
  EXPECT_THROW((void)displacement_of_force(source, Point<3>::Zero(), 1.0), Error);
}

}  // namespace
}  // namespace perimode
