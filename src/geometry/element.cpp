// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/element.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace perimode {

namespace {

/// Corners of the reference square and cube, in the order of Gmsh and Exodus.
constexpr std::array<std::array<double, 3>, 8> reference = {
    {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};

/// Place and Jacobian determinant of a bilinear or trilinear element at s.
struct Mapped {
  Point<3> x = Point<3>::Zero();
  double determinant = 0.0;
};
Mapped mapped(const std::vector<Point<3>>& corner, int dimension, const std::array<double, 3>& s) {
  Mapped at;
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
  if (dimension == 2) jacobian(2, 2) = 1.0;
  for (std::size_t c = 0; c < corner.size(); ++c) {
    std::array<double, 3> share = {1.0, 1.0, 1.0};
    for (int a = 0; a < dimension; ++a) share[a] = 0.5 * (1.0 + reference[c][a] * s[a]);
    at.x += share[0] * share[1] * share[2] * corner[c];
    for (int a = 0; a < dimension; ++a) {
      double slope = 0.5 * reference[c][a];
      for (int b = 0; b < dimension; ++b) slope *= b == a ? 1.0 : share[b];
      jacobian.col(a).head(dimension) += slope * corner[c].head(dimension);
    }
  }
  at.determinant = jacobian.determinant();
  return at;
}

ElementSize simplex(const std::vector<Point<3>>& corner, int dimension, double flat) {
  ElementSize size;
  Eigen::Matrix3d edges = Eigen::Matrix3d::Identity();
  for (int a = 0; a < dimension; ++a)
    edges.col(a).head(dimension) = (corner[a + 1] - corner[0]).head(dimension);
  const double determinant = edges.determinant();
  if (!(determinant > flat)) return size;
  size.volume = determinant / (dimension == 2 ? 2.0 : 6.0);
  for (const auto& x : corner) size.centroid += x / static_cast<double>(corner.size());
  return size;
}

}  // namespace

int nodes_of(Shape shape) {
  switch (shape) {
    case Shape::triangle:
      return 3;
    case Shape::quadrilateral:
    case Shape::tetrahedron:
      return 4;
    case Shape::hexahedron:
      break;
  }
  return 8;
}

int dimension_of(Shape shape) { return shape == Shape::triangle || shape == Shape::quadrilateral ? 2 : 3; }

ElementSize element_size(Shape shape, const std::vector<Point<3>>& corner) {
  const int dimension = dimension_of(shape);
  double longest = 0.0;
  for (const auto& a : corner) {
    for (const auto& b : corner) longest = std::max(longest, (a - b).norm());
  }
  const double flat = 1e-12 * std::pow(longest, dimension);
  if (shape == Shape::triangle || shape == Shape::tetrahedron) return simplex(corner, dimension, flat);

  ElementSize size;
  for (std::size_t c = 0; c < corner.size(); ++c) {
    if (!(mapped(corner, dimension, reference[c]).determinant > flat)) return size;
  }
  // Two Gauss points per axis integrate x det J, of degree 3 per axis, exactly.
  const double gauss = 1.0 / std::sqrt(3.0);
  for (std::size_t c = 0; c < corner.size(); ++c) {
    const Mapped at = mapped(corner, dimension,
                             {gauss * reference[c][0], gauss * reference[c][1], gauss * reference[c][2]});
    size.volume += at.determinant;
    size.centroid += at.determinant * at.x;
  }
  size.centroid /= size.volume;
  return size;
}

bool is_plane(const std::vector<Point<3>>& corner) {
  double low = corner[0][2], high = low, size = 0.0;
  for (const auto& x : corner) {
    low = std::min(low, x[2]);
    high = std::max(high, x[2]);
    size = std::max(size, (x - corner[0]).norm());
  }
  return high - low <= 1e-9 * size;
}

std::array<std::ptrdiff_t, 2> twin_points(const CloudData& cloud) {
  const auto d = static_cast<std::size_t>(cloud.dimension);
  const auto at = [&](std::size_t i) { return cloud.position.begin() + static_cast<std::ptrdiff_t>(d * i); };
  std::vector<std::size_t> order(cloud.count());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    const auto ij = std::lexicographical_compare_three_way(at(i), at(i + 1), at(j), at(j + 1));
    return std::is_neq(ij) ? std::is_lt(ij) : i < j;
  });
  for (std::size_t k = 1; k < order.size(); ++k) {
    if (std::equal(at(order[k]), at(order[k] + 1), at(order[k - 1])))
      return {static_cast<std::ptrdiff_t>(order[k - 1]), static_cast<std::ptrdiff_t>(order[k])};
  }
  return {-1, -1};
}

}  // namespace perimode
