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

}  // namespace

template <int Dim>
std::vector<double> cloud_horizons(const Particles<Dim>& particles, int neighbours) {
  const Index n = particles.count();
  if (neighbours >= n) {
    invalid_input({fmt::format("body.horizon.neighbours below the number of particles, {}", n),
                   fmt::format("{}", neighbours),
                   "ask for fewer neighbours",
                   {}});
  }
  const PointSet<Dim> points{particles.position};
  Tree<Dim> tree(Dim, points, nanoflann::KDTreeSingleIndexAdaptorParams(10));
  std::vector<double> horizon(n);
  const std::size_t wanted = static_cast<std::size_t>(neighbours) + 1;  // the particle finds itself
#pragma omp parallel
  {
    std::vector<std::uint32_t> index(wanted);
    std::vector<double> square(wanted);
#pragma omp for schedule(static)
    for (Index i = 0; i < n; ++i) {
      tree.knnSearch(particles.position[i].data(), wanted, index.data(), square.data());
      horizon[i] = std::sqrt(square[wanted - 1]);
    }
  }
  return horizon;
}

template <int Dim>
CloudBonds<Dim> make_cloud_bonds(const Particles<Dim>& particles, const std::vector<double>& horizon,
                                 VolumeCorrection correction, double section) {
  const Index n = particles.count();
  std::vector<double> size(n);
  for (Index i = 0; i < n; ++i) size[i] = std::pow(particles.volume[i] / section, 1.0 / Dim);
  const double largest = *std::max_element(size.begin(), size.end());
  const PointSet<Dim> points{particles.position};
  Tree<Dim> tree(Dim, points, nanoflann::KDTreeSingleIndexAdaptorParams(10));

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
  const double extra = correction == VolumeCorrection::none ? 0.0 : 0.5 * largest;
#pragma omp parallel for schedule(dynamic, 256)
  for (Index i = 0; i < n; ++i) {
    const double radius = horizon[i] * (1.0 + 2.0 * tie) + extra;
    std::vector<std::pair<std::uint32_t, double>> found;
    tree.radiusSearch(particles.position[i].data(), radius * radius, found,
                      nanoflann::SearchParams(32, 0.0, false));
    for (const auto& hit : found) {
      const auto j = static_cast<Index>(hit.first);
      const double length = (particles.position[j] - particles.position[i]).norm();
      if (j != i && share(i, j, length) > 0.0) row[i].push_back(j);
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
  b.start.assign(1, 0);
  for (Index i = 0; i < n; ++i) {
    auto& r = row[i];
    std::sort(r.begin(), r.end());
    r.erase(std::unique(r.begin(), r.end()), r.end());
    for (Index j : r) {
      const Point<Dim> xi = particles.position[j] - particles.position[i];
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
  template std::vector<double> cloud_horizons<D>(const Particles<D>&, int);                   \
  template CloudBonds<D> make_cloud_bonds<D>(const Particles<D>&, const std::vector<double>&, \
                                             VolumeCorrection, double)
PERIMODE_CLOUD(1);
PERIMODE_CLOUD(2);
PERIMODE_CLOUD(3);
#undef PERIMODE_CLOUD

}  // namespace perimode
