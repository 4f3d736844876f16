// SPDX-License-Identifier: BSD-3-Clause
#include "clouds.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "pulse.hpp"
#include "studies/common/models.hpp"
#include "studies/common/release.hpp"

namespace perimode::studies {
namespace {

constexpr int neighbours = 30;
constexpr int slices = 50;

/// Volume means of displacements in slices of the bar, and how far displacements scatter about them.
struct Slices {
  std::vector<double> mean = std::vector<double>(slices, 0.0);
  double scatter = 0.0;
};

Slices slice(const Particles<3>& particles, const Eigen::VectorXd& u) {
  Slices result;
  std::vector<double> volume(slices, 0.0), squares(slices, 0.0);
  for (Index i = 0; i < particles.count(); ++i) {
    const auto p = static_cast<std::size_t>(i);
    const auto s = static_cast<std::size_t>(
        std::clamp(static_cast<int>(particles.position[p][0] * slices), 0, slices - 1));
    const double v = particles.volume[p], ui = u[3 * static_cast<Eigen::Index>(i)];
    volume[s] += v;
    result.mean[s] += v * ui;
    squares[s] += v * ui * ui;
  }
  double total = 0.0;
  for (std::size_t s = 0; s < slices; ++s) {
    if (volume[s] == 0.0) continue;
    result.mean[s] /= volume[s];
    total += squares[s] - volume[s] * result.mean[s] * result.mean[s];
  }
  double all = 0.0;
  for (const double v : volume) all += v;
  result.scatter = std::sqrt(std::max(total, 0.0) / all);
  return result;
}

/// Parabola a + b (x - middle) + c (x - middle)^2 through the displacements near `middle`, weighted by
/// volume: its top and its height.
std::pair<double, double> top_near(const Particles<3>& particles, const Eigen::VectorXd& u, double middle) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (Index i = 0; i < particles.count(); ++i) {
    const auto p = static_cast<std::size_t>(i);
    const double s = particles.position[p][0] - middle;
    if (std::abs(s) > 0.5 * cloud_pulse_width) continue;
    const Eigen::Vector3d powers(1.0, s, s * s);
    normal += particles.volume[p] * powers * powers.transpose();
    right += particles.volume[p] * u[3 * static_cast<Eigen::Index>(i)] * powers;
  }
  const Eigen::Vector3d fit = normal.ldlt().solve(right);
  const double top = -0.5 * fit[1] / fit[2];
  return {middle + top, fit[0] + 0.5 * fit[1] * top};
}

}  // namespace

void add_cloud(const std::filesystem::path& file, int level, Results& results, Table& profiles) {
  Body<3> body = build_body<3>(pmb_cloud(file, neighbours));
  const double t = pulse_travel / pmb_speed();
  const Eigen::VectorXd u0 = along_x(body, [](double x) { return end_pulse(x, cloud_pulse_width); });
  const Eigen::VectorXd u = release(body, u0, automatic_step, {t}).front();

  const Slices sliced = slice(body.particles, u);
  const auto highest =
      std::max_element(sliced.mean.begin() + slices / 2, sliced.mean.end()) - sliced.mean.begin();
  const auto [peak, height] = top_near(body.particles, u, (static_cast<double>(highest) + 0.5) / slices);
  const auto [smallest, largest] =
      std::minmax_element(body.particles.volume.begin(), body.particles.volume.end());
  const auto add = [&](const char* quantity, double value) {
    results[{quantity, "tetrahedra", 0.0, 0, static_cast<double>(level)}] = value;
  };
  add("particles", body.count());
  add("radius_ratio", std::cbrt(*largest / *smallest));
  add("peak", peak);
  add("height", height);
  add("scatter", sliced.scatter);
  for (std::size_t s = 0; s < slices; ++s)
    profiles.rows.push_back(
        {fmt::format("tetrahedra {}", level), t, (static_cast<double>(s) + 0.5) / slices, sliced.mean[s]});
}

}  // namespace perimode::studies
