// SPDX-License-Identifier: BSD-3-Clause
#include "dispersion/sampled_errors.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/quadrature.hpp"

namespace perimode {
namespace {

using std::numbers::pi;

template <int Dim>
Point<Dim> offset_of(const Family<Dim>& family, std::size_t j) {
  Point<Dim> xi;
  for (int a = 0; a < Dim; ++a) xi[a] = family.offset[j][static_cast<std::size_t>(a)];
  return xi;
}

/// Nodes and weights of the composite rule over [0, pi].
std::vector<QuadratureNode> composite_rule(int panels) {
  std::vector<QuadratureNode> rule;
  rule.reserve(16 * static_cast<std::size_t>(panels));
  const double half = 0.5 * pi / panels;
  for (int panel = 0; panel < panels; ++panel) {
    for (const QuadratureNode& node : gauss_legendre())
      rule.push_back({(2 * panel + 1 + node.x) * half, node.weight * half});
  }
  return rule;
}

/// The symbols of all orbits at one wave vector.
template <int Dim>
std::vector<Eigen::Matrix<double, Dim, Dim>> orbit_symbols(const Family<Dim>& family,
                                                           const std::vector<double>& rates,
                                                           const Point<Dim>& k) {
  std::vector<Eigen::Matrix<double, Dim, Dim>> symbols(family.shell.size(),
                                                       Eigen::Matrix<double, Dim, Dim>::Zero());
  for (std::size_t j = 0; j < rates.size() / 2; ++j) {  // a bond and its negative give the same
    const Point<Dim> xi = offset_of(family, j);
    const double s = std::sin(0.5 * k.dot(xi));
    symbols[static_cast<std::size_t>(family.orbit[j])] +=
        (4.0 * rates[j] * s * s / xi.squaredNorm()) * xi * xi.transpose();
  }
  return symbols;
}

/// The wave vectors of one sum over permutations: descending indices, and how many permutations they stand
/// for.
template <int Dim>
struct Wedge {
  std::array<int, Dim> index = {};
  double permutations = 1.0;
};

template <int Dim>
std::vector<Wedge<Dim>> wedge_of(int first) {
  std::vector<Wedge<Dim>> all;
  if constexpr (Dim == 1) {
    all.push_back({{first}, 1.0});
  } else if constexpr (Dim == 2) {
    for (int y = 0; y <= first; ++y) all.push_back({{first, y}, y == first ? 1.0 : 2.0});
  } else {
    for (int y = 0; y <= first; ++y) {
      for (int z = 0; z <= y; ++z) {
        const int equal = (y == first ? 1 : 0) + (z == y ? 1 : 0);
        all.push_back({{first, y, z}, equal == 2 ? 1.0 : (equal == 1 ? 3.0 : 6.0)});
      }
    }
  }
  return all;
}

}  // namespace

template <int Dim>
Eigen::VectorXd orbit_squares(const Family<Dim>& family, const std::vector<double>& rates,
                              const Point<Dim>& k, const Point<Dim>& a) {
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(family.shell.size()));
  for (std::size_t j = 0; j < rates.size() / 2; ++j) {
    const Point<Dim> xi = offset_of(family, j);
    const double s = std::sin(0.5 * k.dot(xi)), along = a.dot(xi);
    squares[family.orbit[j]] += 4.0 * rates[j] * s * s * along * along / xi.squaredNorm();
  }
  return squares;
}

template <int Dim>
SampledErrors sample_contour(const Family<Dim>& family, const std::vector<double>& rates,
                             const std::array<double, 2>& speeds, const std::array<double, 2>& weights,
                             int panels) {
  const std::vector<ContourBranch<Dim>> sides = contour_branches<Dim>();
  const std::vector<QuadratureNode> rule = composite_rule(panels);
  const auto points = static_cast<Eigen::Index>(sides.size() * rule.size());
  SampledErrors samples{Eigen::MatrixXd(points, static_cast<Eigen::Index>(family.shell.size())),
                        Eigen::VectorXd(points), Eigen::VectorXd(points), Eigen::VectorXd(points)};
  Eigen::Index row = 0;
  for (const ContourBranch<Dim>& side : sides) {
    const std::size_t which = side.branch == Branch::pressure ? 0 : 1;
    for (const QuadratureNode& node : rule) {
      const Point<Dim> k = contour_point(side, node.x);
      samples.values.row(row) = orbit_squares<Dim>(family, rates, k, side.polarisation).transpose();
      samples.targets[row] = speeds[which] * k.squaredNorm();
      samples.measure[row] = side.count * step_length(side) * node.weight;
      samples.weights[row] = weights[which];
      ++row;
    }
  }
  return samples;
}

void ReducedObjective::add(const Eigen::MatrixXd& rows, const Eigen::VectorXd& right) {
  const Eigen::Index columns = triangle_.cols(), old = triangle_.rows();
  Eigen::MatrixXd stacked(old + rows.rows(), columns);
  stacked.topRows(old) = triangle_;
  stacked.bottomRows(rows.rows()).leftCols(columns - 1) = rows;
  stacked.bottomRows(rows.rows()).rightCols(1) = right;
  if (stacked.rows() <= columns) {
    triangle_ = std::move(stacked);
    return;
  }
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(stacked);
  triangle_ = qr.matrixQR().topRows(columns).template triangularView<Eigen::Upper>();
}

ReducedObjective contour_objective(const SampledErrors& samples) {
  const Eigen::VectorXd scale = samples.weights.cwiseProduct(samples.measure.cwiseSqrt());
  ReducedObjective objective(samples.values.cols());
  objective.add(scale.asDiagonal() * samples.values, scale.cwiseProduct(samples.targets));
  return objective;
}

template <int Dim>
ReducedObjective zone_objective(const Family<Dim>& family, const std::vector<double>& rates,
                                const std::array<double, 2>& speeds, const std::array<double, 2>& weights,
                                int panels) {
  using Matrix = Eigen::Matrix<double, Dim, Dim>;
  constexpr int entries = Dim * (Dim + 1) / 2;
  const std::vector<QuadratureNode> rule = composite_rule(panels);
  const auto n = static_cast<int>(rule.size());
  const auto orbits = static_cast<Eigen::Index>(family.shell.size());
  ReducedObjective objective(orbits);
  for (int first = 0; first < n; ++first) {
    const std::vector<Wedge<Dim>> wedge = wedge_of<Dim>(first);
    const auto points = static_cast<Eigen::Index>(wedge.size());
    Eigen::MatrixXd rows(entries * points, orbits);
    Eigen::VectorXd right(entries * points);
    for (Eigen::Index p = 0; p < points; ++p) {
      const Wedge<Dim>& place = wedge[static_cast<std::size_t>(p)];
      Point<Dim> k;
      double measure = place.permutations;
      for (int a = 0; a < Dim; ++a) {
        const QuadratureNode& node = rule[static_cast<std::size_t>(place.index[static_cast<std::size_t>(a)])];
        k[a] = node.x;
        measure *= node.weight;
      }
      const double k2 = k.squaredNorm();
      const Matrix along = k * k.transpose() / k2, across = Matrix::Identity() - along;
      const Matrix w = std::sqrt(weights[0]) * along + std::sqrt(weights[1]) * across;
      const Matrix exact = k2 * (speeds[0] * weights[0] * along + speeds[1] * weights[1] * across);
      const std::vector<Matrix> symbols = orbit_symbols<Dim>(family, rates, k);
      Eigen::Index row = entries * p;
      for (int a = 0; a < Dim; ++a) {
        for (int b = a; b < Dim; ++b) {
          const double scale = std::sqrt(a == b ? measure : 2.0 * measure);
          for (Eigen::Index o = 0; o < orbits; ++o)
            rows(row, o) = scale * w.row(a).dot(symbols[static_cast<std::size_t>(o)] * w.col(b));
          right[row] = scale * exact(a, b);
          ++row;
        }
      }
    }
    objective.add(rows, right);
  }
  return objective;
}

template Eigen::VectorXd orbit_squares<1>(const Family<1>&, const std::vector<double>&, const Point<1>&,
                                          const Point<1>&);
template SampledErrors sample_contour<1>(const Family<1>&, const std::vector<double>&,
                                         const std::array<double, 2>&, const std::array<double, 2>&, int);
template ReducedObjective zone_objective<1>(const Family<1>&, const std::vector<double>&,
                                            const std::array<double, 2>&, const std::array<double, 2>&, int);
template Eigen::VectorXd orbit_squares<2>(const Family<2>&, const std::vector<double>&, const Point<2>&,
                                          const Point<2>&);
template SampledErrors sample_contour<2>(const Family<2>&, const std::vector<double>&,
                                         const std::array<double, 2>&, const std::array<double, 2>&, int);
template ReducedObjective zone_objective<2>(const Family<2>&, const std::vector<double>&,
                                            const std::array<double, 2>&, const std::array<double, 2>&, int);
template Eigen::VectorXd orbit_squares<3>(const Family<3>&, const std::vector<double>&, const Point<3>&,
                                          const Point<3>&);
template SampledErrors sample_contour<3>(const Family<3>&, const std::vector<double>&,
                                         const std::array<double, 2>&, const std::array<double, 2>&, int);
template ReducedObjective zone_objective<3>(const Family<3>&, const std::vector<double>&,
                                            const std::array<double, 2>&, const std::array<double, 2>&, int);

}  // namespace perimode
