// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nanoflann.hpp>

#include "perimode/bonds/bonds.hpp"
#include "perimode/core/error.hpp"

namespace perimode {

namespace {

constexpr double tie = 1e-9;

template <int Dim>
struct PointSet {
  const std::vector<Point<Dim>>& x;
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return x.size(); }
  [[nodiscard]] double kdtree_get_pt(std::size_t i, std::size_t a) const { return x[i][static_cast<int>(a)]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

template <int Dim>
using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, PointSet<Dim>>,
                                                 PointSet<Dim>, Dim, std::uint32_t>;

/// The particles of a cloud and their periodic images next to it.
template <int Dim>
class Neighbourhood {
 public:
  Neighbourhood(const std::vector<Point<Dim>>& position, const Point<Dim>& period)
      : points_{position},
        tree_(Dim, points_, nanoflann::KDTreeSingleIndexAdaptorParams(10)),
        period_(period),
        low_(position.front()),
        high_(position.front()) {
    for (const auto& x : position) {
      low_ = low_.cwiseMin(x);
      high_ = high_.cwiseMax(x);
    }
  }

  /// From x to y or the image of y that is nearest along every axis. The same for y to x but for the sign, to
  /// the last bit.
  [[nodiscard]] Point<Dim> apart(const Point<Dim>& x, const Point<Dim>& y) const {
    Point<Dim> xi = y - x;
    for (int a = 0; a < Dim; ++a) {
      if (period_[a] == 0.0) continue;
      if (xi[a] > 0.5 * period_[a])
        xi[a] -= period_[a];
      else if (xi[a] < -0.5 * period_[a])
        xi[a] += period_[a];
    }
    return xi;
  }

  /// Particles of which an image (or the particle itself) lies within the radius of x.
  void within(const Point<Dim>& x, double radius,
              std::vector<std::pair<std::uint32_t, double>>& found) const {
    found.clear();
    std::vector<std::pair<std::uint32_t, double>> some;
    for_each_image(x, [&](const Point<Dim>& y) {
      if (square_to_box(y) > radius * radius) return;
      tree_.radiusSearch(y.data(), radius * radius, some, nanoflann::SearchParams(32, 0.0, false));
      found.insert(found.end(), some.begin(), some.end());
    });
  }

  /// Distance from x to the nearest `square.size()`-th of the particles and images; x itself counts.
  [[nodiscard]] double nearest(const Point<Dim>& x, std::vector<std::uint32_t>& index,
                               std::vector<double>& square) const {
    const std::size_t wanted = square.size();
    tree_.knnSearch(x.data(), wanted, index.data(), square.data());
    std::vector<double> more(wanted);
    for_each_image(x, [&](const Point<Dim>& y) {
      if (y == x || square_to_box(y) >= square[wanted - 1]) return;
      tree_.knnSearch(y.data(), wanted, index.data(), more.data());
      square.insert(square.end(), more.begin(), more.end());
      std::sort(square.begin(), square.end());
      square.resize(wanted);
    });
    return std::sqrt(square[wanted - 1]);
  }

 private:
  template <class Visit>
  void for_each_image(const Point<Dim>& x, const Visit& visit, int axis = 0) const {
    if (axis == Dim) {
      visit(x);
      return;
    }
    for_each_image(x, visit, axis + 1);
    if (period_[axis] == 0.0) return;
    for (const double by : {-period_[axis], period_[axis]}) {
      Point<Dim> y = x;
      y[axis] += by;
      for_each_image(y, visit, axis + 1);
    }
  }
  [[nodiscard]] double square_to_box(const Point<Dim>& x) const {
    return (low_ - x).cwiseMax(x - high_).cwiseMax(0.0).squaredNorm();
  }

  PointSet<Dim> points_;
  Tree<Dim> tree_;
  Point<Dim> period_, low_, high_;
};

template <int Dim>
void require_long_periods(const Point<Dim>& period, double reach) {
  for (int a = 0; a < Dim; ++a) {
    if (period[a] == 0.0 || period[a] > 2.0 * reach) continue;
    invalid_input({fmt::format("a period of the cloud along {} above twice the longest reach of its bonds, "
                               "2 x {:.6g} m",
                               "xyz"[a], reach),
                   fmt::format("{:.6g} m", period[a]),
                   "shorten the horizon, or repeat the cloud in its file and lengthen body.particles.period",
                   {}});
  }
}

}  // namespace

template <int Dim>
std::vector<double> cloud_horizons(const Particles<Dim>& particles, int neighbours,
                                   const Point<Dim>& period) {
  const Index n = particles.count();
  if (neighbours >= n) {
    invalid_input({fmt::format("body.horizon.neighbours below the number of particles, {}", n),
                   fmt::format("{}", neighbours),
                   "ask for fewer neighbours",
                   {}});
  }
  const Neighbourhood<Dim> cloud(particles.position, period);
  std::vector<double> horizon(n);
  const std::size_t wanted = static_cast<std::size_t>(neighbours) + 1;  // the particle finds itself
#pragma omp parallel
  {
    std::vector<std::uint32_t> index(wanted);
    std::vector<double> square(wanted);
#pragma omp for schedule(static)
    for (Index i = 0; i < n; ++i) horizon[i] = cloud.nearest(particles.position[i], index, square);
  }
  return horizon;
}

template <int Dim>
CloudBonds<Dim> make_cloud_bonds(const Particles<Dim>& particles, const std::vector<double>& horizon,
                                 VolumeCorrection correction, double section, const Point<Dim>& period) {
  const Index n = particles.count();
  std::vector<double> size(n);
  for (Index i = 0; i < n; ++i) size[i] = std::pow(particles.volume[i] / section, 1.0 / Dim);
  const double largest = *std::max_element(size.begin(), size.end());
  const double extra = correction == VolumeCorrection::none ? 0.0 : 0.5 * largest;
  const auto reach_of = [&](double delta) { return delta * (1.0 + 2.0 * tie) + extra; };
  require_long_periods(period, reach_of(*std::max_element(horizon.begin(), horizon.end())));
  const Neighbourhood<Dim> cloud(particles.position, period);
  const auto apart = [&](Index i, Index j) {
    return cloud.apart(particles.position[i], particles.position[j]);
  };

  /// beta of the pair; 0 outside. Symmetric in i and j to the last bit.
  const auto share = [&](Index i, Index j, double length) {
    const double reach = std::max(horizon[i], horizon[j]);
    if (correction == VolumeCorrection::none) return length <= reach * (1.0 + tie) ? 1.0 : 0.0;
    const double h = 0.5 * (size[i] + size[j]);
    const double inside = (reach + 0.5 * h - length) / h;
    return inside > tie ? std::min(1.0, inside) : 0.0;
  };

  // Particle i finds the partners within its own reach; those whose reach is longer find i and
  // are added to i's row below.
  std::vector<std::vector<Index>> row(n);
#pragma omp parallel for schedule(dynamic, 256)
  for (Index i = 0; i < n; ++i) {
    std::vector<std::pair<std::uint32_t, double>> found;
    cloud.within(particles.position[i], reach_of(horizon[i]), found);
    for (const auto& hit : found) {
      const auto j = static_cast<Index>(hit.first);
      if (j != i && share(i, j, apart(i, j).norm()) > 0.0) row[i].push_back(j);
    }
  }
  for (Index i = 0; i < n; ++i) {
    const std::size_t own = row[i].size();
    for (std::size_t k = 0; k < own; ++k) {
      const Index j = row[i][k];
      if (horizon[j] < horizon[i]) row[j].push_back(i);
    }
  }

  CloudBonds<Dim> b;
  b.period = period;
  b.start.assign(1, 0);
  for (Index i = 0; i < n; ++i) {
    auto& r = row[i];
    std::sort(r.begin(), r.end());
    r.erase(std::unique(r.begin(), r.end()), r.end());
    for (Index j : r) {
      const Point<Dim> xi = apart(i, j);
      b.neighbour.push_back(j);
      b.xi.push_back(xi);
      b.weight.push_back(share(i, j, xi.norm()));
      b.horizon.push_back(0.5 * (horizon[i] + horizon[j]));
    }
    b.start.push_back(static_cast<Offset>(b.neighbour.size()));
    r = {};
  }
  b.alive.assign((b.neighbour.size() + 63) / 64, ~std::uint64_t{0});
  return b;
}

#define PERIMODE_CLOUD(D)                                                                     \
  template std::vector<double> cloud_horizons<D>(const Particles<D>&, int, const Point<D>&);  \
  template CloudBonds<D> make_cloud_bonds<D>(const Particles<D>&, const std::vector<double>&, \
                                             VolumeCorrection, double, const Point<D>&)
PERIMODE_CLOUD(1);
PERIMODE_CLOUD(2);
PERIMODE_CLOUD(3);
#undef PERIMODE_CLOUD

}  // namespace perimode
