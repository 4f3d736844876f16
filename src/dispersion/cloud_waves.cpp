// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/dispersion/cloud_waves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "dispersion/branches.hpp"
#include "perimode/core/error.hpp"

namespace perimode {
namespace {

template <int Dim>
using Tensor = Eigen::Matrix<double, Dim, Dim>;

template <int Dim>
const CloudBonds<Dim>& periodic_cloud(const Body<Dim>& body) {
  const auto* cloud = std::get_if<CloudBonds<Dim>>(&body.bonds);
  if (cloud == nullptr) {
    invalid_input({"a cloud for the Rayleigh quotients of its waves",
                   "a grid",
                   "plane waves of a grid are exact: use those of its lattice",
                   {}});
  }
  for (int a = 0; a < Dim; ++a) {
    if (cloud->period[a] > 0.0) continue;
    invalid_input({"a cloud that repeats itself along every axis, so that no surface disturbs its waves",
                   fmt::format("no period along {}", "xyz"[a]),
                   "give body.periodic every axis and body.particles.period its length",
                   {}});
  }
  return *cloud;
}

template <int Dim>
void require_unit(const Point<Dim>& direction) {
  if (std::abs(direction.norm() - 1.0) <= 1e-9) return;
  invalid_input(
      {"a direction of length 1", fmt::format("{}", direction.norm()), "divide it by its length", {}});
}

/// What the particles say about one wave vector.
template <int Dim>
struct Sums {
  std::vector<Tensor<Dim>> even;            ///< per particle sum k_ij n n^T (1 - cos), N/m
  std::vector<Tensor<Dim>> odd;             ///< per particle sum k_ij n n^T sin
  Tensor<Dim> total = Tensor<Dim>::Zero();  ///< sum of `even`
  std::array<Tensor<Dim>, Dim> gradient;    ///< d total / dk
};

template <int Dim>
class Waves {
 public:
  Waves(const Body<Dim>& body, const CloudBonds<Dim>& bonds, const Point<Dim>& direction)
      : bonds_(bonds),
        direction_(direction),
        mass_(static_cast<std::size_t>(body.count())),
        scaled_(bonds.neighbour.size(), 0.0) {
    double square = 0.0;
#pragma omp parallel for schedule(static) reduction(max : square)
    for (Index i = 0; i < body.count(); ++i) {
      const auto p = static_cast<std::size_t>(i);
      mass_[p] = body.density[static_cast<std::size_t>(body.particles.block[p])] * body.particles.volume[p];
      for_each_bond(bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
        square = std::max(square, end.length * end.length);
        scaled_[static_cast<std::size_t>(end.slot)] =
            bond_stiffness(body, i, end) / (end.length * end.length);
      });
    }
    longest_ = std::sqrt(square);
    for (const double m : mass_) total_mass_ += m;
  }

  [[nodiscard]] CloudWaves<Dim> at(const Point<Dim>& k) const {
    const double size = k.norm();
    const bool limit = size * longest_ < 1e-6;
    const Point<Dim> towards = limit ? direction_ : Point<Dim>(k / size);
    const Sums<Dim> sums = limit ? sum(direction_, true) : sum(k, false);
    const Tensor<Dim> symbol = sums.total / total_mass_;
    const Branches<Dim> pairs = branches_of<Dim>(symbol, towards, symbol.norm());
    CloudWaves<Dim> result;
    PlaneWaves<Dim>& w = result.waves;
    w.k = k;
    const double round_off = 1e-12 * symbol.norm();
    for (std::size_t b = 0; b < static_cast<std::size_t>(Dim); ++b) {
      const Point<Dim> a = pairs.polarisation.col(static_cast<Eigen::Index>(b));
      const double square = pairs.squared[b];
      // omega, or in the limit omega/|k|
      const double root =
          square < -round_off ? std::numeric_limits<double>::quiet_NaN() : std::sqrt(std::max(square, 0.0));
      w.polarisation.col(static_cast<Eigen::Index>(b)) = a;
      w.squared[b] = limit ? 0.0 : square;
      w.angular_frequency[b] = limit ? 0.0 : root;
      w.phase_velocity[b] = limit ? root : root / size;
      for (std::size_t c = 0; c < static_cast<std::size_t>(Dim); ++c)
        w.group_velocity[b][static_cast<Eigen::Index>(c)] =
            root == 0.0 ? 0.0 : a.dot(sums.gradient[c] * a) / (2.0 * root * total_mass_);
      if (!limit) deviations(sums, a, square, root, result.spread[b], result.residual[b]);
    }
    return result;
  }

 private:
  /// Sums over the ends; `limit`: 1 - cos and sin by (k.xi)^2/2 and k.xi.
  [[nodiscard]] Sums<Dim> sum(const Point<Dim>& k, bool limit) const {
    constexpr Index chunk = 1024;  // particles added by one thread, in order
    const auto n = static_cast<Index>(mass_.size());
    const Index chunks = (n + chunk - 1) / chunk;
    Sums<Dim> sums;
    sums.even.assign(mass_.size(), Tensor<Dim>::Zero());
    sums.odd.assign(mass_.size(), Tensor<Dim>::Zero());
    std::vector<std::array<Tensor<Dim>, Dim>> gradient(static_cast<std::size_t>(chunks));
#pragma omp parallel for schedule(dynamic)
    for (Index part = 0; part < chunks; ++part) {
      auto& own = gradient[static_cast<std::size_t>(part)];
      own.fill(Tensor<Dim>::Zero());
      for (Index i = part * chunk; i < std::min(n, (part + 1) * chunk); ++i) {
        const auto p = static_cast<std::size_t>(i);
        for (Offset e = bonds_.start[p]; e < bonds_.start[p + 1]; ++e) {
          const auto slot = static_cast<std::size_t>(e);
          const Point<Dim>& xi = bonds_.xi[slot];
          const double phase = k.dot(xi);
          const double half = limit ? 0.5 * phase : std::sin(0.5 * phase);
          const Tensor<Dim> outer = scaled_[slot] * xi * xi.transpose();
          const double sine = limit ? phase : std::sin(phase);
          sums.even[p] += 2.0 * half * half * outer;
          sums.odd[p] += sine * outer;
          for (int c = 0; c < Dim; ++c) own[static_cast<std::size_t>(c)] += sine * xi[c] * outer;
        }
      }
    }
    for (const Tensor<Dim>& t : sums.even) sums.total += t;
    sums.gradient.fill(Tensor<Dim>::Zero());
    for (const auto& part : gradient)
      for (std::size_t c = 0; c < part.size(); ++c) sums.gradient[c] += part[c];
    return sums;
  }

  void deviations(const Sums<Dim>& sums, const Point<Dim>& a, double square, double root, double& spread,
                  double& residual) const {
    double local = 0.0, whole = 0.0;
    for (std::size_t p = 0; p < mass_.size(); ++p) {
      const double m = mass_[p];
      const Point<Dim> even = sums.even[p] * a / m - square * a;
      const Point<Dim> odd = sums.odd[p] * a / m;
      const double own = a.dot(even);
      local += m * own * own;
      whole += m * (even.squaredNorm() + odd.squaredNorm());
    }
    spread = std::sqrt(local / total_mass_) / (2.0 * root);
    residual = std::sqrt(whole / total_mass_);
  }

  const CloudBonds<Dim>& bonds_;
  Point<Dim> direction_;
  std::vector<double> mass_;    ///< kg
  std::vector<double> scaled_;  ///< per end: bond stiffness over |xi|^2, N/m3; 0 where broken
  double longest_ = 0.0;
  double total_mass_ = 0.0;
};

}  // namespace

template <int Dim>
std::vector<CloudWaves<Dim>> cloud_waves(const Body<Dim>& body, std::span<const Point<Dim>> k,
                                         const Point<Dim>& direction) {
  const CloudBonds<Dim>& bonds = periodic_cloud(body);
  require_unit<Dim>(direction);
  const Waves<Dim> waves(body, bonds, direction);
  std::vector<CloudWaves<Dim>> result;
  result.reserve(k.size());
  for (const Point<Dim>& one : k) result.push_back(waves.at(one));
  return result;
}

template <int Dim>
std::vector<Point<Dim>> period_wave_vectors(const Body<Dim>& body, const Point<Dim>& direction,
                                            double longest) {
  const CloudBonds<Dim>& bonds = periodic_cloud(body);
  require_unit<Dim>(direction);
  // s |e_a| P_a / 2 pi is to be whole along every axis: q along the one with the most waves.
  const Point<Dim> waves = direction.cwiseAbs().cwiseProduct(bonds.period) / (2.0 * std::numbers::pi);
  const double most = waves.maxCoeff();
  constexpr double many = 1e6;
  if (!(longest > 0.0) || !(longest * most <= many)) {
    invalid_input({fmt::format("a longest wave vector > 0 and at most {:.6g} rad/m", many / most),
                   fmt::format("{}", longest),
                   "waves shorter than two spacings say nothing new",
                   {}});
  }
  const auto last = static_cast<Index>(std::floor(longest * most * (1.0 + 1e-9)));
  const auto whole = [&](Index q) {
    const Point<Dim> others = q / most * waves;
    return ((others.array() - others.array().round()).abs() <= 1e-9 * q).all();
  };
  Index first = 1;
  while (first <= last && !whole(first)) ++first;
  if (first > last) {
    std::string along;
    for (int a = 0; a < Dim; ++a) along += fmt::format("{}{:.6g}", a == 0 ? "" : ", ", direction[a]);
    invalid_input(
        {fmt::format("a wave vector along [{}] up to {:.6g} rad/m with a whole number of waves in every "
                     "period of the cloud",
                     along, longest),
         "none",
         "choose another direction (along an axis there are some) or allow shorter waves",
         {}});
  }
  std::vector<Point<Dim>> k;
  k.reserve(static_cast<std::size_t>(last / first));
  for (Index q = first; q <= last; q += first) k.push_back(q / most * direction);
  return k;
}

#define PERIMODE_CLOUD_WAVES(D)                                                                 \
  template std::vector<CloudWaves<D>> cloud_waves<D>(const Body<D>&, std::span<const Point<D>>, \
                                                     const Point<D>&);                          \
  template std::vector<Point<D>> period_wave_vectors<D>(const Body<D>&, const Point<D>&, double)
PERIMODE_CLOUD_WAVES(1);
PERIMODE_CLOUD_WAVES(2);
PERIMODE_CLOUD_WAVES(3);
#undef PERIMODE_CLOUD_WAVES

}  // namespace perimode
