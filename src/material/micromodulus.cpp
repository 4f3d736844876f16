// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/material/micromodulus.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

namespace perimode {
namespace {

using std::numbers::pi;

void require_dimension(const Continuum& continuum) {
  if (continuum.dimension < 1 || continuum.dimension > 3) {
    invalid_input({"a dimension of 1, 2 or 3", fmt::format("{}", continuum.dimension),
                   "choose the dimension of the body"});
  }
}

void require_positive(const char* name, double value, const char* remedy) {
  if (!(value > 0.0) || !std::isfinite(value)) {
    invalid_input({fmt::format("{} > 0", name), fmt::format("{}", value), remedy});
  }
}

/// int_0^1 exp(-(p s)^2) s^n ds for n = 1, 2, 3.
double gaussian_moment(double p, int n) {
  const double a = p * p;
  if (a < 1.0) {
    // (1/2) exp(-a) sum_k a^k / (q (q+1) .. (q+k)), q = (n+1)/2: all terms positive, no cancellation.
    double denominator = 0.5 * (n + 1);
    double term = 1.0 / denominator;
    double sum = term;
    while (term > 1e-17 * sum) {
      denominator += 1.0;
      term *= a / denominator;
      sum += term;
    }
    return 0.5 * std::exp(-a) * sum;
  }
  switch (n) {
    case 1:
      return -std::expm1(-a) / (2.0 * a);
    case 2:
      return std::sqrt(pi) * std::erf(p) / (4.0 * a * p) - std::exp(-a) / (2.0 * a);
    default:
      return (-std::expm1(-a) - a * std::exp(-a)) / (2.0 * a * a);
  }
}

/// int_0^1 g(s delta) s^n ds, n = 1, 2, 3 the dimension.
double shape_moment(const Micromodulus& micromodulus, int n) {
  switch (micromodulus.kernel) {
    case Kernel::constant:
    case Kernel::fourier:
    case Kernel::shells:
      return 1.0 / (n + 1);
    case Kernel::conical:
      return 1.0 / ((n + 1.0) * (n + 2.0));
    case Kernel::gaussian:
      require_positive("the p of a gaussian micromodulus", micromodulus.p, "p = 2 is customary");
      return gaussian_moment(micromodulus.p, n);
    case Kernel::inverse_distance:
      return 1.0 / n;
  }
  return 0.0;
}

double fourier_series(const Micromodulus& m, double distance) {
  double sum = m.a0;
  for (std::size_t j = 0; j < m.a.size(); ++j)
    sum += m.a[j] * std::cos(static_cast<double>(j + 1) * m.w * distance);
  return sum;
}

std::string offset_text(const std::array<int, 3>& offset, int dimension) {
  std::string text = "(";
  for (int a = 0; a < dimension; ++a)
    text += fmt::format("{}{}", a > 0 ? ", " : "", offset[static_cast<std::size_t>(a)]);
  return text + ")";
}

/// alpha of every orbit of the family, each found once among the shells.
template <int Dim>
std::vector<double> alpha_of_orbits(const Micromodulus& m, const Family<Dim>& family) {
  std::map<std::array<int, 3>, double> table;
  for (const Shell& shell : m.shells) {
    if (!table.emplace(shell.offset, shell.alpha).second) {
      invalid_input({"one coefficient for every orbit of the family",
                     fmt::format("two for {}", offset_text(shell.offset, Dim)), "remove one"});
    }
  }
  std::vector<double> alpha;
  for (const auto& own : family.shell) {
    std::array<int, 3> offset = {};
    std::copy(own.begin(), own.end(), offset.begin());
    const auto found = table.find(offset);
    if (found == table.end()) {
      invalid_input(
          {fmt::format("a coefficient for each of the {} orbits of the family", family.shell.size()),
           fmt::format("none for {}", offset_text(offset, Dim)),
           "use the table made for this horizon, or the horizon of the table"});
    }
    alpha.push_back(found->second);
    table.erase(found);
  }
  if (!table.empty()) {
    invalid_input({fmt::format("coefficients for the {} orbits of the family", family.shell.size()),
                   fmt::format("one for {}, which is none of them", offset_text(table.begin()->first, Dim)),
                   "use the table made for this horizon, or the horizon of the table"});
  }
  return alpha;
}

}  // namespace

double poissons_ratio(const Continuum& continuum) {
  require_dimension(continuum);
  if (continuum.dimension == 1) return 0.0;
  return continuum.dimension == 2 && continuum.plane == Plane::stress ? 1.0 / 3.0 : 0.25;
}

double dilation_energy(double youngs_modulus, const Continuum& continuum) {
  require_dimension(continuum);
  switch (continuum.dimension) {
    case 1:
      return 0.5 * youngs_modulus;
    case 2:
      return (continuum.plane == Plane::stress ? 1.5 : 1.6) * youngs_modulus;
    default:
      return 3.0 * youngs_modulus;
  }
}

double kernel_shape(const Micromodulus& micromodulus, double r, double horizon) {
  const double s = r / horizon;
  switch (micromodulus.kernel) {
    case Kernel::constant:
      return 1.0;
    case Kernel::conical:
      return s < 1.0 ? 1.0 - s : 0.0;
    case Kernel::gaussian:
      return std::exp(-(micromodulus.p * s) * (micromodulus.p * s));
    case Kernel::inverse_distance:
      return 1.0 / s;
    case Kernel::fourier:
      require_positive("the spacing of a fourier micromodulus", micromodulus.spacing,
                       "give that of the grid");
      return fourier_series(micromodulus, r / micromodulus.spacing);
    case Kernel::shells:
      invalid_input({"a kernel that is a function of distance", "shells", "use the table of the lattice"});
  }
  return 0.0;
}

std::string name(Kernel kernel) {
  switch (kernel) {
    case Kernel::constant:
      return "constant";
    case Kernel::conical:
      return "conical";
    case Kernel::gaussian:
      return "gaussian";
    case Kernel::inverse_distance:
      return "inverse_distance";
    case Kernel::fourier:
      return "fourier";
    case Kernel::shells:
      break;
  }
  return "shells";
}

bool is_lattice_kernel(Kernel kernel) { return kernel == Kernel::fourier || kernel == Kernel::shells; }

template <int Dim>
std::vector<double> kernel_shapes(const Micromodulus& m, const Family<Dim>& family) {
  std::vector<double> shapes(family.length.size());
  if (m.kernel == Kernel::shells) {
    const std::vector<double> alpha = alpha_of_orbits(m, family);
    for (std::size_t j = 0; j < shapes.size(); ++j)
      shapes[j] = alpha[static_cast<std::size_t>(family.orbit[j])];
    return shapes;
  }
  if (m.kernel == Kernel::fourier && !(std::abs(m.spacing - family.spacing) <= 1e-9 * family.spacing)) {
    invalid_input({fmt::format("the spacing {:.6g} m of the grid in a fourier micromodulus", family.spacing),
                   fmt::format("{:.6g} m", m.spacing), "give that of the grid"});
  }
  std::transform(family.length.begin(), family.length.end(), shapes.begin(),
                 [&](double r) { return kernel_shape(m, r, family.horizon); });
  return shapes;
}

template std::vector<double> kernel_shapes<1>(const Micromodulus&, const Family<1>&);
template std::vector<double> kernel_shapes<2>(const Micromodulus&, const Family<2>&);
template std::vector<double> kernel_shapes<3>(const Micromodulus&, const Family<3>&);

double micromodulus_constant(const Micromodulus& micromodulus, double youngs_modulus, double horizon,
                             const Continuum& continuum) {
  require_dimension(continuum);
  require_positive("Young's modulus", youngs_modulus, "give it in Pa");
  require_positive("the horizon", horizon, "give it in m");
  require_positive("the section", continuum.section, "the thickness (2D, m), the area (1D, m2) or 1 (3D)");
  const int n = continuum.dimension;
  const double sphere = n == 1 ? 2.0 : (n == 2 ? 2.0 * pi : 4.0 * pi);  // dV = section sphere r^(n-1) dr
  const double moment =
      continuum.section * sphere * shape_moment(micromodulus, n) * std::pow(horizon, n + 1);  // int g r dV
  return 4.0 * dilation_energy(youngs_modulus, continuum) / moment;
}

double micromodulus(const Micromodulus& micromodulus, double c0, double r, double horizon) {
  return c0 * kernel_shape(micromodulus, r, horizon);
}

}  // namespace perimode
