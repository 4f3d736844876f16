// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/dispersion/influence.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/quadrature.hpp"

namespace perimode {
namespace {

using std::numbers::pi;

/// Multipliers against distance in spacings; orbits of one distance stay apart.
struct Data {
  Eigen::VectorXd distance, alpha;
  double reach = 0.0;  ///< horizon in spacings
  int distances = 0;   ///< how many differ
};

template <int Dim>
Data data_of(const Lattice<Dim>& lattice, const std::vector<double>& alpha) {
  const Family<Dim>& family = lattice.family;
  Data data;
  data.reach = lattice.medium.horizon / family.spacing;
  data.alpha = Eigen::Map<const Eigen::VectorXd>(alpha.data(), static_cast<Eigen::Index>(alpha.size()));
  data.distance.resize(data.alpha.size());
  int previous = 0;
  for (std::size_t o = 0; o < alpha.size(); ++o) {
    int squared = 0;
    for (const int component : family.shell[o]) squared += component * component;
    data.distance[static_cast<Eigen::Index>(o)] = std::sqrt(static_cast<double>(squared));
    if (squared != previous) ++data.distances;  // the orbits ascend in length
    previous = squared;
  }
  return data;
}

Eigen::MatrixXd cosines(const Eigen::VectorXd& r, int terms, double w) {
  Eigen::MatrixXd matrix(r.size(), terms + 1);
  for (int j = 0; j <= terms; ++j) matrix.col(j) = (j * w * r.array()).cos();
  return matrix;
}

/// Rows whose squares sum to int_0^reach f''(r)^2 dr, r in spacings, for f of unit coefficients.
Eigen::MatrixXd bending(double reach, int terms, double w) {
  const int panels = 1 + static_cast<int>(terms * w * reach / 4.0);
  Eigen::MatrixXd rows(16 * panels, terms + 1);
  const double half = 0.5 * reach / panels;
  Eigen::Index row = 0;
  for (int panel = 0; panel < panels; ++panel) {
    for (const QuadratureNode& node : gauss_legendre()) {
      const double r = (2 * panel + 1 + node.x) * half, scale = std::sqrt(half * node.weight);
      for (int j = 0; j <= terms; ++j) rows(row, j) = -scale * std::pow(j * w, 2) * std::cos(j * w * r);
      ++row;
    }
  }
  return rows;
}

struct Series {
  Eigen::VectorXd coefficients;
  double misfit = 0.0;   ///< |f(distance) - alpha|
  double bending = 0.0;  ///< (int f''^2 dr)^(1/2)
  bool passes = false;   ///< tells all distances apart: at some w two share all their cosines
};

/// The least-squares fit at w; of several the one of least bending. With as many distances as coefficients or
/// fewer it passes through the mean of every distance.
Series fit_at(const Data& data, int terms, double w) {
  const Eigen::MatrixXd matrix = cosines(data.distance, terms, w), curvature = bending(data.reach, terms, w);
  Series fit;
  if (terms + 1 <= data.distances) {
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(matrix);
    qr.setThreshold(1e-10);
    fit.coefficients = qr.solve(data.alpha);
    fit.passes = qr.rank() == data.distances;
  } else {
    // matrix = L Q^T on its row space: a particular fit, then the null space bends least.
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(matrix.transpose());
    qr.setThreshold(1e-10);
    const Eigen::Index rank = qr.rank(), n = terms + 1;
    fit.passes = rank == data.distances;
    const Eigen::MatrixXd q = qr.householderQ() * Eigen::MatrixXd::Identity(n, n);
    const Eigen::MatrixXd row_space = q.leftCols(rank), null_space = q.rightCols(n - rank);
    fit.coefficients = row_space * (matrix * row_space).colPivHouseholderQr().solve(data.alpha);
    const Eigen::VectorXd bend = curvature * fit.coefficients;
    fit.coefficients -= null_space * (curvature * null_space).completeOrthogonalDecomposition().solve(bend);
  }
  fit.misfit = (matrix * fit.coefficients - data.alpha).norm();
  fit.bending = (curvature * fit.coefficients).norm();
  return fit;
}

/// int_0^delta alpha r^Dim dr over int_0^delta r^Dim dr.
double energy_ratio(const Micromodulus& m, double horizon, int dimension) {
  const int panels =
      1 + static_cast<int>(static_cast<double>(m.a.size()) * std::abs(m.w) * horizon / (4.0 * m.spacing));
  return (dimension + 1) * integrate(0.0, 1.0, panels, [&](double s) {
           return kernel_shape(m, s * horizon, horizon) * std::pow(s, dimension);
         });
}

/// The smallest value of f in [a, b] of one valley, by golden sections.
template <class Function>
double valley(double a, double b, Function f) {
  constexpr double ratio = 0.6180339887498949;
  double c = b - ratio * (b - a), d = a + ratio * (b - a), at_c = f(c), at_d = f(d);
  for (int i = 0; i < 60; ++i) {
    if (at_c < at_d) {
      b = d;
      d = c;
      at_d = at_c;
      c = b - ratio * (b - a);
      at_c = f(c);
    } else {
      a = c;
      c = d;
      at_c = at_d;
      d = a + ratio * (b - a);
      at_d = f(d);
    }
  }
  return 0.5 * (a + b);
}

/// The smallest of `samples` + 1 equally spaced values and, around it, the bottom of its valley.
template <class Function>
double least_of(double a, double b, int samples, Function f) {
  const double step = (b - a) / samples;
  int least = 0;
  double value = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= samples; ++i) {
    const double here = f(a + i * step);
    if (here < value) {
      value = here;
      least = i;
    }
  }
  const double bottom = valley(a + std::max(0, least - 1) * step, a + std::min(samples, least + 1) * step, f);
  return f(bottom) < value ? bottom : a + least * step;
}

}  // namespace

InfluenceFit examine_influence(const Micromodulus& fourier, double horizon, const Continuum& continuum) {
  if (fourier.kernel != Kernel::fourier) {
    invalid_input({"a fourier micromodulus", "another kernel", "give a0, a and w"});
  }
  const auto f = [&](double r) { return kernel_shape(fourier, r, horizon); };
  const int samples = 100 + static_cast<int>(8.0 * static_cast<double>(fourier.a.size()) *
                                             std::abs(fourier.w) * horizon / fourier.spacing);
  InfluenceFit fit;
  fit.micromodulus = fourier;
  fit.energy_ratio = energy_ratio(fourier, horizon, continuum.dimension);
  fit.least_at = least_of(0.0, horizon, samples, f);
  fit.least = f(fit.least_at);
  return fit;
}

template <int Dim>
InfluenceFit fit_influence(const Lattice<Dim>& lattice, const std::vector<double>& alpha, int terms) {
  const std::size_t orbits = lattice.family.shell.size();
  if (alpha.size() != orbits) {
    invalid_input({fmt::format("a multiplier for each of the {} orbits", orbits),
                   fmt::format("{}", alpha.size()), "keep the order of the orbits"});
  }
  if (terms < 0 || terms >= 2 * static_cast<int>(orbits)) {
    invalid_input({fmt::format("from 0 to {} cosines for {} orbits", 2 * orbits - 1, orbits),
                   fmt::format("{}", terms), "fewer cosines make a smoother function"});
  }
  const Data data = data_of(lattice, alpha);
  const bool passes = terms + 1 >= data.distances;
  const auto score = [&](double w) {
    const Series fit = fit_at(data, terms, w);
    if (!passes) return fit.misfit;
    return fit.passes ? fit.bending : std::numeric_limits<double>::infinity();
  };
  constexpr int samples = 100;
  const double w = least_of(pi / (2.0 * data.reach), 3.0 * pi / (2.0 * data.reach), samples, score);
  const Series best = fit_at(data, terms, w);

  Micromodulus fourier;
  fourier.kernel = Kernel::fourier;
  fourier.a0 = best.coefficients[0];
  fourier.a.assign(best.coefficients.begin() + 1, best.coefficients.end());
  fourier.w = w;
  fourier.spacing = lattice.family.spacing;
  InfluenceFit fit = examine_influence(fourier, lattice.medium.horizon, lattice.medium.continuum);
  fit.largest_deviation =
      (cosines(data.distance, terms, w) * best.coefficients - data.alpha).lpNorm<Eigen::Infinity>();
  return fit;
}

template InfluenceFit fit_influence<1>(const Lattice<1>&, const std::vector<double>&, int);
template InfluenceFit fit_influence<2>(const Lattice<2>&, const std::vector<double>&, int);
template InfluenceFit fit_influence<3>(const Lattice<3>&, const std::vector<double>&, int);

}  // namespace perimode
