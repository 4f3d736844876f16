// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/dispersion/zone.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

#include "dispersion/branches.hpp"
#include "dispersion/symbol_gradient.hpp"
#include "dispersion/symbol_on_grid.hpp"

namespace perimode {
namespace {

using std::numbers::pi;

/// What a row of the grid contributes.
template <int Dim>
struct Part {
  double least = infinity, largest = -infinity, least_speed = infinity;
  Point<Dim> least_at = Point<Dim>::Zero();
  Point<Dim> largest_at = Point<Dim>::Zero();
  std::array<double, 2> squares = {}, worst = {}, weight = {};  // P, S

  void add(const Part& other) {
    if (other.least < least) {
      least = other.least;
      least_at = other.least_at;
    }
    if (other.largest > largest) {
      largest = other.largest;
      largest_at = other.largest_at;
    }
    least_speed = std::min(least_speed, other.least_speed);
    for (std::size_t b = 0; b < 2; ++b) {
      squares[b] += other.squares[b];
      worst[b] = std::max(worst[b], other.worst[b]);
      weight[b] += other.weight[b];
    }
  }
};

/// How many points of the whole grid a point x >= y >= z of the wedge stands for.
template <int Dim>
double images(int x, int y, int z) {
  if constexpr (Dim == 1) return 1.0;
  if constexpr (Dim == 2) return x == y ? 1.0 : 2.0;
  if (x == y && y == z) return 1.0;
  return x == y || y == z ? 3.0 : 6.0;
}

template <int Dim>
std::array<double, 2> classical_speeds(const Medium& medium) {
  return {classical_speed(medium, Branch::pressure), Dim > 1 ? classical_speed(medium, Branch::shear) : 1.0};
}

template <int Dim>
void add_point(Part<Dim>& part, const Eigen::Matrix<double, Dim, Dim>& symbol, const Point<Dim>& k,
               double weight, const std::array<double, 2>& speed) {
  const double number = k.norm();
  const Branches<Dim> branches = branches_of<Dim>(symbol, k / number, symbol.trace());
  for (std::size_t b = 0; b < Dim; ++b) {
    const double squared = branches.squared[b];
    if (squared < part.least) {
      part.least = squared;
      part.least_at = k;
    }
    if (squared > part.largest) {
      part.largest = squared;
      part.largest_at = k;
    }
    part.least_speed = std::min(part.least_speed, squared / (number * number));
    const std::size_t kind = b > 0 ? 1 : 0;
    const double error = std::sqrt(std::max(squared, 0.0)) / (speed[kind] * number) - 1.0;
    part.squares[kind] += weight * error * error;
    part.worst[kind] = std::max(part.worst[kind], std::abs(error));
    part.weight[kind] += weight;
  }
}

template <int Dim>
std::vector<Part<Dim>> survey_rows(const Lattice<Dim>& lattice, int n) {
  const SymbolOnGrid<Dim> grid(lattice, n);
  const std::array<double, 2> speed = classical_speeds<Dim>(lattice.medium);
  std::vector<std::array<int, 2>> rows;  // y, z of the wedge
  rows.reserve(Dim == 1 ? 1 : Dim == 2 ? static_cast<std::size_t>(n) : static_cast<std::size_t>(n) * n);
  for (int z = 0; z < (Dim > 2 ? n : 1); ++z) {
    for (int y = z; y < (Dim > 1 ? n : 1); ++y) rows.push_back({y, z});
  }
  std::vector<Part<Dim>> parts(rows.size());
  const double step = pi / (lattice.family.spacing * (n - 1));
  const auto count = static_cast<std::ptrdiff_t>(rows.size());
#pragma omp parallel
  {
    typename SymbolOnGrid<Dim>::Row row;
#pragma omp for schedule(dynamic)
    for (std::ptrdiff_t r = 0; r < count; ++r) {
      const auto [y, z] = rows[static_cast<std::size_t>(r)];
      grid.start_row(y, z, row);
      for (int x = y; x < n; ++x) {
        const std::array<int, 3> place = {x, y, z};
        if (x == 0) continue;  // k = 0
        Point<Dim> k;
        for (int a = 0; a < Dim; ++a) k[a] = step * place[static_cast<std::size_t>(a)];
        add_point<Dim>(parts[static_cast<std::size_t>(r)], grid.symbol(row, x), k, images<Dim>(x, y, z),
                       speed);
      }
    }
  }
  return parts;
}

template <int Dim>
struct Top {
  double squared = 0.0;
  Point<Dim> k = Point<Dim>::Zero();
};

/// The largest eigenvalue at k with its gradient and the Newton step towards a maximum, if it has one.
template <int Dim>
struct LargestEigenvalue {
  double value = 0.0;
  Point<Dim> gradient = Point<Dim>::Zero();
  std::optional<Point<Dim>> step = {};

  LargestEigenvalue(const Lattice<Dim>& lattice, const Point<Dim>& k) {
    const SymbolGradient<Dim> symbol = symbol_gradient<Dim>(lattice, k);
    const Branches<Dim> pairs = ascending_eigenpairs<Dim>(symbol.symbol);
    value = pairs.squared[Dim - 1];
    const Point<Dim> a = pairs.polarisation.col(Dim - 1);
    gradient = symbol.between(a, a);
    Eigen::Matrix<double, Dim, Dim> hessian = Eigen::Matrix<double, Dim, Dim>::Zero();
    for_each_pair(lattice, [&](const Point<Dim>& xi, double rate) {
      hessian += (rate * std::pow(a.dot(xi), 2) * std::cos(k.dot(xi))) * xi * xi.transpose();
    });
    for (int b = 0; b + 1 < Dim; ++b) {
      const double gap = value - pairs.squared[static_cast<std::size_t>(b)];
      if (gap <= 1e-9 * symbol.scale) continue;  // crossing: the branch of this eigenvector
      const Point<Dim> mixed = symbol.between(a, pairs.polarisation.col(b));
      hessian += (2.0 / gap) * mixed * mixed.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, Dim, Dim>> solver(hessian);
    const double curvature = -solver.eigenvalues()[Dim - 1];
    if (curvature > 1e-12 * std::abs(solver.eigenvalues()[0]))
      step = Point<Dim>(-solver.eigenvectors() * (solver.eigenvalues().cwiseInverse().asDiagonal() *
                                                  (solver.eigenvectors().transpose() * gradient)));
  }
};

/// Climbs from a point of the grid: Newton steps where the branch is concave, else along the gradient, no
/// longer than the grid's mesh, halved until they rise. Never below where it began.
template <int Dim>
Top<Dim> climb(const Lattice<Dim>& lattice, const Point<Dim>& start, double mesh) {
  LargestEigenvalue<Dim> here(lattice, start);
  Top<Dim> top{here.value, start};
  for (int iteration = 0; iteration < 40; ++iteration) {
    if (here.gradient.norm() * mesh <= 1e-15 * std::abs(here.value)) break;
    Point<Dim> step = here.step ? *here.step : Point<Dim>(here.gradient * (mesh / here.gradient.norm()));
    if (step.norm() > mesh) step *= mesh / step.norm();
    bool risen = false;
    for (int halving = 0; halving < 12 && !risen; ++halving, step *= 0.5) {
      const LargestEigenvalue<Dim> next(lattice, top.k + step);
      risen = next.value > top.squared;
      if (!risen) continue;
      top = {next.value, top.k + step};
      here = next;
    }
    if (!risen) break;
  }
  return top;
}

/// The image of k in [0, pi/spacing]^Dim.
template <int Dim>
Point<Dim> folded(const Point<Dim>& k, double spacing) {
  Point<Dim> inside;
  for (int a = 0; a < Dim; ++a) inside[a] = std::abs(std::remainder(k[a], 2.0 * pi / spacing));
  return inside;
}

/// Climbs from the highest points of all rows that may lie beside the highest maximum: the eigenvector of
/// that maximum loses at most (1/2) sum_j |rate_j| |xi_j|^2 (mesh/2)^2 Dim on the way to the nearest grid
/// point.
template <int Dim>
Top<Dim> refined_top(const Lattice<Dim>& lattice, const std::vector<Part<Dim>>& parts, const Part<Dim>& all,
                     double mesh) {
  Top<Dim> best{all.largest, all.largest_at};
  double curvature = 0.0;
  for_each_pair(lattice, [&](const Point<Dim>& xi, double rate) {
    curvature += std::abs(rate) * std::pow(xi.squaredNorm(), 2);
  });
  const double threshold = all.largest - 0.125 * Dim * curvature * mesh * mesh;
  std::vector<Point<Dim>> starts;
  starts.reserve(parts.size());
  for (const Part<Dim>& part : parts) {
    if (part.largest >= threshold) starts.push_back(part.largest_at);
  }
  std::vector<Top<Dim>> tops(starts.size());
  const auto count = static_cast<std::ptrdiff_t>(starts.size());
#pragma omp parallel for schedule(dynamic)
  for (std::ptrdiff_t i = 0; i < count; ++i)
    tops[static_cast<std::size_t>(i)] = climb<Dim>(lattice, starts[static_cast<std::size_t>(i)], mesh);
  for (const Top<Dim>& top : tops) {
    if (top.squared > best.squared) best = {top.squared, folded<Dim>(top.k, lattice.family.spacing)};
  }
  return best;
}

/// Smallest squared speed of long waves along the axes and diagonals.
template <int Dim>
double least_long_wave_speed_squared(const Lattice<Dim>& lattice) {
  double least = infinity;
  Point<Dim> direction = Point<Dim>::Zero();
  for (int a = 0; a < Dim; ++a) {
    direction[a] = 1.0;
    const auto symbol = acoustic_tensor<Dim>(lattice, direction.normalized()).symbol;
    least = std::min(least, ascending_eigenpairs<Dim>(symbol).squared[0]);
  }
  return least;
}

}  // namespace

template <int Dim>
ZoneSurvey<Dim> survey_zone(const Lattice<Dim>& lattice, int points_per_axis) {
  if (points_per_axis < 2) {
    invalid_input({"at least 2 points per axis of the zone", fmt::format("{}", points_per_axis),
                   "64 resolve most kernels"});
  }
  const std::vector<Part<Dim>> parts = survey_rows<Dim>(lattice, points_per_axis);
  Part<Dim> all;
  for (const Part<Dim>& part : parts) all.add(part);  // in order: the same for any number of threads

  ZoneSurvey<Dim> survey;
  survey.points_per_axis = points_per_axis;
  survey.least_squared = all.least;
  survey.least_at = all.least_at;
  survey.least_speed_squared = std::min(all.least_speed, least_long_wave_speed_squared<Dim>(lattice));
  const double mesh = pi / (lattice.family.spacing * (points_per_axis - 1));
  const Top<Dim> top = refined_top<Dim>(lattice, parts, all, mesh);
  survey.omega_max = std::sqrt(std::max(top.squared, 0.0));
  survey.omega_max_at = top.k;
  survey.stable_step = 2.0 / survey.omega_max;
  for (std::size_t b = 0; b < (Dim > 1 ? 2U : 1U); ++b) {
    survey.phase_error[b] = std::sqrt(all.squares[b] / all.weight[b]);
    survey.worst_phase_error[b] = all.worst[b];
  }
  return survey;
}

template <int Dim>
std::vector<PlaneWaves<Dim>> waves_around(const Lattice<Dim>& lattice, double k, int directions) {
  if (directions < 1) {
    invalid_input({"at least one direction", fmt::format("{}", directions), "360 draw a smooth curve"});
  }
  const int count = Dim == 1 ? 1 : directions;
  std::vector<PlaneWaves<Dim>> waves(static_cast<std::size_t>(count));
#pragma omp parallel for schedule(static)
  for (int i = 0; i < count; ++i) {
    Point<Dim> direction = Point<Dim>::Unit(0);
    if constexpr (Dim > 1) {
      const double angle = 2.0 * pi * i / count;
      direction[0] = std::cos(angle);
      direction[1] = std::sin(angle);
    }
    waves[static_cast<std::size_t>(i)] = plane_waves<Dim>(lattice, k * direction, direction);
  }
  return waves;
}

#define PERIMODE_ZONE(D)                                         \
  template ZoneSurvey<D> survey_zone<D>(const Lattice<D>&, int); \
  template std::vector<PlaneWaves<D>> waves_around<D>(const Lattice<D>&, double, int)
PERIMODE_ZONE(1);
PERIMODE_ZONE(2);
PERIMODE_ZONE(3);
#undef PERIMODE_ZONE

}  // namespace perimode
