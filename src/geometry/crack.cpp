// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/geometry/crack.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace perimode {

namespace {

/// Unit normal by Newell's formula; robust for any simple plane polygon.
Point<3> polygon_normal(const std::vector<Point<3>>& corner) {
  Point<3> n = Point<3>::Zero();
  for (std::size_t k = 0; k < corner.size(); ++k) n += corner[k].cross(corner[(k + 1) % corner.size()]);
  return n.normalized();
}

/// Where the bond meets the crack's plane; nothing if both ends lie on one side.
template <int Dim>
bool meets_plane(const Point<Dim>& normal, const Point<Dim>& origin, const Point<Dim>& a, const Point<Dim>& b,
                 double tolerance, Point<Dim>& meeting) {
  const double da = normal.dot(a - origin);
  const double db = normal.dot(b - origin);
  if ((da >= -tolerance) == (db >= -tolerance)) return false;
  const double t = std::clamp(da / (da - db), 0.0, 1.0);
  meeting = a + t * (b - a);
  return true;
}

bool inside_polygon(const Crack<3>& crack, const Point<3>& normal, const Point<3>& x, double tolerance) {
  int drop = 0;  // the plane's steepest axis is dropped for the two-dimensional ray test
  normal.cwiseAbs().maxCoeff(&drop);
  const int u = (drop + 1) % 3;
  const int v = (drop + 2) % 3;
  bool inside = false;
  const std::size_t n = crack.corner.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Point<3>& p = crack.corner[k];
    const Point<3>& q = crack.corner[(k + 1) % n];
    const Point<3> edge = q - p;
    const double s = std::clamp((x - p).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    if ((x - p - s * edge).norm() <= tolerance) return crack.joined[k];
    if ((p[v] > x[v]) != (q[v] > x[v]) && x[u] < p[u] + (x[v] - p[v]) / (q[v] - p[v]) * (q[u] - p[u])) {
      inside = !inside;
    }
  }
  return inside;
}

}  // namespace

template <>
bool crosses<1>(const Crack<1>& crack, const Point<1>& a, const Point<1>& b, double tolerance) {
  const double at = crack.corner[0][0] - tolerance;
  return (a[0] >= at) != (b[0] >= at);
}

template <>
bool crosses<2>(const Crack<2>& crack, const Point<2>& a, const Point<2>& b, double tolerance) {
  const Point<2> along = crack.corner[1] - crack.corner[0];
  const double length = along.norm();
  const Point<2> t = along / length;
  const Point<2> left(-t[1], t[0]);
  Point<2> meeting;
  if (!meets_plane<2>(left, crack.corner[0], a, b, tolerance, meeting)) return false;
  const double s = t.dot(meeting - crack.corner[0]);
  return s > (crack.joined[0] ? -tolerance : tolerance) &&
         s < length + (crack.joined[1] ? tolerance : -tolerance);
}

template <>
bool crosses<3>(const Crack<3>& crack, const Point<3>& a, const Point<3>& b, double tolerance) {
  const Point<3> normal = polygon_normal(crack.corner);
  Point<3> meeting;
  return meets_plane<3>(normal, crack.corner[0], a, b, tolerance, meeting) &&
         inside_polygon(crack, normal, meeting, tolerance);
}

template <int Dim>
Crack<Dim> reflected(const Crack<Dim>& crack, int axis, double at) {
  // Reversing the corners keeps the mirrored positive side positive.
  Crack<Dim> image;
  image.corner.assign(crack.corner.rbegin(), crack.corner.rend());
  for (auto& c : image.corner) c[axis] = 2.0 * at - c[axis];
  image.joined.assign(crack.joined.rbegin(), crack.joined.rend());
  if (Dim == 3) std::rotate(image.joined.begin(), image.joined.begin() + 1, image.joined.end());
  return image;
}

template <int Dim>
void join(std::vector<Crack<Dim>>& cracks, double tolerance) {
  const auto same = [&](const Point<Dim>& p, const Point<Dim>& q) { return (p - q).norm() <= tolerance; };
  for (auto& c : cracks) c.joined.assign(c.corner.size(), false);
  if (Dim == 1) return;
  for (std::size_t i = 0; i < cracks.size(); ++i) {
    for (std::size_t j = 0; j < cracks.size(); ++j) {
      if (i == j) continue;
      const auto& p = cracks[i].corner;
      const auto& q = cracks[j].corner;
      for (std::size_t k = 0; k < p.size(); ++k) {
        for (std::size_t l = 0; l < q.size(); ++l) {
          const auto& p2 = p[(k + 1) % p.size()];
          const auto& q2 = q[(l + 1) % q.size()];
          const bool touching =
              Dim == 2 ? same(p[k], q[l])
                       : (same(p[k], q2) && same(p2, q[l])) || (same(p[k], q[l]) && same(p2, q2));
          if (touching) cracks[i].joined[k] = true;
        }
      }
    }
  }
}

#define PERIMODE_CRACK(D)                                       \
  template Crack<D> reflected<D>(const Crack<D>&, int, double); \
  template void join<D>(std::vector<Crack<D>>&, double)
PERIMODE_CRACK(1);
PERIMODE_CRACK(2);
PERIMODE_CRACK(3);
#undef PERIMODE_CRACK

}  // namespace perimode
